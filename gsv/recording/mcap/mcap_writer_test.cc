#include "gsv/recording/mcap/mcap_writer.h"

#include <future>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "gsv/base/temporary_folder.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/recording/testing/test_recording.h"

namespace gsv::recording {
namespace {

using messages::SchemaOf;
using messages::rosgraph_msgs::Clock;
using messages::sensor_msgs::Range;
using testing::AllOf;
using testing::HasSubstr;

// A sink in memory that writes only when the test allows it, and reports calls of Sync().
class GatedSink : public ByteSink {
 public:
  GatedSink(Bytes& out, std::shared_future<void> open, std::promise<void>* synced = nullptr)
      : out_(out), open_(std::move(open)), synced_(synced) {}
  base::Status Write(std::span<const std::byte> bytes) override {
    open_.wait();
    PutBytes(out_, bytes);
    return {};
  }
  base::Status Sync() override {
    if (synced_ != nullptr) std::exchange(synced_, nullptr)->set_value();
    return {};
  }
  base::Status Truncate(std::uint64_t size) override {
    out_.resize(size);
    return {};
  }

 private:
  Bytes& out_;
  std::shared_future<void> open_;
  std::promise<void>* synced_;
};

std::shared_future<void> Opened() {
  std::promise<void> promise;
  promise.set_value();
  return promise.get_future().share();
}

TEST(McapWriter, RecordsTheMessagesOfSeveralThreads) {
  Bytes bytes;
  McapWriter writer(std::make_unique<GatedSink>(bytes, Opened()), {});
  std::vector<ChannelId> channels;
  for (const char* topic : {"/a", "/b", "/c"}) {
    const auto channel = writer.AddChannel(topic, SchemaOf<Clock>());
    ASSERT_TRUE(channel);
    channels.push_back(*channel);
  }
  {
    std::vector<std::jthread> producers;
    producers.reserve(channels.size());
    for (const ChannelId channel : channels) {
      producers.emplace_back([&writer, channel] {
        for (int i = 0; i < 20'000; ++i) writer.Write(channel, i * 1ms, ClockMessage(i * 1ms));
      });
    }
  }
  ASSERT_TRUE(writer.Close());
  EXPECT_EQ(writer.progress().messages, 60'000U);
  EXPECT_EQ(writer.progress().dropped, 0U);
  EXPECT_EQ(writer.progress().bytes, bytes.size());

  const auto reader = Open(bytes);
  ASSERT_TRUE(reader);
  std::map<std::uint16_t, std::uint32_t> next;
  for (const MessageBlock& block : (*reader)->summary().blocks) {
    const auto content = (*reader)->Messages(block);
    ASSERT_TRUE(content);
    for (const MessageRecord& message : content->messages) {
      ASSERT_EQ(message.sequence, next[message.channel_id]++);
      ASSERT_EQ(message.log_time, message.sequence * 1ms);
    }
  }
  for (const ChannelId channel : channels) EXPECT_EQ(next[channel], 20'000U);
}

TEST(McapWriter, CreatesOneChannelOfOneTypePerTopic) {
  Bytes bytes;
  McapWriter writer(std::make_unique<GatedSink>(bytes, Opened()), {});
  const auto first = writer.AddChannel("/sonar", SchemaOf<Range>());
  const auto other = writer.AddChannel("/other", SchemaOf<Range>());
  ASSERT_TRUE(first && other);
  EXPECT_NE(*first, *other);
  EXPECT_EQ(writer.AddChannel("/sonar", SchemaOf<Range>()).value(), *first);
  const auto clash = writer.AddChannel("/sonar", SchemaOf<Clock>());
  ASSERT_FALSE(clash);
  EXPECT_THAT(clash.error().Sentence(),
              AllOf(HasSubstr("/sonar"), HasSubstr("rosgraph_msgs/msg/Clock")));
}

TEST(McapWriter, FlushesWithoutBeingClosed) {
  Bytes bytes;
  std::promise<void> synced;
  McapWriter writer(std::make_unique<GatedSink>(bytes, Opened(), &synced), {});
  writer.Write(*writer.AddChannel("/clock", SchemaOf<Clock>()), 5ms, ClockMessage(5ms));
  writer.FlushIfOlderThan(std::chrono::hours(1));  // does nothing: no message is an hour old
  writer.FlushIfOlderThan(std::chrono::seconds(0));
  synced.get_future().wait();
  const Bytes on_disk = bytes;  // the writer's thread still waits for more messages
  const auto reader = Open(on_disk);
  ASSERT_TRUE(reader);
  EXPECT_THAT(TimesIn(**reader).times, testing::ElementsAre(5ms));
}

TEST(McapWriter, DropsAndCountsMessagesIfTheDiskIsSlow) {
  Bytes bytes;
  std::promise<void> open;
  McapWriter writer(std::make_unique<GatedSink>(bytes, open.get_future().share()),
                    {.queue_size = 10'000});
  const ChannelId channel = *writer.AddChannel("/clock", SchemaOf<Clock>());
  for (int i = 0; i < 5'000; ++i) writer.Write(channel, i * 1ms, ClockMessage(i * 1ms));
  const McapWriter::Progress progress = writer.progress();
  EXPECT_GT(progress.dropped, 0U);
  EXPECT_EQ(progress.messages + progress.dropped, 5'000U);
  open.set_value();
  ASSERT_TRUE(writer.Close());

  const auto reader = Open(bytes);
  ASSERT_TRUE(reader);
  EXPECT_EQ((*reader)->summary().message_count, progress.messages);
  ASSERT_EQ((*reader)->summary().metadata.size(), 1U);
  const auto metadata = (*reader)->Read((*reader)->summary().metadata[0]);
  ASSERT_TRUE(metadata);
  EXPECT_EQ(metadata->values.at("dropped_messages"), std::to_string(progress.dropped));
}

TEST(McapWriter, WaitsForASlowDiskIfConfigured) {
  Bytes bytes;
  std::promise<void> open;
  McapWriter writer(std::make_unique<GatedSink>(bytes, open.get_future().share()),
                    {.when_full = WhenFull::kWait, .queue_size = 10'000});
  const ChannelId channel = *writer.AddChannel("/clock", SchemaOf<Clock>());
  std::jthread producer([&] {
    for (int i = 0; i < 5'000; ++i) writer.Write(channel, i * 1ms, ClockMessage(i * 1ms));
  });
  open.set_value();
  producer.join();
  ASSERT_TRUE(writer.Close());
  EXPECT_EQ(writer.progress().messages, 5'000U);
  EXPECT_EQ(Open(bytes).value()->summary().message_count, 5'000U);
}

TEST(McapWriter, WritesManyTopicsThatFillTheQueue) {
  Bytes bytes;
  McapWriter writer(std::make_unique<GatedSink>(bytes, Opened()),
                    {.when_full = WhenFull::kWait, .queue_size = 1'000});
  ChannelId channel = 0;
  for (int i = 0; i < 50; ++i) {
    channel = *writer.AddChannel("/topic" + std::to_string(i), SchemaOf<Clock>());
  }
  writer.Write(channel, 0ms, ClockMessage(0ms));  // waits for space in the queue
  ASSERT_TRUE(writer.Close());
  EXPECT_EQ(Open(bytes).value()->summary().channels.size(), 50U);
  EXPECT_EQ(Open(bytes).value()->summary().message_count, 1U);
}

TEST(McapWriter, EndsTheRecordingIfTheDiskHangs) {
  Bytes bytes;
  std::promise<void> open;
  McapWriter writer(std::make_unique<GatedSink>(bytes, open.get_future().share()),
                    {.when_full = WhenFull::kWait, .queue_size = 1'000, .wait_limit = 1ms});
  const ChannelId channel = *writer.AddChannel("/clock", SchemaOf<Clock>());
  while (!writer.failed()) writer.Write(channel, 0ms, ClockMessage(0ms));
  EXPECT_THAT(writer.status().error().Sentence(), HasSubstr("does not keep up"));
  open.set_value();
  EXPECT_FALSE(writer.Close());
}

TEST(McapWriter, FullDiskEndsTheRecordingWithAnError) {
  auto writer = McapWriter::Create("/dev/full");
  ASSERT_TRUE(writer) << writer.error().Sentence();
  const ChannelId channel = *(*writer)->AddChannel("/clock", SchemaOf<Clock>());
  (*writer)->Write(channel, 0ms, ClockMessage(0ms));
  const base::Status status = (*writer)->Close();
  ASSERT_FALSE(status);
  EXPECT_EQ(status.error().code, base::ErrorCode::kUnavailable);
  EXPECT_EQ(status.error().Sentence(),
            "/dev/full: cannot write the recording: No space left on device; free some space and "
            "start another recording");
  EXPECT_TRUE((*writer)->failed());
  const std::uint64_t accepted = (*writer)->progress().messages;  // 0 or 1
  (*writer)->Write(channel, 1ms, ClockMessage(1ms));              // discarded
  EXPECT_EQ((*writer)->progress().messages, accepted);
}

TEST(McapWriter, ReplacesARecordingOnlyIfRequested) {
  const auto folder = base::TemporaryFolder::Make("gsv-test");
  ASSERT_TRUE(folder);
  const std::string path = folder->path() / "run.mcap";
  { ASSERT_TRUE(McapWriter::Create(path)); }
  const auto again = McapWriter::Create(path);
  ASSERT_FALSE(again);
  EXPECT_THAT(again.error().Sentence(), AllOf(HasSubstr(path), HasSubstr("exists already")));
  EXPECT_TRUE(McapWriter::Create(path, {.replace = true}));
}

TEST(McapWriter, ReportsAFileThatItCannotCreate) {
  const auto writer = McapWriter::Create("/nonexistent/run.mcap");
  ASSERT_FALSE(writer);
  EXPECT_EQ(writer.error().Sentence(),
            "/nonexistent/run.mcap: cannot create the recording: No such file or directory");
}

}  // namespace
}  // namespace gsv::recording
