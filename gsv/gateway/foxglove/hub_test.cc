#include "gsv/gateway/foxglove/hub.h"

#include <gtest/gtest.h>

#include "gsv/gateway/testing/recording_client.h"

namespace gsv::gateway {
namespace {

using testing::RecordingClient;
using testing::SubscribeText;
using testing::UnsubscribeText;

class HubTest : public ::testing::Test {
 protected:
  std::shared_ptr<RecordingClient> Join() {
    auto client = std::make_shared<RecordingClient>();
    hub_.Add(client);
    return client;
  }

  foxglove::ChannelId Advertise(const std::string& topic) {
    return hub_.Advertise({{0, topic, "cdr", "p/msg/N", "ros2msg", "int32 x"}}).front();
  }

  int demands_ = 0;
  Hub hub_{{"test", {}, {}, "1"}, [this] { ++demands_; }};
};

Hub::Message Message(std::uint64_t time, const std::string& text) {
  return {time, SharedBytes(text)};
}

TEST_F(HubTest, ANewClientGetsAllChannels) {
  const auto channel = Advertise("/a");
  const auto client = Join();
  const auto texts = client->texts();
  ASSERT_EQ(texts.size(), 2u);
  EXPECT_EQ(texts[0]["op"], "serverInfo");
  EXPECT_EQ(texts[1]["op"], "advertise");
  EXPECT_EQ(client->ChannelOf("/a"), channel);
}

TEST_F(HubTest, LaterClientsGetTheNewestWarnings) {
  for (int i = 0; i < 30; ++i) {
    hub_.SendStatus(foxglove::StatusLevel::kWarning, "complaint " + std::to_string(i));
  }
  const auto texts = Join()->texts();
  ASSERT_EQ(texts.size(), 22u);
  EXPECT_EQ(texts[2]["message"], "complaint 10");
  EXPECT_EQ(texts.back()["message"], "complaint 29");
}

TEST_F(HubTest, SendsAnAdvertisementEvenWithoutChannels) {
  EXPECT_EQ(Join()->texts().at(1)["channels"].size(), 0u);
}

TEST_F(HubTest, SendsDataToSubscribersWithTheirOwnSubscriptionIds) {
  const auto a = Advertise("/a"), b = Advertise("/b");
  const auto first = Join(), second = Join();
  ASSERT_TRUE(hub_.Receive(first.get(), SubscribeText(7, a)));
  ASSERT_TRUE(hub_.Receive(second.get(), SubscribeText(8, a)));
  ASSERT_TRUE(hub_.Receive(second.get(), SubscribeText(9, b)));
  hub_.Publish(a, Message(5, "x"));
  hub_.Publish(b, Message(6, "y"));
  ASSERT_EQ(first->data(7).size(), 1u);
  EXPECT_EQ(first->data(7)[0].time_ns, 5u);
  EXPECT_EQ(first->data(7)[0].payload, "x");
  EXPECT_EQ(second->data(8).size(), 1u);
  EXPECT_EQ(second->data(9)[0].payload, "y");
  EXPECT_EQ(hub_.SubscribedChannels(), (std::vector<foxglove::ChannelId>{a, b}));
}

TEST_F(HubTest, AClientThatLeavesOrUnsubscribesGetsNothingMore) {
  const auto a = Advertise("/a");
  const auto first = Join(), second = Join();
  ASSERT_TRUE(hub_.Receive(first.get(), SubscribeText(1, a)));
  ASSERT_TRUE(hub_.Receive(second.get(), SubscribeText(1, a)));
  ASSERT_TRUE(hub_.Receive(first.get(), UnsubscribeText(1)));
  hub_.Remove(second.get());
  EXPECT_FALSE(hub_.IsSubscribed(a));
  hub_.Publish(a, Message(5, "x"));
  EXPECT_TRUE(first->data(1).empty());
  EXPECT_TRUE(second->data(1).empty());
  EXPECT_TRUE(hub_.has_clients());
  EXPECT_EQ(demands_, 6);
}

TEST_F(HubTest, WelcomeReachesEachNewSubscriberOnce) {
  const auto a = Advertise("/a");
  const auto old = Join();
  ASSERT_TRUE(hub_.Receive(old.get(), SubscribeText(1, a)));
  hub_.Publish(a, Message(1, "first"));
  const auto late = Join();
  ASSERT_TRUE(hub_.Receive(late.get(), SubscribeText(1, a)));
  EXPECT_TRUE(hub_.HasNewSubscribers(a));
  hub_.Publish(a, Message(2, "second"), Hub::Audience::kEstablished);
  const std::vector<Hub::Message> past{Message(1, "first"), Message(2, "second")};
  hub_.Welcome(a, past);
  EXPECT_FALSE(hub_.HasNewSubscribers(a));
  hub_.Welcome(a, past);
  EXPECT_EQ(old->data(1).size(), 2u);
  ASSERT_EQ(late->data(1).size(), 2u);
  EXPECT_EQ(late->data(1)[1].payload, "second");
}

TEST_F(HubTest, InvalidRequestsAreReportedAndChangeNothing) {
  const auto a = Advertise("/a"), b = Advertise("/b");
  const auto client = Join();
  const auto complaint = [&] { return client->texts().back().value("message", ""); };
  ASSERT_TRUE(hub_.Receive(client.get(), SubscribeText(1, a)));
  ASSERT_TRUE(hub_.Receive(client.get(), SubscribeText(1, b)));
  EXPECT_EQ(complaint(),
            "the subscription 1 is in use; unsubscribe it first, or take another number");
  ASSERT_TRUE(hub_.Receive(client.get(), SubscribeText(2, a)));
  EXPECT_EQ(complaint(), "the channel /a is subscribed to already");
  ASSERT_TRUE(hub_.Receive(client.get(), SubscribeText(2, 999)));
  EXPECT_EQ(complaint(), "there is no channel 999 to subscribe to");
  ASSERT_TRUE(hub_.Receive(client.get(), UnsubscribeText(5)));
  EXPECT_EQ(complaint(), "there is no subscription 5 to end");
  ASSERT_TRUE(hub_.Receive(client.get(), R"({"op":"fetchAsset"})"));
  EXPECT_EQ(complaint(), "this server does not offer the operation 'fetchAsset'");
  EXPECT_FALSE(hub_.Receive(client.get(), "nonsense"));
  hub_.Publish(a, Message(1, "x"));
  EXPECT_EQ(client->data(1).size(), 1u);
}

TEST_F(HubTest, AWithdrawnChannelFreesTheSubscriptionAndItsNumberIsNotUsedAgain) {
  const auto a = Advertise("/a");
  const auto client = Join();
  ASSERT_TRUE(hub_.Receive(client.get(), SubscribeText(1, a)));
  hub_.Unadvertise(std::vector{a});
  EXPECT_EQ(client->ChannelOf("/a"), 0u);
  const auto again = Advertise("/a");
  EXPECT_NE(again, a);
  ASSERT_TRUE(hub_.Receive(client.get(), SubscribeText(1, again)));
  hub_.Publish(a, Message(1, "old"));
  hub_.Publish(again, Message(1, "new"));
  ASSERT_EQ(client->data(1).size(), 1u);
  EXPECT_EQ(client->data(1)[0].payload, "new");
}

TEST_F(HubTest, AClosedHubRefusesNewClients) {
  const auto before = Join();
  hub_.Close(CloseCode::kGoingAway, "the simulation does not exist any more");
  EXPECT_EQ(before->close_reason(), "the simulation does not exist any more");
  EXPECT_EQ(Join()->close_reason(), "the simulation does not exist any more");
}

}  // namespace
}  // namespace gsv::gateway
