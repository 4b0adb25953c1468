// Compares the signatures generated from trading.idl with omniORB's stubs. The messages that the
// stubs send and can read must have the types of the signatures, up to the last byte.
#include <cstring>
#include <map>
#include <mutex>
#include <string>
#include <thread>

#include <gtest/gtest.h>
#include <COS/CosTrading.hh>
#include <COS/CosTradingDynamic.hh>
#include <COS/CosTradingRepos.hh>

#include "gsv/broker/testing/raw_connection.h"
#include "gsv/broker/transport/message_check.h"
#include "gsv/orb/giop/giop_header.h"
#include "gsv/orb/testing/raw_message.h"

namespace gsv::broker {
namespace {

using orb::RawCdr;
using orb::RawMessage;
using orb::Signature;

// A server that accepts any request, stores the last request, and always sends the same reply.
class Parrot {
 public:
  Parrot() : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address = Loopback(0);
    socklen_t size = sizeof address;
    EXPECT_EQ(bind(listener_, reinterpret_cast<sockaddr*>(&address), size), 0);
    EXPECT_EQ(listen(listener_, 16), 0);
    getsockname(listener_, reinterpret_cast<sockaddr*>(&address), &size);
    reference_ = "corbaloc::1.2@127.0.0.1:" + std::to_string(ntohs(address.sin_port)) + "/Parrot";
    thread_ = std::jthread([this] { Serve(); });
  }
  ~Parrot() {
    shutdown(listener_, SHUT_RDWR);
    thread_.join();
    close(listener_);
  }
  const std::string& reference() const { return reference_; }

  void Answer(std::uint32_t status, std::string body) {
    const std::lock_guard lock(mutex_);
    status_ = status;
    body_ = std::move(body);
  }
  std::string request() {
    const std::lock_guard lock(mutex_);
    return request_;
  }

 private:
  static constexpr int kRequest = 0, kLocateRequest = 3;

  void Serve() {
    for (int socket = 0; (socket = accept(listener_, nullptr, nullptr)) >= 0; close(socket)) {
      for (std::string message; !(message = ReadRawMessage(socket)).empty();) {
        const std::string reply = ReplyTo(message);
        send(socket, reply.data(), reply.size(), MSG_NOSIGNAL);
      }
    }
  }
  std::string ReplyTo(const std::string& message) {
    std::uint32_t id = 0;
    std::memcpy(&id, message.data() + 12, sizeof id);
    if (message[7] == kLocateRequest) {  // replies that the object exists here
      constexpr auto kLocateReply = static_cast<orb::MessageType>(4);
      return RawMessage(kLocateReply, RawCdr().ULong(id).ULong(1).bytes());
    }
    const std::lock_guard lock(mutex_);
    if (message[7] == kRequest) request_ = message;
    // The ULong(0) stands for the last four bytes of the header, so that the alignment is right.
    RawCdr reply = RawCdr().ULong(0).ULong(id).ULong(status_).ULong(0);
    return RawMessage(orb::MessageType::kReply, reply.Align(8).Raw(body_).bytes().substr(4));
  }

  int listener_;
  std::string reference_;
  std::mutex mutex_;
  std::uint32_t status_ = 0;
  std::string body_, request_;
  std::jthread thread_;
};

// Values of the types of a signature. Sequences have one element, and unions have their first
// member.
class Sample {
 public:
  explicit Sample(std::string_view types, RawCdr before = {}) : cdr_(std::move(before)) {
    while (!types.empty()) Write(types);
  }
  std::string bytes() const { return cdr_.bytes(); }

 private:
  void Write(std::string_view& types) {
    const char kind = types.front();
    types.remove_prefix(1);
    switch (kind) {
      case '1':
        cdr_.Octet(1);
        return;
      case '4':
        cdr_.ULong(1);
        return;
      case 's':
        cdr_.String("text");
        return;
      case 'o':
        cdr_.String("").ULong(0);
        return;
      case 'a':
        cdr_.ULong(3).ULong(7);
        return;
      case 't':
        cdr_.ULong(3);
        return;
      case '[':
        cdr_.ULong(1);
        while (types.front() != ']') Write(types);
        types.remove_prefix(1);
        return;
      default:
        FAIL() << "no result or exception has the type " << kind;
    }
  }

  RawCdr cdr_;
};

class TradingStubsTest : public ::testing::Test {
 protected:
  using Calls = std::map<std::string_view, void (*)(CORBA::Object_ptr)>;

  TradingStubsTest() {
    int no_arguments = 0;
    orb_ = CORBA::ORB_init(no_arguments, nullptr);
    object_ = orb_->string_to_object(parrot_.reference().c_str());
  }

  static const Calls& AllCalls();
  static void Make(std::string_view operation, CORBA::Object_ptr object) {
    const auto call = AllCalls().find(operation);
    ASSERT_NE(call, AllCalls().end()) << "no call of " << operation << " is known here";
    call->second(object);
  }

  Parrot parrot_;
  CORBA::ORB_var orb_;
  CORBA::Object_var object_;
};

CosTrading::PropertySeq SomeProperties() {
  CosTrading::PropertySeq properties;
  properties.length(1);
  properties[0].name = "p";
  properties[0].value <<= CORBA::Long{7};
  return properties;
}

CosTrading::PolicySeq SomePolicies() {
  CosTrading::PolicySeq policies;
  policies.length(1);
  policies[0].name = "p";
  policies[0].value <<= CORBA::Long{7};
  return policies;
}

const TradingStubsTest::Calls& TradingStubsTest::AllCalls() {
  namespace Repos = CosTradingRepos;
  static const Calls calls = {
      {"query",
       [](CORBA::Object_ptr object) {
         CosTrading::PropertyNameSeq names;
         names.length(1);
         names[0] = "p";
         CosTrading::Lookup::SpecifiedProps desired;
         desired.prop_names(names);
         CosTrading::OfferSeq_var offers;
         CosTrading::OfferIterator_var iterator;
         CosTrading::PolicyNameSeq_var limits;
         CosTrading::Lookup_var(CosTrading::Lookup::_unchecked_narrow(object))
             ->query("T", "", "", SomePolicies(), desired, 1, offers.out(), iterator.out(),
                     limits.out());
       }},
      {"export",
       [](CORBA::Object_ptr object) {
         CORBA::String_var(CosTrading::Register_var(CosTrading::Register::_unchecked_narrow(object))
                               ->_cxx_export(object, "T", SomeProperties()));
       }},
      {"modify",
       [](CORBA::Object_ptr object) {
         CosTrading::PropertyNameSeq names;
         names.length(1);
         names[0] = "p";
         CosTrading::Register_var(CosTrading::Register::_unchecked_narrow(object))
             ->modify("id", names, SomeProperties());
       }},
      {"describe",
       [](CORBA::Object_ptr object) {
         delete CosTrading::Register_var(CosTrading::Register::_unchecked_narrow(object))
             ->describe("id");
       }},
      {"export_proxy",
       [](CORBA::Object_ptr object) {
         CORBA::String_var(CosTrading::Proxy_var(CosTrading::Proxy::_unchecked_narrow(object))
                               ->export_proxy(CosTrading::Lookup::_nil(), "T", SomeProperties(),
                                              true, "", SomePolicies()));
       }},
      {"describe_proxy",
       [](CORBA::Object_ptr object) {
         delete CosTrading::Proxy_var(CosTrading::Proxy::_unchecked_narrow(object))
             ->describe_proxy("id");
       }},
      {"next_n",
       [](CORBA::Object_ptr object) {
         CosTrading::OfferSeq_var offers;
         CosTrading::OfferIterator_var(CosTrading::OfferIterator::_unchecked_narrow(object))
             ->next_n(1, offers.out());
       }},
      {"add_type",
       [](CORBA::Object_ptr object) {
         Repos::ServiceTypeRepository::PropStructSeq properties;
         properties.length(1);
         properties[0].name = "p";
         properties[0].value_type = CORBA::TypeCode::_duplicate(CORBA::_tc_long);
         properties[0].mode = Repos::ServiceTypeRepository::PROP_READONLY;
         Repos::ServiceTypeRepository::ServiceTypeNameSeq super_types;
         super_types.length(1);
         super_types[0] = "S";
         Repos::ServiceTypeRepository_var(Repos::ServiceTypeRepository::_unchecked_narrow(object))
             ->add_type("T", "", properties, super_types);
       }},
      {"describe_type",
       [](CORBA::Object_ptr object) {
         delete Repos::ServiceTypeRepository_var(
             Repos::ServiceTypeRepository::_unchecked_narrow(object))
             ->describe_type("T");
       }},
      {"fully_describe_type",
       [](CORBA::Object_ptr object) {
         delete Repos::ServiceTypeRepository_var(
             Repos::ServiceTypeRepository::_unchecked_narrow(object))
             ->fully_describe_type("T");
       }},
      {"evalDP",
       [](CORBA::Object_ptr object) {
         CORBA::Any extra;
         extra <<= CORBA::Long{7};
         delete CosTradingDynamic::DynamicPropEval_var(
             CosTradingDynamic::DynamicPropEval::_unchecked_narrow(object))
             ->evalDP("p", CORBA::_tc_long, extra);
       }},
  };
  return calls;
}

// Returns the message without the last byte of its body.
std::string WithoutLastByte(std::string message) {
  message.pop_back();
  orb::CompleteGiopHeader(message);
  return message;
}

TEST_F(TradingStubsTest, RequestsHaveTheTypesOfTheSignatures) {
  for (const Signature& each : TradingSignatures().requests) {
    try {
      Make(each.name, object_);
    } catch (const CORBA::SystemException&) {
      // Expected if the operation has results, because the reply contains none. This test checks
      // only the request.
    }
    const std::string request = parrot_.request();
    std::string checked = request;
    CheckRequest(checked);
    EXPECT_EQ(checked, request) << each.name;
    const std::string cut = WithoutLastByte(request);
    checked = cut;
    CheckRequest(checked);
    EXPECT_LT(checked.size(), cut.size()) << each.name;
  }
}

TEST_F(TradingStubsTest, ResultsHaveTheTypesOfTheSignatures) {
  for (const Signature& each : TradingSignatures().replies) {
    std::string results = Sample(each.types).bytes();
    parrot_.Answer(orb::ReplyHeader::kNoException, results);
    EXPECT_NO_THROW(Make(each.name, object_)) << each.name;
    results.pop_back();
    parrot_.Answer(orb::ReplyHeader::kNoException, results);
    EXPECT_THROW(Make(each.name, object_), CORBA::MARSHAL) << each.name;
  }
}

TEST_F(TradingStubsTest, ExceptionsHaveTheTypesOfTheSignatures) {
  for (const Signature& each : TradingSignatures().exceptions) {
    const bool is_of_query = each.name.find("Lookup") != std::string_view::npos;
    const char* const operation = is_of_query ? "query" : "evalDP";
    std::string members = Sample(each.types, RawCdr().String(each.name)).bytes();
    parrot_.Answer(orb::ReplyHeader::kUserException, members);
    EXPECT_THROW(Make(operation, object_), CORBA::UserException) << each.name;
    members.pop_back();
    parrot_.Answer(orb::ReplyHeader::kUserException, members);
    EXPECT_THROW(Make(operation, object_), CORBA::MARSHAL) << each.name;
  }
}

}  // namespace
}  // namespace gsv::broker
