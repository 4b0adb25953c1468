#include "gsv/gateway/foxglove/foxglove_requests.h"

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

TEST(Foxglove, WritesTheServersTextMessages) {
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

TEST(Foxglove, RecognisesOperationsThatItDoesNotSupport) {
  const auto message = ParseClientMessage(R"({"op":"fetchAsset","uri":"x","requestId":1})");
  ASSERT_TRUE(message);
  EXPECT_EQ(std::get<Unsupported>(*message).op, "fetchAsset");
  EXPECT_EQ(std::get<Unsupported>(ParseClientBytes("\x01").value()).op, "message data");
}

TEST(Foxglove, ReadsParameterRequests) {
  const auto get = ParseClientMessage(R"({"op":"getParameters","parameterNames":["/a"],"id":"7"})");
  EXPECT_EQ(std::get<GetParameters>(get.value()).names, (std::vector<std::string>{"/a"}));
  EXPECT_EQ(std::get<GetParameters>(get.value()).request, "7");
  const auto set = ParseClientMessage(
      R"({"op":"setParameters","parameters":[{"name":"/a","value":2,"type":"float64"},
          {"name":"/b","value":true},{"name":"/c","value":"x"},{"name":"/d","value":[1]},
          {"name":"/e"}]})");
  const auto& parameters = std::get<SetParameters>(set.value()).parameters;
  EXPECT_EQ(parameters, (std::vector<Parameter>{{"/a", 2.0},
                                                {"/b", true},
                                                {"/c", "x"},
                                                {"/d", std::monostate()},
                                                {"/e", std::monostate()}}));
  const auto watch =
      ParseClientMessage(R"({"op":"subscribeParameterUpdates","parameterNames":[]})");
  EXPECT_FALSE(std::get<WatchParameters>(watch.value()).is_end);
  const auto end = ParseClientMessage(R"({"op":"unsubscribeConnectionGraph"})");
  EXPECT_TRUE(std::get<WatchGraph>(end.value()).is_end);
}

TEST(Foxglove, ReadsServiceCalls) {
  const std::string bytes("\x02\x05\0\0\0\x06\0\0\0\x03\0\0\0cdrrest", 20);
  const auto message = ParseClientBytes(bytes);
  ASSERT_TRUE(message);
  const auto& call = std::get<ServiceCall>(*message);
  EXPECT_EQ(call.service, 5u);
  EXPECT_EQ(call.call, 6u);
  EXPECT_EQ(call.encoding, "cdr");
  EXPECT_EQ(call.request, "rest");
  for (std::size_t size = 0; size < 16; ++size) {
    EXPECT_FALSE(ParseClientBytes(bytes.substr(0, size))) << size;
  }
  EXPECT_FALSE(ParseClientBytes(std::string("\x02\0\0\0\0\0\0\0\0\xff\xff\xff\xff", 13)));
}

TEST(Foxglove, ReadsPlaybackRequests) {
  // The message requests to pause, to set the speed to 1.5, and to seek to 1 s.
  const std::string bytes("\x03\x01\0\0\xc0\x3f\x01\0\xca\x9a\x3b\0\0\0\0\x02\0\0\0id", 21);
  const auto message = ParseClientBytes(bytes);
  ASSERT_TRUE(message);
  const auto& control = std::get<PlaybackControl>(*message);
  EXPECT_FALSE(control.play);
  EXPECT_EQ(control.speed, 1.5f);
  EXPECT_EQ(control.seek_ns, 1'000'000'000u);
  EXPECT_EQ(control.request, "id");
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    EXPECT_FALSE(ParseClientBytes(bytes.substr(0, size))) << size;
  }
  std::string other = bytes;
  other[1] = 2;  // a value that is neither play nor pause
  EXPECT_FALSE(ParseClientBytes(other));
  other[1] = 0;
  other[6] = 0;  // no seek
  EXPECT_FALSE(std::get<PlaybackControl>(ParseClientBytes(other).value()).seek_ns);
}

TEST(Foxglove, WritesAnswersToCallsAndAPlaybacksState) {
  const auto text = [](const std::vector<std::byte>& bytes) {
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  const std::string answer = "xy";
  EXPECT_EQ(text(ServiceResponseBytes(5, 6, std::as_bytes(std::span(answer)))),
            std::string("\x03\x05\0\0\0\x06\0\0\0\x03\0\0\0cdrxy", 18));
  const PlaybackState state{PlaybackState::Status::kEnded, 1'000'000'000, 1.5f, true, "id"};
  EXPECT_EQ(text(PlaybackStateBytes(state)),
            std::string("\x05\x03\0\xca\x9a\x3b\0\0\0\0\0\0\xc0\x3f\x01\x02\0\0\0id", 21));
}

TEST(Foxglove, AGraphUpdateHasTheChanges) {
  const ConnectionGraph before{
      {{"/a", {"gsv"}}, {"/b", {"gsv"}}}, {{"/a", {"viewer 1"}}}, {{"/gsv/stop", {"gsv"}}}};
  ConnectionGraph after = before;
  EXPECT_EQ(GraphUpdateText(before, after), "");
  after.subscribers.erase("/a");
  after.publishers.erase("/b");
  after.publishers["/c"] = {"robot"};
  EXPECT_EQ(json::parse(GraphUpdateText(before, after)),
            json::parse(R"({"op":"connectionGraphUpdate",
                "publishedTopics":[{"name":"/c","publisherIds":["robot"]}],
                "subscribedTopics":[{"name":"/a","subscriberIds":[]}],
                "advertisedServices":[],"removedTopics":["/b"],"removedServices":[]})"));
}

TEST(Foxglove, TheServerInfoHasTheTimeRangeOfAPlayback) {
  const json info = json::parse(ServerInfoText(
      {"gsv", {"time", "services"}, {}, "7", TimeRange{500'000'000, 3'000'000'001}}));
  EXPECT_EQ(info["capabilities"], json({"time", "services", "playbackControl"}));
  EXPECT_EQ(info["supportedEncodings"], json({"cdr"}));
  EXPECT_EQ(info["dataStartTime"], (json{{"sec", 0}, {"nsec", 500'000'000}}));
  EXPECT_EQ(info["dataEndTime"], (json{{"sec", 3}, {"nsec", 1}}));
}

TEST(Foxglove, RefusesInvalidMessages) {
  for (const char* bad : {"",
                          "{",
                          "[]",
                          "1",
                          "{}",
                          R"({"op":1})",
                          R"({"op":"subscribe"})",
                          R"({"op":"subscribe","subscriptions":{}})",
                          R"({"op":"subscribe","subscriptions":[1]})",
                          R"({"op":"subscribe","subscriptions":[{"id":-1,"channelId":1}]})",
                          R"({"op":"subscribe","subscriptions":[{"id":1.5,"channelId":1}]})",
                          R"({"op":"subscribe","subscriptions":[{"id":4294967296,"channelId":1}]})",
                          R"({"op":"unsubscribe","subscriptionIds":["1"]})",
                          "{\"op\":\"\xff\"}",
                          R"({"op":"getParameters"})",
                          R"({"op":"getParameters","parameterNames":[1]})",
                          R"({"op":"getParameters","parameterNames":[],"id":1})",
                          R"({"op":"setParameters"})",
                          R"({"op":"setParameters","parameters":[{"value":1}]})",
                          R"({"op":"subscribeParameterUpdates","parameterNames":{}})"}) {
    const auto message = ParseClientMessage(bad);
    ASSERT_FALSE(message) << bad;
    EXPECT_EQ(message.error().code, base::ErrorCode::kCorrupt);
  }
}

TEST(Foxglove, SurvivesDeepNesting) { EXPECT_FALSE(ParseClientMessage(std::string(200'000, '['))); }

}  // namespace
}  // namespace gsv::gateway::foxglove
