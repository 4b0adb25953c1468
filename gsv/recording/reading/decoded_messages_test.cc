#include "gsv/recording/reading/decoded_messages.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/recording/reading/recover.h"
#include "gsv/recording/testing/test_recording.h"

namespace gsv::recording {
namespace {

// A recording of two topics with ten clock messages each, 10 ms apart. The fifth message of /b has
// the time `fifth`.
Bytes TwoTopics(base::SimTime fifth, bool is_reproducible = true) {
  Bytes bytes;
  MemorySink sink(bytes);
  McapFileWriter writer(sink, {});
  (void)writer.AddSchema(SchemaOfClock());
  (void)writer.AddChannel(ChannelOf(0, "/a"));
  ChannelRecord b = ChannelOf(1, "/b");
  if (!is_reproducible) b.metadata["reproducible"] = "false";
  (void)writer.AddChannel(b);
  for (std::uint32_t i = 0; i < 10; ++i) {
    const base::SimTime time = i * 10ms;
    for (const std::uint16_t channel : {0, 1}) {
      const Bytes data = ClockMessage(channel == 1 && i == 5 ? fifth : time);
      (void)writer.Write({channel, i, time, time, data});
    }
  }
  (void)writer.Close();
  return bytes;
}

std::optional<Difference> DifferenceOf(const Bytes& a, const Bytes& b) {
  const auto first = Open(a), second = Open(b);
  const auto difference = FirstDifference(**first, **second);
  EXPECT_TRUE(difference) << difference.error().Sentence();
  return *difference;
}

TEST(FirstDifference, NamesTimeTopicAndField) {
  const auto difference = DifferenceOf(TwoTopics(50ms), TwoTopics(51ms));
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->time, base::SimTime(50ms));
  EXPECT_EQ(difference->topic, "/b");
  EXPECT_EQ(difference->field, "clock.nanosec");
  EXPECT_EQ(difference->in_first, "50000000");
  EXPECT_EQ(difference->in_second, "51000000");
  EXPECT_EQ(difference->Sentence(),
            "0.050000 s, /b, clock.nanosec: 50000000 in the first, 51000000 in the second");
  EXPECT_EQ(difference->message["clock"]["nanosec"], 50'000'000);
}

TEST(FirstDifference, IgnoresMessagesThatDependOnTheWallClock) {
  EXPECT_FALSE(DifferenceOf(TwoTopics(50ms, false), TwoTopics(51ms, false)));
}

TEST(FirstDifference, IsEmptyForARecordingAndItself) {
  EXPECT_FALSE(DifferenceOf(ThreeChunks(), ThreeChunks()));
}

TEST(FirstDifference, ReportsAMissingMessage) {
  const Bytes whole = TwoTopics(50ms);
  Bytes part;
  MemorySink sink(part);
  const auto reader = Open(whole);
  ASSERT_TRUE(Recover(**reader, sink, {.topics = {}, .to = 60ms}));
  const auto difference = DifferenceOf(whole, part);
  ASSERT_TRUE(difference);
  EXPECT_EQ(difference->time, base::SimTime(70ms));
  EXPECT_EQ(difference->topic, "/a");
  EXPECT_EQ(difference->in_first, "there");
  EXPECT_EQ(difference->in_second, "missing");
}

// A recording of clock messages, one every 0.1 s. The messages at the times in `left_out` are
// missing, and the message at the time `other` has another content.
Bytes ClocksWithout(const std::set<base::SimTime>& left_out, base::SimTime other = -1ms) {
  Bytes bytes;
  MemorySink sink(bytes);
  McapFileWriter writer(sink, {});
  (void)writer.AddSchema(SchemaOfClock());
  (void)writer.AddChannel(ChannelOf(0, "/clock"));
  std::uint32_t sequence = 0;
  for (base::SimTime time = 0ms; time < 1000ms; time += 100ms) {
    if (left_out.contains(time)) continue;
    const Bytes data = ClockMessage(time == other ? 7ms : time);
    (void)writer.Write({0, sequence++, time, time, data});
  }
  (void)writer.Close();
  return bytes;
}

TEST(FirstDifference, IgnoresGapsInARecording) {
  const auto difference = [](const Bytes& a, const Bytes& b) {
    const auto first = Open(a), second = Open(b);
    return FirstDifference(**first, **second, {}, Gaps::kInFirst).value();
  };
  const Bytes whole = ClocksWithout({});
  EXPECT_TRUE(DifferenceOf(ClocksWithout({300ms, 900ms}), whole));
  EXPECT_FALSE(difference(ClocksWithout({300ms, 900ms}), whole));
  EXPECT_FALSE(difference(ClocksWithout({0ms}, 200ms), ClocksWithout({200ms})));
  const auto found = difference(ClocksWithout({300ms}, 500ms), whole);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->time, base::SimTime(500ms));
  EXPECT_EQ(found->field, "clock.nanosec");
}

TEST(DecodedMessages, ContainTheSelectedTopics) {
  const Bytes bytes = TwoTopics(50ms);
  const auto reader = Open(bytes);
  auto messages = DecodedMessages::Open(**reader, {{"/b"}, 30ms, 50ms});
  ASSERT_TRUE(messages);
  std::vector<std::int64_t> nanoseconds;
  for (auto message = messages->Next(); message && *message; message = messages->Next()) {
    EXPECT_EQ((*message)->topic, "/b");
    EXPECT_EQ((*message)->type, "rosgraph_msgs/msg/Clock");
    nanoseconds.push_back((*message)->content["clock"]["nanosec"]);
  }
  EXPECT_EQ(nanoseconds, (std::vector<std::int64_t>{30'000'000, 40'000'000, 50'000'000}));
}

TEST(DecodedMessages, RejectATopicThatTheRecordingDoesNotHave) {
  const Bytes bytes = ThreeChunks();
  const auto reader = Open(bytes);
  const auto messages = DecodedMessages::Open(**reader, {{"/nowhere"}});
  ASSERT_FALSE(messages);
  EXPECT_EQ(messages.error().where, "/nowhere");
}

TEST(ToCsv, HasARowForEachMessageAndAColumnForEachValue) {
  const Bytes bytes = TwoTopics(50ms);
  const auto reader = Open(bytes);
  const auto csv = ToCsv(**reader, {{"/a"}, 0ms, 10ms});
  ASSERT_TRUE(csv);
  EXPECT_EQ(*csv,
            "time_s,clock.sec,clock.nanosec\r\n"
            "0.000000000,0,0\r\n"
            "0.010000000,0,10000000\r\n");
}

// A recording of three ranges: too near, without an echo, and NaN.
Bytes Infinities() {
  const messages::Schema& schema = messages::SchemaOf<messages::sensor_msgs::LaserScan>();
  Bytes bytes, scan;
  MemorySink sink(bytes);
  McapFileWriter writer(sink, {});
  (void)writer.AddSchema(
      {1, std::string(schema.name), std::string(schema.encoding), std::string(schema.text)});
  (void)writer.AddChannel(ChannelOf(0, "/scan"));
  messages::sensor_msgs::LaserScan message;
  message.ranges = {-INFINITY, INFINITY, NAN, 1.5f};
  messages::Encode(message, scan);
  (void)writer.Write({0, 0, 0ms, 0ms, scan});
  (void)writer.Close();
  return bytes;
}

TEST(ToCsv, DistinguishesNonFiniteNumbers) {
  const Bytes bytes = Infinities();
  const auto csv = ToCsv(**Open(bytes), {{"/scan"}});
  ASSERT_TRUE(csv);
  EXPECT_TRUE(csv->ends_with(",-inf,inf,nan,1.5\r\n")) << *csv;
}

TEST(DecodedMessages, WriteInfinitiesAsTextsInJson) {
  const Bytes bytes = Infinities();
  const auto reader = Open(bytes);
  auto messages = DecodedMessages::Open(**reader, {{"/scan"}});
  ASSERT_TRUE(messages);
  const auto message = messages->Next();
  ASSERT_TRUE(message && *message);
  const nlohmann::ordered_json json = WithInfinitiesAsText((*message)->content);
  EXPECT_EQ(json["ranges"].dump(), R"(["-Infinity","Infinity",null,1.5])");
  EXPECT_EQ(json["angle_min"], 0);
}

}  // namespace
}  // namespace gsv::recording
