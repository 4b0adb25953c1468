#include "gsv/recording/reading/recover.h"

#include <filesystem>
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
using testing::IsEmpty;
using testing::SizeIs;

Bytes Recovered(std::span<const std::byte> bytes, Recovery& recovery) {
  Bytes out;
  MemorySink sink(out);
  const auto reader = Open(bytes);
  EXPECT_TRUE(reader);
  auto result = Recover(**reader, sink);
  EXPECT_TRUE(result);
  recovery = std::move(*result);
  return out;
}

TEST(Recover, WritesAnIndexedFileWithEachCompleteChunk) {
  const Bytes bytes = ThreeChunks();
  std::vector<std::size_t> chunk_ends;
  for (const FoundRecord& place : FindRecords(bytes)) {
    if (place.opcode == Opcode::kChunk) chunk_ends.push_back(place.end);
  }
  ASSERT_THAT(chunk_ends, SizeIs(3));
  for (std::size_t size = kMagic.size(); size < bytes.size(); ++size) {
    Recovery recovery;
    const Bytes out = Recovered(std::span(bytes).first(size), recovery);
    const auto whole = static_cast<std::uint64_t>(
        std::ranges::count_if(chunk_ends, [&](std::size_t end) { return end <= size; }));
    EXPECT_EQ(recovery.messages, 10 * whole) << size;
    EXPECT_THAT(recovery.problems, testing::Not(IsEmpty())) << size;
    const auto reader = Open(out);
    ASSERT_TRUE(reader);
    EXPECT_TRUE((*reader)->summary().indexed);
    EXPECT_THAT((*reader)->summary().problems, IsEmpty());
    EXPECT_EQ(TimesIn(**reader).times.size(), 10 * whole);
  }
}

TEST(Recover, KeepsAllMessagesIfOnlyTheEndIsMissing) {
  const Bytes bytes = ThreeChunks();
  Recovery recovery;
  const Bytes out = Recovered(std::span(bytes).first(bytes.size() - 1), recovery);
  EXPECT_EQ(recovery.messages, 30U);
  EXPECT_EQ(recovery.attachments, 1U);
  EXPECT_EQ(recovery.metadata, 1U);
  EXPECT_EQ(ContentHash(**Open(out)).value(), ContentHash(**Open(bytes)).value());
  EXPECT_THAT(ToText(recovery),
              HasSubstr("recovered 30 messages, 1 attachment, 1 metadata record\n"));
  const auto json = nlohmann::json::parse(ToJson(recovery));
  EXPECT_EQ(json["messages"], 30);
  EXPECT_THAT(json["warnings"][0], HasSubstr("it was not closed"));
}

TEST(Recover, ReportsTheLossOfADamagedChunk) {
  Bytes bytes = ThreeChunks();
  for (const FoundRecord& place : FindRecords(bytes)) {
    if (place.opcode == Opcode::kChunk) bytes[place.end - 5] ^= std::byte{1};
  }
  Recovery recovery;
  Recovered(bytes, recovery);
  EXPECT_EQ(recovery.messages, 0U);
  EXPECT_THAT(recovery.problems, SizeIs(3));
  EXPECT_THAT(recovery.problems[0].Sentence(), HasSubstr("a chunk is damaged"));
}

class RecoverFiles : public testing::Test {
 protected:
  void SetUp() override {
    const Bytes bytes = ThreeChunks();
    std::ofstream(Path("in.mcap"), std::ios::binary)
        .write(reinterpret_cast<const char*>(bytes.data()),
               static_cast<std::streamsize>(bytes.size() - 100));
  }
  std::string Path(const char* name) const { return (folder_.path() / name).string(); }

  const base::TemporaryFolder folder_ = base::TemporaryFolder::Make("gsv-test").value();
};

TEST_F(RecoverFiles, WritesOnlyTheOutputFile) {
  const auto recovery = Recover(Path("in.mcap"), Path("out.mcap"));
  ASSERT_TRUE(recovery) << recovery.error().Sentence();
  EXPECT_EQ(recovery->messages, 30U);
  EXPECT_TRUE(McapReader::Open(Path("out.mcap")).value()->summary().indexed);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder_.path()), {}), 2);
}

TEST_F(RecoverFiles, DoesNotOverwriteAFile) {
  const auto recovery = Recover(Path("in.mcap"), Path("in.mcap"));
  ASSERT_FALSE(recovery);
  EXPECT_THAT(recovery.error().Sentence(), HasSubstr("exists already"));
}

}  // namespace
}  // namespace gsv::recording
