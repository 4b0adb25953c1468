#include "apps/gsv/running/video_export.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

#include "gsv/base/temporary_folder.h"
#include "gsv/messages/rosgraph_msgs.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/recording/mcap/mcap_writer.h"

namespace gsv::app {
namespace {

using messages::sensor_msgs::CompressedImage;
using std::chrono::milliseconds;

// In these tests an image is a single letter. A program that stores its input replaces ffmpeg.
class VideoExportTest : public testing::Test {
 protected:
  VideoExportTest() {
    const std::filesystem::path path = folder_->path() / "ffmpeg";
    std::ofstream(path) << "#!/bin/sh\nfor last; do :; done\necho \"$@\" > \"$last.arguments\"\n"
                           "exec cat > \"$last\"\n";
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
    options_.ffmpeg = path;
    options_.output = folder_->path() / "out.mp4";
    options_.frames_a_second = 10;
  }

  void Record(const std::vector<std::pair<milliseconds, char>>& images,
              const std::string& format = "jpeg") {
    auto writer = recording::McapWriter::Create(path_, {.replace = true}).value();
    const auto clock =
        *writer->AddChannel("/clock", messages::SchemaOf<messages::rosgraph_msgs::Clock>());
    messages::Bytes bytes;
    messages::Encode(messages::rosgraph_msgs::Clock{}, bytes);
    writer->Write(clock, {}, bytes);
    const auto channel =
        *writer->AddChannel("/robot/camera", messages::SchemaOf<CompressedImage>());
    for (const auto& [time, letter] : images) {
      CompressedImage message;
      message.format = format;
      message.data = {static_cast<std::uint8_t>(letter)};
      bytes.clear();
      messages::Encode(message, bytes);
      writer->Write(channel, time, bytes);
    }
    ASSERT_TRUE(writer->Close());
  }

  base::Result<std::uint64_t> Export(recording::Selection selection = {{"/robot/camera"}}) const {
    const auto reader = recording::McapReader::Open(path_);
    return ExportVideo(**reader, selection, options_);
  }

  static std::string Text(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }

  const base::Result<base::TemporaryFolder> folder_ = base::TemporaryFolder::Make("gsv-test");
  const std::string path_ = folder_->path() / "run.mcap";
  VideoOptions options_;
};

TEST_F(VideoExportTest, FrameShowsTheNewestImageAtItsInstant) {
  Record({{milliseconds(1000), 'a'}, {milliseconds(1250), 'b'}, {milliseconds(1300), 'c'}});
  // The frames are at 1.0, 1.1, 1.2 and 1.3 s.
  EXPECT_EQ(Export().value(), 4u);
  EXPECT_EQ(Text(options_.output), "aaac");
  const std::string arguments = Text(options_.output + ".arguments");
  EXPECT_NE(arguments.find("-framerate 10 -c:v mjpeg -i -"), std::string::npos) << arguments;
}

TEST_F(VideoExportTest, AcceptsPngAndATimeRange) {
  Record({{milliseconds(0), 'a'}, {milliseconds(100), 'b'}, {milliseconds(200), 'c'}}, "png");
  EXPECT_EQ(Export({{"/robot/camera"}, milliseconds(100), milliseconds(150)}).value(), 1u);
  EXPECT_EQ(Text(options_.output), "b");
  EXPECT_NE(Text(options_.output + ".arguments").find("-c:v png"), std::string::npos);
}

TEST_F(VideoExportTest, MissingFfmpegIsReported) {
  Record({{milliseconds(0), 'a'}});
  options_.ffmpeg = "gsv-there-is-no-such-program";
  const auto frames = Export();
  ASSERT_FALSE(frames);
  EXPECT_EQ(frames.error().code, base::ErrorCode::kUnavailable);
  EXPECT_NE(frames.error().Sentence().find("Install it"), std::string::npos);
}

TEST_F(VideoExportTest, FailureOfFfmpegIsReported) {
  Record({{milliseconds(0), 'a'}});
  options_.ffmpeg = "false";
  EXPECT_NE(Export().error().Sentence().find("could not write the video"), std::string::npos);
}

TEST_F(VideoExportTest, RejectsTopicsWithoutImagesAndExistingFiles) {
  Record({});
  EXPECT_NE(Export().error().Sentence().find("has no images"), std::string::npos);
  EXPECT_NE(Export({{"/clock"}}).error().Sentence().find("rosgraph_msgs/msg/Clock"),
            std::string::npos);
  Record({{milliseconds(0), 'a'}});
  std::ofstream(options_.output) << "mine";
  EXPECT_NE(Export().error().Sentence().find("exists already"), std::string::npos);
  EXPECT_EQ(Text(options_.output), "mine");
}

}  // namespace
}  // namespace gsv::app
