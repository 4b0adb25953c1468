#include "gsv/recording/reading/recording_info.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/base/temporary_folder.h"
#include "gsv/recording/reading/content_hash.h"
#include "gsv/recording/testing/test_recording.h"

namespace gsv::recording {
namespace {

using testing::HasSubstr;

struct Entry {
  std::uint16_t channel;
  base::SimTime time;
  std::string data;
};

std::string HashOf(const std::vector<Entry>& entries, std::size_t chunk_size = 1 << 20) {
  Bytes bytes;
  MemorySink sink(bytes);
  McapFileWriter writer(sink, {.chunk_size = chunk_size});
  ChannelRecord wall = ChannelOf(2, "/wall");
  wall.metadata["reproducible"] = "false";
  (void)writer.AddSchema(SchemaOfClock());
  (void)writer.AddChannel(ChannelOf(0, "/a"));
  (void)writer.AddChannel(ChannelOf(1, "/b"));
  (void)writer.AddChannel(wall);
  std::map<std::uint16_t, std::uint32_t> next;
  for (const Entry& entry : entries) {
    (void)writer.Write(
        {entry.channel, next[entry.channel]++, entry.time, entry.time, AsBytes(entry.data)});
  }
  (void)writer.Close();
  return ContentHash(**Open(bytes)).value();
}

TEST(ContentHash, DependsOnTheContentAndNotOnTheLayoutOfTheFile) {
  const std::vector<Entry> entries{{0, 1ms, "x"}, {1, 1ms, "y"}, {0, 2ms, "z"}, {0, 2ms, "w"}};
  const std::string hash = HashOf(entries);
  EXPECT_EQ(hash.size(), 16U);
  EXPECT_EQ(HashOf(entries, 1), hash) << "a chunk for each message";
  EXPECT_EQ(HashOf({{1, 1ms, "y"}, {0, 1ms, "x"}, {0, 2ms, "z"}, {0, 2ms, "w"}}), hash)
      << "the order of topics at one time";
  EXPECT_EQ(HashOf({{0, 1ms, "x"}, {2, 1ms, "?"}, {1, 1ms, "y"}, {0, 2ms, "z"}, {0, 2ms, "w"}}),
            hash)
      << "a topic of the wall clock";

  EXPECT_NE(HashOf({{0, 1ms, "X"}, {1, 1ms, "y"}, {0, 2ms, "z"}, {0, 2ms, "w"}}), hash) << "bytes";
  EXPECT_NE(HashOf({{0, 3ms, "x"}, {1, 1ms, "y"}, {0, 2ms, "z"}, {0, 2ms, "w"}}), hash) << "time";
  EXPECT_NE(HashOf({{1, 1ms, "x"}, {1, 1ms, "y"}, {0, 2ms, "z"}, {0, 2ms, "w"}}), hash) << "topic";
  EXPECT_NE(HashOf({{0, 1ms, "x"}, {1, 1ms, "y"}, {0, 2ms, "w"}, {0, 2ms, "z"}}), hash)
      << "order within a topic";
}

class RecordingInfoTest : public testing::Test {
 protected:
  std::string Save(const Bytes& bytes, std::size_t size) {
    const std::string path = (folder_.path() / "run.mcap").string();
    std::ofstream(path, std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(size));
    return path;
  }

  const base::TemporaryFolder folder_ = base::TemporaryFolder::Make("gsv-test").value();
};

// A user may act at any time, for example stop the run during a step. So the time of a user's
// action does not show at which step the run ended.
TEST(EndOfSteps, IgnoresUserActionsAndWallClockTopics) {
  Bytes bytes;
  MemorySink sink(bytes);
  McapFileWriter writer(sink, {});
  ASSERT_TRUE(writer.AddSchema(SchemaOfClock()));
  ChannelRecord status = ChannelOf(1, "/gsv/status");
  status.metadata["reproducible"] = "false";
  ASSERT_TRUE(writer.AddChannel(ChannelOf(0, "/gsv/poses")));
  ASSERT_TRUE(writer.AddChannel(status));
  ASSERT_TRUE(writer.AddChannel(ChannelOf(2, "/gsv/events")));
  const Bytes data = ClockMessage(0ms);
  for (const std::uint16_t channel : {0, 1, 2}) {
    const base::SimTime time = channel * 10ms + 70ms;
    ASSERT_TRUE(writer.Write({channel, 0, time, time, data}));
  }
  ASSERT_TRUE(writer.Close());
  EXPECT_EQ(EndOfSteps(**Open(bytes)).value(), base::SimTime(70ms));
}

TEST_F(RecordingInfoTest, PrintsTheSameAsJsonAndAsText) {
  const Bytes bytes = ThreeChunks();
  const std::string path = Save(bytes, bytes.size());
  const auto info = ReadInfo(path);
  ASSERT_TRUE(info) << info.error().Sentence();
  const auto json = nlohmann::json::parse(ToJson(*info));
  EXPECT_EQ(json["file"], path);
  EXPECT_EQ(json["size_bytes"], bytes.size());
  EXPECT_DOUBLE_EQ(json["duration_s"], 0.29);
  EXPECT_DOUBLE_EQ(json["start_s"], 0.0);
  EXPECT_EQ(json["messages"], 30);
  EXPECT_EQ(json["chunks"], 3);
  EXPECT_EQ(json["indexed"], true);
  EXPECT_EQ(json["profile"], "ros2");
  EXPECT_EQ(json["content_hash"], ContentHash(**Open(bytes)).value());
  EXPECT_EQ(json["channels"],
            nlohmann::json::parse(
                R"([{"topic": "/even", "type": "rosgraph_msgs/msg/Clock", "messages": 15},
                    {"topic": "/odd", "type": "rosgraph_msgs/msg/Clock", "messages": 15}])"));
  EXPECT_EQ(json["attachments"],
            nlohmann::json::parse(
                R"([{"name": "world.sdf", "media_type": "application/xml", "size_bytes": 6}])"));
  EXPECT_EQ(json["metadata"], nlohmann::json::parse(R"({"gsv": {"seed": "7"}})"));
  EXPECT_EQ(json["warnings"], nlohmann::json::array());

  const std::string text = ToText(*info);
  EXPECT_THAT(text, HasSubstr("0.290 s"));
  EXPECT_THAT(text, HasSubstr("/even  (rosgraph_msgs/msg/Clock)"));
  EXPECT_THAT(text, HasSubstr("gsv: seed = 7"));
}

TEST_F(RecordingInfoTest, ReportsTheDamageOfATruncatedRecording) {
  const Bytes bytes = ThreeChunks();
  const auto info = ReadInfo(Save(bytes, bytes.size() / 2));
  ASSERT_TRUE(info) << info.error().Sentence();
  EXPECT_FALSE(info->indexed);
  EXPECT_THAT(ToText(*info), HasSubstr("warning: the whole recording was read because "
                                       "it was not closed"));
}

TEST_F(RecordingInfoTest, PrintsValidJsonForAnyNames) {
  Bytes bytes;
  MemorySink sink(bytes);
  McapFileWriter writer(sink, {});
  ASSERT_TRUE(writer.AddMetadata({"\xff\xfe", {{"\"", "\x80"}}}));
  ASSERT_TRUE(writer.Close());
  const auto info = ReadInfo(Save(bytes, bytes.size()));
  ASSERT_TRUE(info);
  EXPECT_TRUE(nlohmann::json::accept(ToJson(*info)));
}

}  // namespace
}  // namespace gsv::recording
