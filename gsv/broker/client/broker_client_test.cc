#include "gsv/broker/client/broker_client.h"

#include <csignal>
#include <sstream>

#include "gsv/broker/client/offer_listing.h"
#include "gsv/broker/encoding/corba_values.h"
#include "gsv/broker/testing/broker_fixture.h"

namespace gsv::broker {
namespace {

using base::ErrorCode;

const ServiceType kRobot = {
    .name = "Robot",
    .interface_name = kServiceInterface,
    .properties = {{"name", {.scalar = Scalar::kString}, PropertyMode::kMandatory},
                   {"speed", {.scalar = Scalar::kDouble}, PropertyMode::kReadonly}}};

class BrokerClientTest : public testing::Test {
 protected:
  BrokerClientTest() : client_(*BrokerClient::Connect(TestOrb(), broker_.reference())) {}

  std::string Export(const std::string& name) {
    return client_.Export("Robot", TestService(), {{"name", Value::String(name)}}).value();
  }

  BrokerProcess broker_;
  BrokerClient client_;
};

TEST_F(BrokerClientTest, ExportsFindsModifiesAndWithdraws) {
  ASSERT_TRUE(client_.EnsureServiceType(kRobot));
  const std::string id = Export("a");
  Export("b");
  const auto found = client_.Query("Robot", "name == 'a'", "", 10);
  ASSERT_TRUE(found) << found.error().Sentence();
  ASSERT_EQ(found->size(), 1u);
  EXPECT_TRUE(found->front().object->_is_equivalent(TestService()));
  EXPECT_EQ(*found->front().properties.Find("name"), Value::String("a"));

  ASSERT_TRUE(client_.Modify(id, {{"name", Value::String("c")}, {"speed", Value::Double(2)}}));
  EXPECT_EQ(client_.Query("Robot", "speed == 2 and name == 'c'", "", 10)->size(), 1u);
  ASSERT_TRUE(client_.Withdraw(id));
  EXPECT_EQ(client_.Query("Robot", "", "", 10)->size(), 1u);
}

TEST_F(BrokerClientTest, FollowsIteratorsUpToTheLimit) {
  ASSERT_TRUE(client_.EnsureServiceType(kRobot));
  for (int i = 0; i < 250; ++i) Export(std::to_string(i));
  EXPECT_EQ(client_.Query("Robot", "", "", 1000)->size(), 250u);
  EXPECT_EQ(client_.Query("Robot", "", "", 230)->size(), 230u);
  EXPECT_EQ(client_.Query("Robot", "", "", 3)->size(), 3u);
  EXPECT_EQ(client_.OfferIds()->size(), 250u);
}

TEST_F(BrokerClientTest, AcceptsAnEqualTypeAndRejectsADifferentOne) {
  ASSERT_TRUE(client_.EnsureServiceType(kRobot));
  ServiceType same = kRobot;
  std::swap(same.properties[0], same.properties[1]);
  EXPECT_TRUE(client_.EnsureServiceType(same));
  ServiceType other = kRobot;
  other.properties[0].mode = PropertyMode::kNormal;
  const base::Status refused = client_.EnsureServiceType(other);
  ASSERT_FALSE(refused);
  EXPECT_EQ(
      refused.error().Sentence(),
      broker_.reference() + ": the service type Robot exists already with another definition");
}

TEST_F(BrokerClientTest, ReportsThePositionOfAnErrorInAConstraint) {
  ASSERT_TRUE(client_.EnsureServiceType(kRobot));
  const auto refused = client_.Query("Robot", "speed =< 1", "", 1);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kInvalidArgument);
  EXPECT_EQ(refused.error().Sentence(),
            broker_.reference() +
                ": the constraint \"speed =< 1\" is refused: character 7: "
                "expected an operator or the end");
  EXPECT_EQ(client_.Query("Robot", "speed == 'x'", "", 1).error().message,
            "the constraint \"speed == 'x'\" is refused: its operands do not have the types that "
            "the service type declares");
  EXPECT_EQ(client_.Query("Robot", "", "best", 1).error().message,
            "the preference \"best\" is refused: character 1: expected 'min', 'max', 'with', "
            "'random' or 'first'");
}

TEST_F(BrokerClientTest, ReportsTheErrorOfAnOffer) {
  const auto unknown = client_.Query("Robot", "", "", 1);
  EXPECT_EQ(unknown.error().code, ErrorCode::kNotFound);
  EXPECT_EQ(unknown.error().message, "the broker knows no service type Robot");
  ASSERT_TRUE(client_.EnsureServiceType(kRobot));
  EXPECT_EQ(client_.Export("Robot", TestService(), {}).error().message,
            "Robot requires the property name");
  EXPECT_EQ(client_.Export("Robot", TestService(), {{"name", Value::Long(1)}}).error().message,
            "the property name has another type than Robot declares");
  EXPECT_EQ(client_.Export("Robot", CORBA::Object::_nil(), {}).error().message,
            "the offered service is nil, or does not respond to the broker");
  EXPECT_EQ(client_.Withdraw("x").error().message, "\"x\" is not a valid id of an offer");
}

TEST_F(BrokerClientTest, ListsOffersAndTypes) {
  ASSERT_TRUE(client_.EnsureServiceType(kRobot));
  const std::string id = Export("a \"b\"");
  const auto offers = ListOffers(broker_.reference());
  ASSERT_TRUE(offers) << offers.error().Sentence();
  ASSERT_EQ(offers->size(), 1u);
  const OfferDescription& offer = offers->front();
  EXPECT_EQ(offer.id, id);
  EXPECT_EQ(offer.type, "Robot");
  EXPECT_EQ(offer.interface_id, kServiceInterface);
  EXPECT_EQ(offer.address.substr(0, 10), "127.0.0.1:");

  std::ostringstream json;
  PrintOffersJson(*offers, json);
  EXPECT_EQ(json.str(), "{\"id\":\"" + id + "\",\"type\":\"Robot\",\"address\":\"" + offer.address +
                            "\",\"interface\":\"" + kServiceInterface +
                            "\",\"properties\":{\"name\":\"a \\\"b\\\"\"}}\n");
  std::ostringstream text;
  PrintOffers(*offers, text);
  EXPECT_EQ(text.str(), id + "  Robot  " + offer.address + "\n  name = \"a \\\"b\\\"\"\n");

  const auto types = ListServiceTypes(broker_.reference());
  ASSERT_TRUE(types) << types.error().Sentence();
  std::ostringstream types_json;
  PrintServiceTypesJson(*types, types_json);
  EXPECT_EQ(types_json.str(),
            "{\"name\":\"Robot\",\"interface\":\"IDL:omg.org/CosTradingDynamic/"
            "DynamicPropEval:1.0\",\"super_types\":[],\"masked\":false,\"incarnation\":1,"
            "\"properties\":[{\"name\":\"name\",\"type\":\"string\",\"readonly\":false,"
            "\"mandatory\":true},{\"name\":\"speed\",\"type\":\"double\",\"readonly\":true,"
            "\"mandatory\":false}]}\n");
}

TEST_F(BrokerClientTest, ReportsThatABrokerStoppedAnswering) {
  ASSERT_TRUE(client_.EnsureServiceType(kRobot));
  auto hasty =
      BrokerClient::Connect(TestOrb(), broker_.reference(), std::chrono::milliseconds(200));
  ASSERT_TRUE(hasty);
  broker_.Stop();
  const auto late = hasty->Query("Robot", "", "", 1);
  broker_.Send(SIGCONT);
  ASSERT_FALSE(late);
  EXPECT_EQ(late.error().code, ErrorCode::kTimeout);
  EXPECT_EQ(late.error().Sentence(), broker_.reference() + ": the broker did not respond in time");
}

TEST_F(BrokerClientTest, ReportsThatABrokerIsGone) {
  broker_.Send(SIGKILL);
  EXPECT_EQ(broker_.Wait(), -SIGKILL);
  const auto gone = client_.Query("Robot", "", "", 1);
  ASSERT_FALSE(gone);
  EXPECT_EQ(gone.error().code, ErrorCode::kUnavailable);
  EXPECT_EQ(gone.error().where, broker_.reference());
  const auto again = BrokerClient::Connect(TestOrb(), broker_.reference());
  ASSERT_FALSE(again);
  EXPECT_EQ(
      again.error().Sentence(),
      broker_.reference() + ": no broker responds at this address; start one with `gsv broker`");
}

TEST(BrokerClient, RejectsAReferenceThatIsNotABroker) {
  EXPECT_EQ(BrokerClient::Connect(TestOrb(), "localhost:1234").error().code,
            ErrorCode::kInvalidArgument);
  const CORBA::String_var ior = TestOrb()->object_to_string(TestService());
  EXPECT_EQ(BrokerClient::Connect(TestOrb(), ior.in()).error().message,
            "the object at this address is not a broker");
  EXPECT_EQ(BrokerClient::Connect(TestOrb(), "").error().code, ErrorCode::kInvalidArgument);
}

}  // namespace
}  // namespace gsv::broker
