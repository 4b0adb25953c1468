#include "gsv/recording/reading/lasting_messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/messages/gsv_msgs.h"
#include "gsv/messages/tf2_msgs.h"
#include "gsv/presentation/topics.h"
#include "gsv/recording/reading/recover.h"
#include "gsv/recording/testing/test_recording.h"

namespace gsv::recording {
namespace {

using testing::ElementsAre;

template <typename Message>
SchemaRecord SchemaWith(std::uint16_t id) {
  const messages::Schema& schema = messages::SchemaOf<Message>();
  return {id, std::string(schema.name), std::string(schema.encoding), std::string(schema.text)};
}

template <typename Message>
Bytes Encoded(const Message& message) {
  Bytes bytes;
  messages::Encode(message, bytes);
  return bytes;
}

Bytes CommandTo(const std::string& robot, double linear) {
  messages::gsv_msgs::Command command;
  command.robot = robot;
  command.linear_m_s = linear;
  return Encoded(command);
}

// A recording with all kinds of messages. After 100 ms, the same messages are repeated.
class RecordingOfAllKinds {
 public:
  RecordingOfAllKinds() : sink_(bytes_), writer_(sink_, {}) {
    using namespace messages;
    (void)writer_.AddSchema(SchemaOfClock());
    (void)writer_.AddSchema(SchemaWith<tf2_msgs::TFMessage>(2));
    (void)writer_.AddSchema(SchemaWith<gsv_msgs::Command>(3));
    (void)writer_.AddSchema(SchemaWith<gsv_msgs::Edit>(4));
    Add("/tf_static", 2), Add("/gsv/commands", 3), Add("/gsv/edits", 4), Add("/gsv/contacts", 1);
    Add("/clock", 1), Add("/map", 1), Add("/plan", 1, {{"offered_qos_profiles", kTransient}});
    for (const base::SimTime time : {0ms, 10ms}) Write(0, time, Encoded(tf2_msgs::TFMessage()));
    Write(1, 20ms, CommandTo("a", 1)), Write(1, 30ms, CommandTo("b", 2));
    Write(1, 40ms, CommandTo("a", 3));
    for (const base::SimTime time : {20ms, 60ms}) Write(2, time, Encoded(gsv_msgs::Edit()));
    Write(3, 50ms, ClockMessage(50ms));
    Write(5, 5ms, ClockMessage(5ms));
    for (const base::SimTime time : {6ms, 7ms}) Write(6, time, ClockMessage(time));
    for (base::SimTime time = 0ms; time < 200ms; time += 10ms) Write(4, time, ClockMessage(time));
    (void)writer_.Close();
  }

  const Bytes& bytes() const { return bytes_; }

 private:
  static constexpr const char* kTransient = "- history: 1\n  reliability: 1\n  durability: 1\n";

  void Add(const std::string& topic, std::uint16_t schema, StringMap metadata = {}) {
    (void)writer_.AddChannel({channels_++, schema, topic, "cdr", std::move(metadata)});
  }
  void Write(std::uint16_t channel, base::SimTime time, const Bytes& data) {
    (void)writer_.Write({channel, sequences_[channel]++, time, time, data});
  }

  Bytes bytes_;
  MemorySink sink_;
  McapFileWriter writer_;
  std::uint16_t channels_ = 0;
  std::map<std::uint16_t, std::uint32_t> sequences_;
};

TEST(LastingMessages, AreDefinedForExistingTopicsOnly) {
  for (const char* topic : {"/gsv/commands", "/gsv/actuators", "/gsv/edits", "/tf_static"}) {
    EXPECT_NE(presentation::FindTopic(topic), nullptr) << topic;
  }
}

TEST(LastingMessages, AreCopiedToTheStartOfAnExcerpt) {
  const RecordingOfAllKinds recording;
  const auto whole = Open(recording.bytes());
  Bytes bytes;
  MemorySink sink(bytes);
  ASSERT_TRUE(Recover(**whole, sink, {.topics = {}, .from = 100ms, .to = 150ms}));
  const auto part = Open(bytes);
  ASSERT_TRUE(part);
  EXPECT_EQ((*part)->summary().start, base::SimTime(100ms));
  std::vector<std::tuple<std::string, base::SimTime>> lasting;
  std::vector<double> commands;
  MessageCursor cursor = (*part)->Messages();
  for (;;) {
    const auto message = cursor.Next();
    ASSERT_TRUE(message);
    if (!*message) break;
    const std::string& topic = (*part)->summary().channels.at((*message)->channel_id).topic;
    if (topic == "/clock") continue;
    EXPECT_EQ((*message)->log_time, base::SimTime(100ms)) << topic;
    lasting.emplace_back(topic, (*message)->publish_time);
    if (topic != "/gsv/commands") continue;
    commands.push_back(messages::Decode<messages::gsv_msgs::Command>((*message)->data)->linear_m_s);
  }
  std::sort(lasting.begin(), lasting.end());
  using Each = std::tuple<std::string, base::SimTime>;
  EXPECT_THAT(lasting,
              ElementsAre(Each("/gsv/commands", 30ms), Each("/gsv/commands", 40ms),
                          Each("/gsv/edits", 20ms), Each("/gsv/edits", 60ms), Each("/map", 5ms),
                          Each("/plan", 7ms), Each("/tf_static", 10ms)));
  EXPECT_THAT(commands, ElementsAre(2, 3));
}

TEST(LastingMessages, AreCopiedForSelectedTopicsOnly) {
  const RecordingOfAllKinds recording;
  const auto whole = Open(recording.bytes());
  Bytes bytes;
  MemorySink sink(bytes);
  ASSERT_TRUE(Recover(**whole, sink, {.topics = {"/tf_static"}, .from = 100ms}));
  EXPECT_EQ((*Open(bytes))->summary().message_count, 1u);
}

TEST(LastingMessages, AreNotDuplicatedInAnExcerptFromTheStart) {
  const RecordingOfAllKinds recording;
  const auto whole = Open(recording.bytes());
  Bytes bytes;
  MemorySink sink(bytes);
  ASSERT_TRUE(Recover(**whole, sink, {.topics = {}, .from = 0ms}));
  EXPECT_EQ((*Open(bytes))->summary().message_count, (*whole)->summary().message_count);
}

}  // namespace
}  // namespace gsv::recording
