// The broker must reject malicious requests and continue to serve.
#include <array>
#include <csignal>
#include <memory>
#include <thread>
#include <vector>

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include "gsv/base/sanitizer.h"
#include "gsv/broker/testing/broker_fixture.h"
#include "gsv/broker/testing/raw_connection.h"
#include "gsv/orb/testing/raw_message.h"

namespace gsv::broker {
namespace {

using orb::MessageType;
using orb::RawCdr;
using orb::RawMessage;
using orb::RawRequest;

class HostileInputTest : public BrokerFixture {
 protected:
  explicit HostileInputTest(std::vector<std::string> arguments = {"0"})
      : BrokerFixture(std::move(arguments)) {
    AddType("Robot");
  }

  void ExpectAlive() {
    Export("Robot", {{"n", Value::Long(1)}});
    EXPECT_GE(Query("Robot", "n == 1").offers->length(), 1u);
  }

  // Returns an empty sequence whose type is nested `depth` levels deep: a sequence of sequences of
  // sequences.
  static CORBA::Any Nested(int depth) {
    CORBA::TypeCode_var type = CORBA::TypeCode::_duplicate(CORBA::_tc_long);
    for (int i = 0; i < depth; ++i) type = TestOrb()->create_sequence_tc(0, type);
    cdrMemoryStream content;
    CORBA::ULong(0) >>= content;
    CORBA::Any any;
    any.replace(type, nullptr);
    any.NP_unmarshalDataOnly(content);
    return any;
  }

  void ExportValue(const CORBA::Any& value) {
    CosTrading::PropertySeq properties;
    properties.length(1);
    properties[0].name = "p";
    properties[0].value = value;
    const CORBA::String_var id = register_->_cxx_export(TestService(), "Robot", properties);
  }

  // Opens a plain TCP connection to the broker.
  int Connect() {
    const int socket = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(std::stoi(broker_.port())));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(connect(socket, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    return socket;
  }
};

TEST_F(HostileInputTest, RejectsTypeCodesThatAreTooDeep) {
  ExportValue(Nested(63));
  for (const int depth : {64, 300, 4000}) {
    Raised<CORBA::MARSHAL>([&] { ExportValue(Nested(depth)); });
  }
  ExpectAlive();
}

TEST_F(HostileInputTest, RejectsMessagesThatAreTooLong) {
  CORBA::Any text;
  text <<= std::string(200'000, 'x').c_str();
  EXPECT_THROW(ExportValue(text), CORBA::SystemException);
  ExpectAlive();
  EXPECT_THROW(Query("Robot", std::string(200'000, '(')), CORBA::SystemException);
  ExpectAlive();
}

TEST_F(HostileInputTest, RejectsConstraintsThatAreTooLongOrTooDeep) {
  Raised<CosTrading::IllegalConstraint>([&] { Query("Robot", std::string(20'000, ' ')); });
  Raised<CosTrading::IllegalConstraint>(
      [&] { Query("Robot", std::string(2'000, '(') + "n" + std::string(2'000, ')')); });
  std::string chain = "n == 0";
  for (int i = 0; i < 400; ++i) chain += " or n == 1";
  Raised<CosTrading::IllegalConstraint>([&] { Query("Robot", chain); });
  ExpectAlive();
}

// Each limit of a constraint is reached, and then exceeded by one.
TEST_F(HostileInputTest, AcceptsConstraintsUpToTheLimits) {
  const auto padded = [](std::size_t length) { return "TRUE" + std::string(length - 4, ' '); };
  EXPECT_NO_THROW(Query("Robot", padded(8192)));
  Raised<CosTrading::IllegalConstraint>([&] { Query("Robot", padded(8193)); });
  const auto nested = [](std::size_t depth) {
    return std::string(depth, '(') + "TRUE" + std::string(depth, ')');
  };
  EXPECT_NO_THROW(Query("Robot", nested(64)));
  Raised<CosTrading::IllegalConstraint>([&] { Query("Robot", nested(65)); });
  // A comparison takes three nodes, and `and` or `or` before it one more node. A literal and `not`
  // take one node each.
  std::string thousand = "n == 0";
  for (int i = 1; i < 249; ++i) thousand += " or n == 1";
  thousand += " or not TRUE or TRUE";
  EXPECT_NO_THROW(Query("Robot", thousand));
  Raised<CosTrading::IllegalConstraint>([&] { Query("Robot", thousand + " or TRUE"); });
}

TEST_F(HostileInputTest, AcceptsPropertiesUpToTheLimit) {
  constexpr int kMaxInteger = 128;
  std::vector<Property> properties;
  properties.reserve(kMaxInteger + 1);
  for (int i = 0; i < kMaxInteger; ++i)
    properties.push_back({"p" + std::to_string(i), Value::Long(i)});
  EXPECT_NO_THROW(Export("Robot", properties));
  properties.push_back({"one_more", Value::Long(1)});
  Raised<CORBA::IMP_LIMIT>([&] { Export("Robot", properties); });
  EXPECT_NO_THROW(Export("Robot", {{"text", Value::String(std::string(32'000, 'x'))}}));
  Raised<CORBA::IMP_LIMIT>([&] {
    Export("Robot", {{"text", Value::String(std::string(32'768, 'x'))}});
  });
}

TEST_F(HostileInputTest, RejectsOffersThatAreTooLarge) {
  CORBA::Any text;
  text <<= std::string(40'000, 'x').c_str();
  Raised<CORBA::IMP_LIMIT>([&] { ExportValue(text); });
  constexpr int kMany = 200;
  std::vector<Property> many;
  many.reserve(kMany);
  for (int i = 0; i < kMany; ++i) many.push_back({"p" + std::to_string(i), Value::Long(i)});
  Raised<CORBA::IMP_LIMIT>([&] { Export("Robot", many); });
  ExpectAlive();
}

TEST_F(HostileInputTest, ServesOtherClientsDespiteGarbageAndSilence) {
  std::array<int, 40> silent{};
  for (int& socket : silent) socket = Connect();
  const std::string half_a_header = "GIOP\x01\x02";
  for (const int socket : silent) {
    ASSERT_EQ(send(socket, half_a_header.data(), half_a_header.size(), MSG_NOSIGNAL),
              static_cast<ssize_t>(half_a_header.size()));
  }
  const int rude = Connect();
  const std::string rubbish(4096, '\xFF');
  send(rude, rubbish.data(), rubbish.size(), MSG_NOSIGNAL);
  const int huge = Connect();
  const std::string claims_two_gigabytes("GIOP\x01\x02\x01\x00\xFF\xFF\xFF\x7F", 12);
  send(huge, claims_two_gigabytes.data(), claims_two_gigabytes.size(), MSG_NOSIGNAL);
  ExpectAlive();
  for (const int socket : silent) close(socket);
  close(rude);
  close(huge);
  ExpectAlive();
}

// omniORB mistakes a cancel request for the end of another call on its connection.
TEST_F(HostileInputTest, IgnoresCancelRequestsAndEndsCleanly) {
  BrokerProcess broker;
  const std::string cancel = RawMessage(MessageType::kCancelRequest, RawCdr().ULong(1).bytes());
  const std::string call = RawRequest("TradingService", "_non_existent", "");
  std::string calls;
  for (int i = 0; i < 100; ++i) calls += cancel + call + cancel;
  std::vector<std::unique_ptr<RawConnection>> connections;
  for (int i = 0; i < 20; ++i) {
    const auto& connection =
        connections.emplace_back(std::make_unique<RawConnection>(std::stoi(broker.port())));
    connection->Send(calls);
    for (int reply = 0; reply < 100; ++reply) ASSERT_FALSE(connection->Read().empty()) << reply;
    connection->Send(call.substr(0, 20));
    connection->Send(call.substr(20) + cancel.substr(0, 5));
    ASSERT_FALSE(connection->Read().empty());
    connection->Send(cancel.substr(5));
  }
  broker.Send(SIGTERM);
  EXPECT_EQ(broker.Wait(), 0);
}

TEST_F(HostileInputTest, ServesManyClientsAtOnce) {
  constexpr int kClients = 16;
  std::vector<std::thread> clients;
  clients.reserve(kClients);
  for (int client = 0; client < kClients; ++client) {
    clients.emplace_back([this, client] {
      const std::string mine = "n == " + std::to_string(client);
      for (int i = 0; i < 20; ++i) {
        const std::string id = Export("Robot", {{"n", Value::Long(client)}});
        EXPECT_EQ(Query("Robot", mine).offers->length(), 1u);
        register_->withdraw(id.c_str());
      }
    });
  }
  for (std::thread& client : clients) client.join();
  EXPECT_EQ(Query("Robot").offers->length(), 0u);
}

class ScarceMemoryTest : public HostileInputTest {
 protected:
  ScarceMemoryTest() : HostileInputTest({"0", "address_space_mib=256"}) {}
};

TEST_F(ScarceMemoryTest, SurvivesOffersThatExceedItsMemory) {
  if (base::kReservesAddressSpace) GTEST_SKIP() << "this sanitizer leaves no bound on addresses";
  const std::vector<Property> large = {{"text", Value::String(std::string(32'000, 'x'))}};
  constexpr std::size_t kMoreThanFit = 12'000;
  std::vector<std::string> ids;
  Raised<CORBA::NO_MEMORY>([&] {
    while (ids.size() < kMoreThanFit) ids.push_back(Export("Robot", large));
  });
  // All clients get answers, also over new connections. The test uses no iterators, because they
  // would keep offers in memory.
  CORBA::Any one;
  one <<= CORBA::ULong(1);
  const std::vector<CosTrading::Policy> only_one = {Policy("search_card", one)};
  std::array<std::thread, 8> clients;
  for (std::thread& client : clients) {
    client = std::thread([&] {
      for (int i = 0; i < 20; ++i) {
        EXPECT_EQ(Query("Robot", "", "", only_one).offers->length(), 1u);
      }
    });
  }
  for (std::thread& client : clients) client.join();
  Raised<CORBA::NO_MEMORY>([&] { register_->modify(ids[0].c_str(), {}, Sequence(large)); });
  // Withdrawn offers free memory for other offers.
  constexpr std::size_t kRoom = 1000;
  ASSERT_GT(ids.size(), kRoom);
  for (std::size_t i = 0; i < kRoom; ++i) register_->withdraw(ids[i].c_str());
  Export("Robot", large);
}

}  // namespace
}  // namespace gsv::broker
