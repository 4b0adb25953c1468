#include "gsv/gateway/recorded/recorded_timeline.h"

#include <gtest/gtest.h>

#include "gsv/messages/gsv_msgs.h"
#include "gsv/recording/testing/test_recording.h"

namespace gsv::gateway {
namespace {

using recording::operator""ms;

template <typename Message>
void AddChannel(recording::McapFileWriter& writer, std::uint16_t id, const std::string& topic) {
  const messages::Schema& schema = messages::SchemaOf<Message>();
  ASSERT_TRUE(writer.AddSchema({static_cast<std::uint16_t>(id + 1), std::string(schema.name),
                                std::string(schema.encoding), std::string(schema.text)}));
  ASSERT_TRUE(writer.AddChannel({id, static_cast<std::uint16_t>(id + 1), topic, "cdr", {}}));
}

template <typename Message>
void Write(recording::McapFileWriter& writer, std::uint16_t id, base::SimTime time,
           const Message& message) {
  recording::Bytes bytes;
  messages::Encode(message, bytes);
  ASSERT_TRUE(writer.Write({id, 0, time, time, bytes}));
}

messages::gsv_msgs::LifecycleEvent Event(const std::string& event, const std::string& robot) {
  messages::gsv_msgs::LifecycleEvent message;
  message.event = event;
  message.robot = robot;
  message.detail = event + " at last";
  return message;
}

// Returns a recording of one second in chunks of 0.1 s: poses every 20 ms from 0 to 980 ms, clocks
// every 5 ms, and two events.
recording::Bytes OneSecond() {
  recording::Bytes bytes;
  recording::MemorySink sink(bytes);
  recording::McapFileWriter writer(sink, {});
  AddChannel<messages::gsv_msgs::Poses>(writer, 0, "/gsv/poses");
  AddChannel<messages::rosgraph_msgs::Clock>(writer, 1, "/clock");
  AddChannel<messages::gsv_msgs::LifecycleEvent>(writer, 2, "/gsv/events");
  for (int i = 0; i < 200; ++i) {
    const base::SimTime time = i * 5ms;
    Write(writer, 1, time, messages::rosgraph_msgs::Clock{messages::ToMessage(time)});
    if (i % 4 == 0) Write(writer, 0, time, messages::gsv_msgs::Poses{});
    if (i == 3) Write(writer, 2, time, Event("started", ""));
    if (i == 150) Write(writer, 2, time, Event("agent_dead", "robot_3"));
    if (i % 20 == 19) (void)writer.Flush();
  }
  EXPECT_TRUE(writer.Close());
  return bytes;
}

class RecordedTimelineTest : public ::testing::Test {
 protected:
  const recording::Bytes bytes_ = OneSecond();
  const std::unique_ptr<recording::McapReader> reader_ = recording::Open(bytes_).value();
  const RecordedScene scene_{*reader_};
  const RecordedTimeline timeline_{*reader_, scene_};
};

TEST_F(RecordedTimelineTest, FindsPosesAfterAndBeforeATime) {
  EXPECT_EQ(timeline_.TimeOfPoseFrom(500ms, 1), 520ms);
  EXPECT_EQ(timeline_.TimeOfPoseFrom(500ms, -1), 480ms);
  EXPECT_EQ(timeline_.TimeOfPoseFrom(505ms, 1), 520ms);
  EXPECT_EQ(timeline_.TimeOfPoseFrom(505ms, -1), 500ms);
}

TEST_F(RecordedTimelineTest, FindsPosesOverManyChunks) {
  EXPECT_EQ(timeline_.TimeOfPoseFrom(500ms, 10), 700ms);
  EXPECT_EQ(timeline_.TimeOfPoseFrom(500ms, -10), 300ms);
  EXPECT_EQ(timeline_.TimeOfPoseFrom(0ms, 49), 980ms);
  EXPECT_EQ(timeline_.TimeOfPoseFrom(980ms, -49), 0ms);
}

TEST_F(RecordedTimelineTest, StopsAtTheStartAndEndOfTheRecording) {
  EXPECT_EQ(timeline_.TimeOfPoseFrom(980ms, 1), 995ms);
  EXPECT_EQ(timeline_.TimeOfPoseFrom(500ms, 1000), 995ms);
  EXPECT_EQ(timeline_.TimeOfPoseFrom(40ms, -3), 0ms);
}

TEST_F(RecordedTimelineTest, ReturnsEventsWithTheirTimes) {
  const std::vector<RecordedEvent>& events = timeline_.Events();
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].time, 15ms);
  EXPECT_EQ(events[0].event, "started");
  EXPECT_EQ(events[1].time, 750ms);
  EXPECT_EQ(events[1].robot, "robot_3");
  EXPECT_EQ(events[1].detail, "agent_dead at last");
}

TEST_F(RecordedTimelineTest, ARecordingWithoutPosesHasAStartAndAnEnd) {
  const recording::Bytes bytes = recording::ThreeChunks();
  const auto reader = recording::Open(bytes).value();
  const RecordedScene scene(*reader);
  const RecordedTimeline timeline(*reader, scene);
  EXPECT_EQ(timeline.TimeOfPoseFrom(100ms, 1), 290ms);
  EXPECT_EQ(timeline.TimeOfPoseFrom(100ms, -1), 0ms);
  EXPECT_TRUE(timeline.Events().empty());
}

}  // namespace
}  // namespace gsv::gateway
