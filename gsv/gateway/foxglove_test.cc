#include "gsv/gateway/foxglove.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace gsv::gateway::foxglove {
namespace {

using nlohmann::json;

TEST(Foxglove, TheServersPreferenceChoosesTheSubprotocol) {
  EXPECT_EQ(ChooseSubprotocol("foxglove.websocket.v1"), "foxglove.websocket.v1");
  EXPECT_EQ(ChooseSubprotocol("foxglove.websocket.v1, foxglove.sdk.v1"), "foxglove.sdk.v1");
  EXPECT_EQ(ChooseSubprotocol("chat ,\tfoxglove.sdk.v1"), "foxglove.sdk.v1");
  EXPECT_EQ(ChooseSubprotocol(""), "");
  EXPECT_EQ(ChooseSubprotocol("foxglove.sdk.v10, x-foxglove.sdk.v1"), "");
}

TEST(Foxglove, WritesTheServersTexts) {
  EXPECT_EQ(json::parse(ServerInfoText({"gsv", {"time"}, {{"simulation", "a"}}, "7"})),
            json::parse(R"({"op":"serverInfo","name":"gsv","capabilities":["time"],
                            "metadata":{"simulation":"a"},"sessionId":"7"})"));
  const std::vector<Channel> channels{{3, "/t", "cdr", "p/msg/N", "ros2msg", "int32 x\n"}};
  EXPECT_EQ(json::parse(AdvertiseText(channels)),
            json::parse(R"({"op":"advertise","channels":[{"id":3,"topic":"/t","encoding":"cdr",
                "schemaName":"p/msg/N","schemaEncoding":"ros2msg","schema":"int32 x\n"}]})"));
  EXPECT_EQ(json::parse(AdvertiseText({})), json::parse(R"({"op":"advertise","channels":[]})"));
  EXPECT_EQ(json::parse(UnadvertiseText(std::vector<ChannelId>{3, 4})),
            json::parse(R"({"op":"unadvertise","channelIds":[3,4]})"));
  EXPECT_EQ(json::parse(StatusText(StatusLevel::kError, "no \xff")),
            json::parse("{\"op\":\"status\",\"level\":2,\"message\":\"no \xef\xbf\xbd\"}"));
}

TEST(Foxglove, WritesBinaryHeadersInLittleEndian) {
  const BinaryHeader data = MessageDataHeader(0x01020304, 0x1112131415161718);
  EXPECT_EQ(data.size, 13);
  EXPECT_EQ(data.bytes, (std::array<std::uint8_t, 13>{1, 4, 3, 2, 1, 0x18, 0x17, 0x16, 0x15, 0x14,
                                                      0x13, 0x12, 0x11}));
  const BinaryHeader time = TimeHeader(258);
  EXPECT_EQ(time.size, 9);
  EXPECT_EQ(time.bytes, (std::array<std::uint8_t, 13>{2, 2, 1}));
}

TEST(Foxglove, ReadsSubscriptions) {
  const auto message = ParseClientMessage(
      R"({"op":"subscribe","subscriptions":[{"id":0,"channelId":3},{"id":4294967295,"channelId":5}]})");
  ASSERT_TRUE(message);
  const auto& subscriptions = std::get<Subscribe>(*message).subscriptions;
  ASSERT_EQ(subscriptions.size(), 2u);
  EXPECT_EQ(subscriptions[0].channel, 3u);
  EXPECT_EQ(subscriptions[1].id, 4294967295u);
  const auto end = ParseClientMessage(R"({"op":"unsubscribe","subscriptionIds":[0,9]})");
  ASSERT_TRUE(end);
  EXPECT_EQ(std::get<Unsubscribe>(*end).subscriptions, (std::vector<SubscriptionId>{0, 9}));
}

TEST(Foxglove, KnowsWhatItDoesNotOffer) {
  const auto message = ParseClientMessage(R"({"op":"getParameters","parameterNames":[]})");
  ASSERT_TRUE(message);
  EXPECT_EQ(std::get<Unsupported>(*message).op, "getParameters");
}

TEST(Foxglove, RefusesWhatIsNoMessage) {
  for (const char* bad :
       {"", "{", "[]", "1", "{}", R"({"op":1})", R"({"op":"subscribe"})",
        R"({"op":"subscribe","subscriptions":{}})", R"({"op":"subscribe","subscriptions":[1]})",
        R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})",
        R"({"op":"subscribe","subscriptions":[{"id":1.5,"channelId":1}]})",
        R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":1}]})",
        R"({"op":"unsubscribe","subscriptionIds":["1"]})", "{\"op\":\"\xff\"}"}) {
    const auto message = ParseClientMessage(bad);
    ASSERT_FALSE(message) << bad;
    EXPECT_EQ(message.error().code, base::ErrorCode::kCorrupt);
  }
}

TEST(Foxglove, SurvivesDeepNesting) { EXPECT_FALSE(ParseClientMessage(std::string(200'000, '['))); }

}  // namespace
}  // namespace gsv::gateway::foxglove
