#include "gsv/recording/mcap/chunk_ring.h"

#include <random>

#include <gtest/gtest.h>

#include "gsv/recording/testing/test_recording.h"

namespace gsv::recording {
namespace {

// Writes chunks with one message each, at 0, 10, 20, … ms. A message has `size` random bytes, which
// cannot be compressed.
class ChunkRingTest : public ::testing::Test {
 protected:
  explicit ChunkRingTest(std::size_t capacity = 1000)
      : ring_(std::make_shared<ChunkRing>(capacity)),
        sink_(ring_->MakeSink()),
        writer_(*sink_, {}) {
    (void)writer_.AddSchema(SchemaOfClock());
    (void)writer_.AddChannel(ChannelOf(0, "/clock"));
  }

  void WriteChunk(std::size_t size) {
    Bytes data(size);
    for (std::byte& byte : data) byte = static_cast<std::byte>(random_());
    (void)writer_.Write({0, next_, next_ * 10ms, next_ * 10ms, data});
    ++next_;
    (void)writer_.CloseChunk();
  }
  void Attach(const std::string& name, const std::string& text) {
    (void)writer_.Attach({next_ * 10ms, 0ms, name, "text/plain", AsBytes(text)});
  }
  std::vector<std::string> AttachedTexts() const {
    const auto reader = ring_->Open().value();
    std::vector<std::string> texts;
    for (const AttachmentIndexRecord& index : reader->summary().attachments) {
      const Bytes data = reader->Read(index).value().data;
      texts.emplace_back(reinterpret_cast<const char*>(data.data()), data.size());
    }
    return texts;
  }

  const std::shared_ptr<ChunkRing> ring_;
  const std::unique_ptr<ByteSink> sink_;
  McapFileWriter writer_;
  std::uint32_t next_ = 0;
  std::mt19937 random_{1};
};

TEST_F(ChunkRingTest, CanBeReadLikeARecording) {
  WriteChunk(100);
  WriteChunk(100);
  const auto reader = ring_->Open().value();
  EXPECT_EQ(TimesIn(*reader).times, (std::vector<base::SimTime>{0ms, 10ms}));
  EXPECT_EQ(reader->summary().start, 0ms);
  EXPECT_EQ(reader->summary().end, 10ms);
  EXPECT_EQ(reader->summary().message_counts.at(0), 2u);
  EXPECT_EQ(reader->summary().channels.at(0).topic, "/clock");
  EXPECT_EQ(reader->summary().schemas.at(1), SchemaOfClock());
}

TEST_F(ChunkRingTest, HasNothingToOpenBeforeTheFirstMessage) {
  EXPECT_EQ(ring_->Open().error().code, base::ErrorCode::kNotFound);
}

TEST_F(ChunkRingTest, DropsTheOldestChunksBeyondItsCapacity) {
  for (int i = 0; i < 20; ++i) WriteChunk(200);
  const ChunkRing::Extent extent = ring_->extent();
  EXPECT_LE(extent.bytes, 1000u);
  EXPECT_EQ(extent.messages, 20u);
  EXPECT_EQ(extent.end, 190ms);
  const auto reader = ring_->Open().value();
  const auto times = TimesIn(*reader);
  EXPECT_EQ(times.errors, 0);
  // A chunk has 200 bytes of data, and headers and indexes of less than 200 bytes. So two to four
  // chunks fit into the capacity of 1000 bytes.
  EXPECT_GE(times.times.size(), 2u);
  EXPECT_LE(times.times.size(), 4u);
  EXPECT_EQ(times.times.front(), extent.start);
  EXPECT_EQ(times.times.back(), 190ms);
}

TEST_F(ChunkRingTest, AReaderKeepsChunksThatAreDroppedLater) {
  WriteChunk(200);
  const auto reader = ring_->Open().value();
  for (int i = 0; i < 20; ++i) WriteChunk(200);
  EXPECT_EQ(TimesIn(*reader).times, (std::vector<base::SimTime>{0ms}));
  EXPECT_GT(ring_->extent().start, 0ms);
}

TEST_F(ChunkRingTest, KeepsTheNewestChunkEvenAboveTheCapacity) {
  WriteChunk(5000);
  WriteChunk(6000);
  EXPECT_EQ(TimesIn(*ring_->Open().value()).times, (std::vector<base::SimTime>{10ms}));
}

TEST_F(ChunkRingTest, DropsAttachmentsThatNoKeptChunkNeeds) {
  Attach("scene", "first");
  Attach("other", "single");
  WriteChunk(200);
  Attach("scene", "second");
  WriteChunk(200);
  EXPECT_EQ(AttachedTexts(), (std::vector<std::string>{"first", "single", "second"}));
  for (int i = 0; i < 20; ++i) WriteChunk(200);
  Attach("scene", "third");
  EXPECT_EQ(AttachedTexts(), (std::vector<std::string>{"single", "second", "third"}));
}

}  // namespace
}  // namespace gsv::recording
