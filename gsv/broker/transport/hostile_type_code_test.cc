// Sends malformed TypeCodes over TCP. Without the broker's checks, they would crash omniORB 4.2.5
// and so the broker.
#include <atomic>
#include <list>
#include <thread>

#include <COS/CosTradingDynamic.hh>

#include "gsv/broker/testing/broker_fixture.h"
#include "gsv/broker/testing/raw_connection.h"
#include "gsv/orb/testing/raw_message.h"

namespace gsv::broker {
namespace {

using orb::RawCdr;
using orb::RawReply;
using orb::RawRequest;

constexpr std::uint32_t kStruct = 15;
constexpr std::uint32_t kUnion = 16;
constexpr std::uint32_t kEnum = 17;
constexpr std::uint32_t kSequence = 19;
constexpr std::uint32_t kException = 22;

RawCdr Named() { return RawCdr().Octet(1).String("IDL:T:1.0").String("T"); }

// Returns TypeCodes whose data ends too early: the members that they declare are missing, or even
// the number of members.
std::vector<std::string> BadTypeCodes() {
  std::vector<std::string> all;
  for (const std::uint32_t kind : {kStruct, kException, kEnum}) {
    all.push_back(RawCdr().ULong(kind).Octets(Named().ULong(0x00FFFFFF).bytes()).bytes());
    all.push_back(RawCdr().ULong(kind).Octets(Named().bytes()).bytes());
  }
  const RawCdr discriminated = Named().ULong(3).ULong(0xFFFFFFFF).ULong(0x00FFFFFF);
  all.push_back(RawCdr().ULong(kUnion).Octets(discriminated.bytes()).bytes());
  all.push_back(RawCdr().ULong(kSequence).Octets(RawCdr().Octet(1).ULong(kStruct).bytes()).bytes());
  return all;
}

class HostileTypeCodeTest : public BrokerFixture {
 protected:
  HostileTypeCodeTest() { AddType("Robot"); }

  // Returns the broker's answer on a new connection, or an empty text if the broker closes it.
  std::string Answer(const std::string& request) {
    const RawConnection connection(std::stoi(broker_.port()));
    connection.Send(request);
    return connection.Read();
  }
  void ExpectMarshal(std::string_view key, std::string_view operation, const std::string& body) {
    const std::string answer = Answer(RawRequest(key, operation, body));
    EXPECT_NE(answer.find("IDL:omg.org/CORBA/MARSHAL:1.0"), std::string::npos) << operation;
  }
};

TEST_F(HostileTypeCodeTest, IsRejectedInPolicies) {
  for (const std::string& type : BadTypeCodes()) {
    RawCdr query = RawCdr().String("Robot").String("").String("").ULong(1).String("p");
    ExpectMarshal("TradingService", "query", query.Align(4).Raw(type).ULong(0).ULong(0).bytes());
  }
  EXPECT_EQ(Query("Robot").offers->length(), 0u);
}

TEST_F(HostileTypeCodeTest, IsRejectedInProperties) {
  for (const std::string& type : BadTypeCodes()) {
    RawCdr offer = RawCdr().String("IDL:X:1.0").ULong(0).String("Robot").ULong(1).String("p");
    ExpectMarshal("TradingRegister", "export", offer.Align(4).Raw(type).ULong(0).bytes());
    RawCdr change = RawCdr().String("id").ULong(0).ULong(1).String("p");
    ExpectMarshal("TradingRegister", "modify", change.Align(4).Raw(type).ULong(0).bytes());
    RawCdr proxy = RawCdr().String("IDL:X:1.0").ULong(0).String("Robot").ULong(1).String("p");
    ExpectMarshal("TradingProxy", "export_proxy", proxy.Align(4).Raw(type).ULong(0).bytes());
  }
  EXPECT_EQ(Query("Robot").offers->length(), 0u);
}

TEST_F(HostileTypeCodeTest, IsRejectedInServiceTypes) {
  for (const std::string& type : BadTypeCodes()) {
    RawCdr description = RawCdr().String("New").String("").ULong(1).String("p");
    ExpectMarshal("TradingTypes", "add_type",
                  description.Align(4).Raw(type).ULong(0).ULong(0).bytes());
  }
  EXPECT_EQ(Query("Robot").offers->length(), 0u);
}

// A service that answers every request with the same bytes.
class BadService {
 public:
  explicit BadService(std::string body) : body_(std::move(body)) {
    listener_ = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address = Loopback(0);
    socklen_t size = sizeof address;
    EXPECT_EQ(bind(listener_, reinterpret_cast<sockaddr*>(&address), size), 0);
    EXPECT_EQ(listen(listener_, 16), 0);
    getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    reference_ = "corbaloc::1.2@127.0.0.1:" + std::to_string(ntohs(address.sin_port)) + "/Bad";
    thread_ = std::jthread([this] { Serve(); });
  }
  ~BadService() {
    shutdown(listener_, SHUT_RDWR);
    thread_.join();
    close(listener_);
  }
  const std::string& reference() const { return reference_; }
  int answers() const { return answers_; }

 private:
  void Serve() {
    for (int socket = 0; (socket = accept(listener_, nullptr, nullptr)) >= 0; close(socket)) {
      for (std::string request; !(request = ReadRawMessage(socket)).empty();) {
        if (request[7] != 0) continue;
        const std::string reply = RawReply(static_cast<unsigned char>(request[12]), body_);
        ++answers_;
        send(socket, reply.data(), reply.size(), MSG_NOSIGNAL);
      }
    }
  }

  std::string body_;
  std::string reference_;
  int listener_ = -1;
  std::atomic<int> answers_ = 0;
  std::jthread thread_;
};

TEST_F(HostileTypeCodeTest, MakesADynamicPropertyUnavailable) {
  // All services exist until the end. Otherwise a new service could get the port of an earlier
  // service, and the broker would use its cached answer for that port.
  std::list<BadService> services;
  for (const std::string& type : BadTypeCodes()) {
    const BadService& service = services.emplace_back(type);
    const CORBA::Object_var object = TestOrb()->string_to_object(service.reference().c_str());
    CosTradingDynamic::DynamicProp dynamic;
    dynamic.eval_if = CosTradingDynamic::DynamicPropEval::_unchecked_narrow(object);
    dynamic.returned_type = CORBA::TypeCode::_duplicate(CORBA::_tc_double);
    CosTrading::PropertySeq properties;
    properties.length(1);
    properties[0].name = "speed";
    properties[0].value <<= dynamic;
    const CORBA::String_var id = register_->_cxx_export(TestService(), "Robot", properties);
    EXPECT_EQ(Query("Robot", "speed > 1").offers->length(), 0u);
    EXPECT_GE(service.answers(), 1);
    register_->withdraw(id);
  }
}

}  // namespace
}  // namespace gsv::broker
