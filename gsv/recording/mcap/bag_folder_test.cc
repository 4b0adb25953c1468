#include "gsv/recording/mcap/bag_folder.h"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "gsv/base/text_file.h"
#include "gsv/recording/testing/test_recording.h"

namespace gsv::recording {
namespace {

namespace fs = std::filesystem;

class BagFolder : public ::testing::Test {
 public:
  BagFolder() : folder_(fs::path(::testing::TempDir()) / ("bag_" + Name())) {
    fs::remove_all(folder_);
  }
  ~BagFolder() override { fs::remove_all(folder_); }

 protected:
  static std::string Name() {
    return ::testing::UnitTest::GetInstance()->current_test_info()->name();
  }
  const fs::path folder_;
};

TEST_F(BagFolder, ContainsARecordingAndItsMetadata) {
  const auto file = MakeBagFolder(folder_.string() + "/");
  ASSERT_TRUE(file) << file.error().Sentence();
  const std::string name = folder_.filename().string() + "_0.mcap";
  EXPECT_EQ(fs::path(*file).filename(), name);
  const Bytes bytes = ThreeChunks();
  std::ofstream(*file, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<long>(bytes.size()));
  ASSERT_TRUE(WriteBagMetadata(*file));

  const auto bag = nlohmann::json::parse(
      base::ReadTextFile(folder_ / "metadata.yaml"))["rosbag2_bagfile_information"];
  EXPECT_EQ(bag["version"], 5);
  EXPECT_EQ(bag["storage_identifier"], "mcap");
  EXPECT_EQ(bag["message_count"], 30);
  EXPECT_EQ(bag["duration"]["nanoseconds"], 290'000'000);
  EXPECT_EQ(bag["relative_file_paths"][0], name);
  ASSERT_EQ(bag["topics_with_message_count"].size(), 2u);
  EXPECT_EQ(bag["topics_with_message_count"][0]["topic_metadata"]["type"],
            "rosgraph_msgs/msg/Clock");
  EXPECT_EQ(bag["topics_with_message_count"][1]["message_count"], 15);

  const auto reader = McapReader::Open(folder_.string());
  ASSERT_TRUE(reader) << reader.error().Sentence();
  EXPECT_EQ((*reader)->summary().message_count, 30u);
}

TEST_F(BagFolder, FailsIfTheFolderExists) {
  ASSERT_TRUE(MakeBagFolder(folder_));
  const auto again = MakeBagFolder(folder_);
  ASSERT_FALSE(again);
  EXPECT_NE(again.error().message.find("already exists"), std::string::npos);
  EXPECT_FALSE(MakeBagFolder(folder_ / "no" / "such"));
}

TEST_F(BagFolder, FolderWithoutARecordingIsAnError) {
  ASSERT_TRUE(MakeBagFolder(folder_));
  EXPECT_FALSE(McapReader::Open(folder_.string()));
}

}  // namespace
}  // namespace gsv::recording
