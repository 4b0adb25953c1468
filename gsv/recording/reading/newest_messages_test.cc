#include "gsv/recording/reading/newest_messages.h"

#include <gtest/gtest.h>

#include "gsv/recording/testing/test_recording.h"

namespace gsv::recording {
namespace {

std::map<std::uint16_t, base::SimTime> TimesAt(const McapReader& reader, base::SimTime time) {
  std::map<std::uint16_t, base::SimTime> times;
  for (const auto& [channel, message] : FindNewestMessages(reader, time).by_channel) {
    times[channel] = message.log_time;
    EXPECT_EQ(message.data, ClockMessage(message.log_time));
  }
  return times;
}

using Times = std::map<std::uint16_t, base::SimTime>;

TEST(NewestMessages, AreTheLastAtOrBeforeTheInstant) {
  // Channel 0 has messages at 0, 20, 40, … ms, and channel 1 at 10, 30, 50, …
  const Bytes bytes = ThreeChunks();
  const auto reader = Open(bytes).value();
  EXPECT_EQ(TimesAt(*reader, 0ms), (Times{{0, 0ms}}));
  EXPECT_EQ(TimesAt(*reader, 10ms), (Times{{0, 0ms}, {1, 10ms}}));
  EXPECT_EQ(TimesAt(*reader, 155ms), (Times{{0, 140ms}, {1, 150ms}}));
  EXPECT_EQ(TimesAt(*reader, 10000ms), (Times{{0, 280ms}, {1, 290ms}}));
}

TEST(NewestMessages, AreEmptyBeforeTheStart) {
  const Bytes bytes = ThreeChunks();
  EXPECT_TRUE(TimesAt(*Open(bytes).value(), base::SimTime(-1)).empty());
}

// A recording with one early message on a channel of its own, followed by a hundred chunks of
// another channel.
Bytes OneEarly() {
  Bytes bytes;
  MemorySink sink(bytes);
  McapFileWriter writer(sink, {});
  (void)writer.AddSchema(SchemaOfClock());
  (void)writer.AddChannel(ChannelOf(0, "/often"));
  (void)writer.AddChannel(ChannelOf(1, "/once"));
  (void)writer.Write({1, 0, 5ms, 5ms, ClockMessage(5ms)});
  for (std::uint32_t i = 0; i < 100; ++i) {
    const base::SimTime time = 10ms * (i + 1);
    (void)writer.Write({0, i, time, time, ClockMessage(time)});
    (void)writer.Flush();
  }
  (void)writer.Close();
  return bytes;
}

TEST(NewestMessages, FindAnOldMessageOfAQuietChannel) {
  const Bytes bytes = OneEarly();
  EXPECT_EQ(TimesAt(*Open(bytes).value(), 1000ms), (Times{{0, 1000ms}, {1, 5ms}}));
}

TEST(NewestMessages, ReadOnlyTheBlocksThatTheyNeed) {
  Bytes bytes = OneEarly();
  // Damages the fiftieth chunk, so that it cannot be read.
  int chunks = 0;
  for (const FoundRecord& place : FindRecords(bytes)) {
    if (place.opcode == Opcode::kChunk && ++chunks == 50) bytes[place.end - 1] ^= std::byte{1};
  }
  const auto reader = Open(bytes).value();
  const NewestMessages newest = FindNewestMessages(*reader, 1000ms);
  EXPECT_EQ(newest.by_channel.size(), 2u);
  EXPECT_TRUE(newest.problems.empty());
  EXPECT_EQ(FindNewestMessages(*reader, 500ms).problems.size(), 1u);
  // All other chunks can be read.
  EXPECT_EQ(TimesAt(*reader, 500ms), (Times{{0, 490ms}, {1, 5ms}}));
}

}  // namespace
}  // namespace gsv::recording
