#include "gsv/recording/mcap/mcap_reader.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/recording/mcap/compression.h"
#include "gsv/recording/testing/test_recording.h"

namespace gsv::recording {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::string AllProblems(const Summary& summary) {
  std::string text;
  for (const base::Problem& problem : summary.problems) text += problem.Sentence() + "\n";
  return text;
}

// Returns the start of a file with a schema and the channel 0. Tests append records that our writer
// never writes.
Bytes HeadOfForeignFile() {
  Bytes bytes(kMagic.begin(), kMagic.end());
  Append(bytes, HeaderRecord{"", "foreign"});
  Append(bytes, SchemaOfClock());
  Append(bytes, ChannelOf(0, "/clock"));
  return bytes;
}

TEST(McapReader, ReadsTheContentOfARecording) {
  const Bytes bytes = ThreeChunks();
  const auto reader = Open(bytes);
  ASSERT_TRUE(reader) << reader.error().Sentence();
  const Summary& summary = (*reader)->summary();
  EXPECT_TRUE(summary.indexed);
  EXPECT_THAT(summary.problems, IsEmpty());
  EXPECT_EQ(summary.profile, "ros2");
  EXPECT_EQ(summary.library, "gsv");
  EXPECT_EQ(summary.message_count, 30U);
  EXPECT_THAT(summary.message_counts,
              ElementsAre(std::pair(std::uint16_t{0}, 15U), std::pair(std::uint16_t{1}, 15U)));
  EXPECT_EQ(summary.start, 0ms);
  EXPECT_EQ(summary.end, 290ms);
  EXPECT_EQ(summary.channels.at(1).topic, "/odd");
  EXPECT_EQ(summary.schemas.at(1), SchemaOfClock());
  EXPECT_THAT(summary.blocks, SizeIs(3));
}

TEST(McapReader, ReadsAttachmentsAndMetadata) {
  const Bytes bytes = ThreeChunks();
  const auto reader = Open(bytes);
  ASSERT_TRUE(reader);
  ASSERT_THAT((*reader)->summary().attachments, SizeIs(1));
  const auto attachment = (*reader)->Read((*reader)->summary().attachments[0]);
  ASSERT_TRUE(attachment) << attachment.error().Sentence();
  EXPECT_EQ(attachment->name, "world.sdf");
  EXPECT_EQ(attachment->media_type, "application/xml");
  EXPECT_TRUE(std::ranges::equal(attachment->data, AsBytes("<sdf/>")));
  ASSERT_THAT((*reader)->summary().metadata, SizeIs(1));
  EXPECT_EQ((*reader)->Read((*reader)->summary().metadata[0]).value(),
            (MetadataRecord{"gsv", {{"seed", "7"}}}));
}

TEST(McapReader, ReadsMessagesFromAnyTimeOn) {
  const Bytes bytes = ThreeChunks();
  const auto reader = Open(bytes);
  ASSERT_TRUE(reader);
  EXPECT_THAT(TimesIn(**reader).times, SizeIs(30));
  EXPECT_THAT(TimesIn(**reader, 275ms).times, ElementsAre(280ms, 290ms));
  EXPECT_THAT(TimesIn(**reader, 290ms).times, ElementsAre(290ms));
  EXPECT_THAT(TimesIn(**reader, 291ms).times, IsEmpty());
}

TEST(McapReader, OrdersMessagesOfChunksThatOverlap) {
  Bytes bytes;
  MemorySink sink(bytes);
  McapFileWriter writer(sink, {});
  ASSERT_TRUE(writer.AddSchema(SchemaOfClock()));
  ASSERT_TRUE(writer.AddChannel(ChannelOf(0, "/clock")));
  for (const auto& chunk : {std::vector{50ms, 10ms, 90ms}, {20ms, 50ms}, {0ms}}) {
    for (const auto time : chunk) ASSERT_TRUE(writer.Write({0, 0, time, time, {}}));
    ASSERT_TRUE(writer.Flush());
  }
  ASSERT_TRUE(writer.Close());
  const auto reader = Open(bytes);
  ASSERT_TRUE(reader);
  EXPECT_THAT(TimesIn(**reader).times, ElementsAre(0ms, 10ms, 20ms, 50ms, 50ms, 90ms));

  const auto strict = Open(bytes, {.open_blocks_size = 100});
  ASSERT_TRUE(strict);
  EXPECT_GT(TimesIn(**strict).errors, 0);
}

TEST(McapReader, FindsTheSameContentByScanningAFileWithoutASummary) {
  const Bytes bytes = ThreeChunks();
  const auto indexed = Open(bytes);
  ASSERT_TRUE(indexed);
  const auto scanned = ScanForSummary(MemorySource(bytes), {});
  ASSERT_TRUE(scanned);
  const Summary& a = (*indexed)->summary();
  const Summary& b = *scanned;
  EXPECT_FALSE(b.indexed);
  EXPECT_THAT(b.problems, IsEmpty());
  EXPECT_EQ(a.profile, b.profile);
  EXPECT_EQ(a.schemas, b.schemas);
  EXPECT_EQ(a.channels, b.channels);
  EXPECT_EQ(a.message_counts, b.message_counts);
  EXPECT_EQ(a.start, b.start);
  EXPECT_EQ(a.end, b.end);
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    EXPECT_EQ(a.blocks[i].offset, b.blocks[i].offset);
    EXPECT_EQ(a.blocks[i].length, b.blocks[i].length);
  }
  ASSERT_THAT(b.attachments, SizeIs(1));
  EXPECT_EQ(a.attachments[0].offset, b.attachments[0].offset);
  EXPECT_EQ(a.attachments[0].length, b.attachments[0].length);
  EXPECT_EQ(a.attachments[0].data_size, b.attachments[0].data_size);
  ASSERT_THAT(b.metadata, SizeIs(1));
  EXPECT_EQ(a.metadata[0].offset, b.metadata[0].offset);
}

TEST(McapReader, ReadsMessagesOutsideOfChunks) {
  Bytes bytes = HeadOfForeignFile();
  for (const auto time : {30ms, 10ms, 20ms}) Append(bytes, MessageRecord{0, 0, time, time, {}});
  Append(bytes, DataEndRecord{});
  Append(bytes, FooterRecord{});
  PutBytes(bytes, kMagic);
  const auto reader = Open(bytes);
  ASSERT_TRUE(reader);
  EXPECT_THAT(AllProblems((*reader)->summary()), HasSubstr("it has no summary"));
  EXPECT_EQ((*reader)->summary().message_count, 3U);
  EXPECT_THAT(TimesIn(**reader).times, ElementsAre(10ms, 20ms, 30ms));
}

TEST(McapReader, ReadsChunksWithoutCompressionThatDefineTheirChannels) {
  Bytes records;
  Append(records, ChannelOf(5, "/inner"));
  Append(records, MessageRecord{5, 0, 10ms, 10ms, {}});
  Bytes bytes = HeadOfForeignFile();
  Append(bytes, ChunkRecord{10ms, 10ms, records.size(), 0, "", records});
  const auto reader = Open(bytes);
  ASSERT_TRUE(reader);
  EXPECT_EQ((*reader)->summary().channels.at(5).topic, "/inner");
  EXPECT_THAT(TimesIn(**reader).times, ElementsAre(10ms));
}

TEST(McapReader, ReportsAnUnknownCompression) {
  Bytes bytes = HeadOfForeignFile();
  Append(bytes, ChunkRecord{0ms, 0ms, 10, 0, "lz4", AsBytes("whatever")});
  const auto reader = Open(bytes);
  ASSERT_TRUE(reader);
  EXPECT_THAT(AllProblems((*reader)->summary()), HasSubstr("found 'lz4'"));
}

TEST(McapReader, RejectsFilesThatAreNotRecordings) {
  for (const std::string_view text : {"", "\x89MCAP", "<sdf version='1.9'/>"}) {
    const auto reader = Open(AsBytes(text));
    ASSERT_FALSE(reader) << text;
    EXPECT_EQ(reader.error().code, base::ErrorCode::kCorrupt);
    EXPECT_THAT(reader.error().Sentence(), HasSubstr("expected a recording"));
  }
  const auto missing = McapReader::Open("/nonexistent.mcap");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().code, base::ErrorCode::kNotFound);
}

TEST(McapReader, LimitsTheMemoryForADecompressedChunk) {
  const Bytes zeros(std::size_t{64} << 20);
  ZstdCompressor compressor(1);
  const std::span<const std::byte> packed = compressor.Compress(zeros);
  ASSERT_LT(packed.size(), zeros.size() / 1000);
  Bytes bytes = HeadOfForeignFile();
  Append(bytes, ChunkRecord{0ms, 0ms, zeros.size(), 0, "zstd", packed});
  // The declared size of this chunk is smaller than its real size.
  Append(bytes, ChunkRecord{0ms, 0ms, 100, 0, "zstd", packed});
  const auto reader = Open(bytes, {.record_size = 1 << 20});
  ASSERT_TRUE(reader);
  EXPECT_THAT((*reader)->summary().blocks, IsEmpty());
  EXPECT_THAT(AllProblems((*reader)->summary()), HasSubstr("expected chunks of at most 1048576"));
  EXPECT_THAT(AllProblems((*reader)->summary()),
              HasSubstr("its zstd frame declares another size than its header"));
}

TEST(McapReader, IgnoresASummaryWithOverlappingChunks) {
  Bytes bytes = HeadOfForeignFile();
  const std::uint64_t start = bytes.size();
  ChunkIndexRecord index{.chunk_offset = 8, .chunk_length = 20};
  Append(bytes, index);
  Append(bytes, index);
  Append(bytes, StatisticsRecord{.message_count = 1});
  Append(bytes, FooterRecord{start, 0, 0});
  PutBytes(bytes, kMagic);
  const auto reader = Open(bytes);
  ASSERT_TRUE(reader);
  EXPECT_FALSE((*reader)->summary().indexed);
  EXPECT_THAT(AllProblems((*reader)->summary()), HasSubstr("chunks overlap"));
}

TEST(McapReader, ReadsUpToZerosAtTheEndOfAFile) {
  Bytes bytes = ThreeChunks();
  const FoundRecord index = FindRecords(bytes)[7];  // the message index after the first chunk
  std::fill(bytes.begin() + static_cast<std::ptrdiff_t>(index.begin), bytes.end(), std::byte{0});
  const auto reader = Open(bytes);
  ASSERT_TRUE(reader);
  EXPECT_EQ((*reader)->summary().message_count, 10U);
  EXPECT_THAT(AllProblems((*reader)->summary()), HasSubstr("contains no records from here on"));
}

TEST(McapReader, ContinuesAfterADamagedChunk) {
  Bytes bytes = ThreeChunks();
  const std::vector<FoundRecord> places = FindRecords(bytes);
  ASSERT_EQ(places[9].opcode, Opcode::kChunk);
  bytes[places[9].end - 5] ^= std::byte{1};
  const auto reader = Open(bytes);
  ASSERT_TRUE(reader);
  EXPECT_TRUE((*reader)->summary().indexed);
  const Times found = TimesIn(**reader);
  EXPECT_EQ(found.errors, 1);
  EXPECT_THAT(found.times, SizeIs(20));
}

// A file with one flipped bit must not return a message that was not written.
TEST(McapReader, ReturnsNoWrongMessageForAnyFlippedBit) {
  Bytes bytes = ThreeChunks();
  for (std::size_t bit = 0; bit < bytes.size() * 8; ++bit) {
    const std::byte mask{static_cast<unsigned char>(1U << (bit % 8))};
    bytes[bit / 8] ^= mask;
    if (const auto reader = Open(bytes)) {
      const Summary& summary = (*reader)->summary();
      EXPECT_LE(TimesIn(**reader).times.size(), 30U);
      for (const auto& each : summary.attachments) {
        if (const auto attachment = (*reader)->Read(each)) {
          EXPECT_TRUE(std::ranges::equal(attachment->data, AsBytes("<sdf/>")));
        }
      }
      for (const auto& each : summary.metadata) (void)(*reader)->Read(each);
    }
    bytes[bit / 8] ^= mask;
  }
}

}  // namespace
}  // namespace gsv::recording
