#include "gsv/recording/mcap/mcap_file_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/recording/mcap/compression.h"
#include "gsv/recording/testing/test_recording.h"

namespace gsv::recording {
namespace {

using testing::ElementsAre;
using testing::ElementsAreArray;
using testing::HasSubstr;

// A disk that has space for `room` bytes only.
class SmallDisk : public ByteSink {
 public:
  SmallDisk(Bytes& out, std::size_t room) : out_(out), room_(room) {}
  base::Status Write(std::span<const std::byte> bytes) override {
    const std::size_t left = room_ - out_.size();
    PutBytes(out_, bytes.first(std::min(bytes.size(), left)));
    if (bytes.size() <= left) return {};
    return base::Fail(base::ErrorCode::kUnavailable, "No space left on device", "disk");
  }
  base::Status Sync() override { return {}; }
  base::Status Truncate(std::uint64_t size) override {
    out_.resize(size);
    return {};
  }

 private:
  Bytes& out_;
  std::size_t room_;
};

TEST(Crc32, EqualsTheCrcOfZipAndPng) {
  // This is the check value of CRC-32/ISO-HDLC.
  EXPECT_EQ(Crc32(AsBytes("123456789")), 0xcbf43926U);
  EXPECT_EQ(Crc32(AsBytes("6789"), Crc32(AsBytes("12345"))), 0xcbf43926U);
  EXPECT_EQ(Crc32({}, 5), 5U);
}

// For 64 bytes or more, Crc32() uses a faster algorithm if the processor supports it.
TEST(Crc32, OfLongPiecesEqualsThatOfTheirBytes) {
  Bytes bytes;
  for (unsigned i = 0; i < 400; ++i) bytes.push_back(static_cast<std::byte>(i * i * 31 + (i >> 3)));
  const std::span<const std::byte> all(bytes);
  for (std::size_t begin = 0; begin < 5; ++begin) {
    std::uint32_t expected = 12345;
    for (std::size_t size = 0; begin + size < all.size(); ++size) {
      ASSERT_EQ(Crc32(all.subspan(begin, size), 12345), expected) << begin << " " << size;
      expected = Crc32(all.subspan(begin + size, 1), expected);
    }
  }
}

TEST(McapFileWriter, BeginsWithTheMagicAndAHeader) {
  Bytes bytes;
  MemorySink sink(bytes);
  const McapFileWriter writer(sink, {.profile = "ros2", .library = "x"});
  EXPECT_THAT(bytes, ElementsAreArray(AsBytes(std::string_view("\x89MCAP0\r\n"
                                                               "\x01\x0d\0\0\0\0\0\0\0"
                                                               "\4\0\0\0ros2\1\0\0\0x",
                                                               30))));
}

TEST(McapFileWriter, WritesTheSameChunkOfMessagesAndOfTheirRecords) {
  const auto recorded = [](bool as_records) {
    Bytes bytes, records;
    MemorySink sink(bytes);
    McapFileWriter writer(sink, {});
    EXPECT_TRUE(writer.AddSchema(SchemaOfClock()));
    EXPECT_TRUE(writer.AddChannel(ChannelOf(3, "/a")) && writer.AddChannel(ChannelOf(1, "/b")));
    for (const int ms : {40, 20, 60}) {
      const Bytes data = ClockMessage(ms * 1ms);
      const MessageRecord message{ms == 20 ? std::uint16_t{1} : std::uint16_t{3}, 0, ms * 1ms,
                                  ms * 1ms, data};
      EXPECT_TRUE(as_records || writer.Write(message));
      Append(records, message);
    }
    EXPECT_TRUE(!as_records || writer.WriteChunk(records));
    EXPECT_TRUE(writer.Close());
    return bytes;
  };
  const Bytes bytes = recorded(true);
  EXPECT_EQ(recorded(false), bytes);
  const auto reader = Open(bytes);
  ASSERT_TRUE(reader);
  EXPECT_THAT(TimesIn(**reader).times, ElementsAre(20ms, 40ms, 60ms));
}

TEST(McapFileWriter, WritesDefinitionsBeforeTheirUse) {
  const Bytes bytes = ThreeChunks();
  std::vector<Opcode> kinds;
  for (const FoundRecord& place : FindRecords(bytes)) kinds.push_back(place.opcode);
  using enum Opcode;
  EXPECT_THAT(kinds, ElementsAre(kHeader, kSchema, kChannel, kChannel, kMetadata, kAttachment,  //
                                 kChunk, kMessageIndex, kMessageIndex,                          //
                                 kChunk, kMessageIndex, kMessageIndex,                          //
                                 kChunk, kMessageIndex, kMessageIndex, kDataEnd,                //
                                 kSchema, kChannel, kChannel, kStatistics, kChunkIndex, kChunkIndex,
                                 kChunkIndex, kAttachmentIndex, kMetadataIndex,  //
                                 kSummaryOffset, kSummaryOffset, kSummaryOffset, kSummaryOffset,
                                 kSummaryOffset, kSummaryOffset, kFooter));
}

TEST(McapFileWriter, ClosesAChunkWhenItIsLargeEnough) {
  Bytes bytes;
  MemorySink sink(bytes);
  McapFileWriter writer(sink, {.chunk_size = 100});
  ASSERT_TRUE(writer.AddSchema(SchemaOfClock()));
  ASSERT_TRUE(writer.AddChannel(ChannelOf(0, "/clock")));
  const Bytes data = ClockMessage(0ms);
  // A message record has 9 + 22 + 12 bytes. So three records exceed the chunk size of 100.
  for (int i = 0; i < 7; ++i) ASSERT_TRUE(writer.Write({0, 0, 0ms, 0ms, data}));
  ASSERT_TRUE(writer.Close());
  const auto reader = Open(bytes);
  ASSERT_TRUE(reader);
  EXPECT_EQ((*reader)->summary().blocks.size(), 3U);
  EXPECT_EQ((*reader)->summary().message_count, 7U);
}

// For every size of the disk, all calls after the first error return that error. The chunks that
// were complete by then can be read.
TEST(McapFileWriter, KeepsCompleteChunksWhenTheDiskIsFull) {
  const std::size_t needed = ThreeChunks().size();
  std::size_t read_with_a_summary = 0;
  for (std::size_t room = 0; room < needed; room += 7) {
    Bytes bytes;
    SmallDisk disk(bytes, room);
    McapFileWriter writer(disk, {});
    (void)writer.AddSchema(SchemaOfClock());
    (void)writer.AddChannel(ChannelOf(0, "/clock"));
    std::uint64_t written = 0;
    for (int i = 0; i < 60 && writer.status(); ++i) {
      const Bytes data = ClockMessage(i * 1ms);
      (void)writer.Write({0, 0, i * 1ms, i * 1ms, data});
      if (i % 10 == 9 && writer.Flush()) written = static_cast<std::uint64_t>(i) + 1;
    }
    const base::Status status = writer.Close();
    ASSERT_FALSE(status) << room;
    EXPECT_THAT(status.error().Sentence(), HasSubstr("No space left on device"));
    EXPECT_EQ(writer.Flush().error().message, status.error().message);
    if (bytes.empty()) continue;
    const auto reader = Open(bytes);
    ASSERT_TRUE(reader) << reader.error().Sentence();
    EXPECT_EQ(TimesIn(**reader).times.size(), written) << room;
    read_with_a_summary += (*reader)->summary().indexed;
  }
  EXPECT_GT(read_with_a_summary, 0U);
}

}  // namespace
}  // namespace gsv::recording
