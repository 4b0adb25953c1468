#include "apps/gsv/running/video_export.h"

#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/gsv/running/ffmpeg.h"
#include "gsv/messages/sensor_msgs.h"

namespace gsv::app {
namespace {

using base::ErrorCode;
using base::Fail;
using messages::sensor_msgs::CompressedImage;

// Limits the length of the video, because a recording may have wrong time stamps.
constexpr std::uint64_t kMaxFrames = 10'000'000;

class Exporter {
 public:
  Exporter(const recording::McapReader& reader, const recording::Selection& selection,
           const VideoOptions& options)
      : reader_(reader), selection_(selection), options_(options) {}

  base::Result<std::uint64_t> Run() {
    recording::MessageCursor cursor = reader_.Messages(selection_.from);
    for (;;) {
      const auto next = cursor.Next();
      if (!next) return Fail(next.error());
      if (!*next || (*next)->log_time > selection_.to) break;
      if (!selection_.Has(reader_.summary().channels.at((*next)->channel_id).topic)) continue;
      const auto image = messages::Decode<CompressedImage>((*next)->data);
      if (!image) return Fail(image.error());
      if (auto ok = Take((*next)->log_time, *image); !ok) return Fail(ok.error());
    }
    if (!encoder_) {
      return Fail(ErrorCode::kInvalidArgument,
                  "cannot make a video: the selected part has no images",
                  selection_.topics.front());
    }
    if (!encoder_->Write(shown_) || !encoder_->Finish()) return NotFinished();
    return frames_ + 1;
  }

 private:
  base::Status Take(base::SimTime time, const CompressedImage& image) {
    if (image.data.empty()) return {};
    if (!encoder_) {
      auto encoder = Ffmpeg::Start(
          options_.ffmpeg,
          {"-f", "image2pipe", "-framerate", fmt::format("{}", options_.frames_a_second), "-c:v",
           image.format == "png" ? "png" : "mjpeg"},
          {}, options_.output, "export the images without --video");
      if (!encoder) return Fail(encoder.error());
      encoder_ = *std::move(encoder);
      start_ = time;
      format_ = image.format;
    }
    if (image.format != format_) {
      return Fail(ErrorCode::kInvalidArgument,
                  "the images change from " + format_ + " to " + image.format +
                      "; export the times before and after with --from and --to");
    }
    const double due = base::ToSeconds(time - start_) * options_.frames_a_second;
    if (due > static_cast<double>(kMaxFrames)) {
      return Fail(ErrorCode::kInvalidArgument,
                  "the video would be too long; select a part with --from and --to");
    }
    // Repeats the previous image until the frame at which this image is due. The tolerance (1e-6 of
    // a frame) allows for rounding of the time stamps.
    for (; static_cast<double>(frames_) < due - 1e-6; ++frames_) {
      if (!encoder_->Write(shown_)) return NotFinished();
    }
    shown_ = image.data;
    return {};
  }

  base::Failure<base::Error> NotFinished() const {
    return Fail(ErrorCode::kUnavailable, "ffmpeg could not write the video; its messages are above",
                options_.output);
  }

  const recording::McapReader& reader_;
  const recording::Selection& selection_;
  const VideoOptions& options_;
  std::unique_ptr<Ffmpeg> encoder_;
  base::SimTime start_{};
  std::string format_;
  std::vector<std::uint8_t> shown_;  // the image of the next frame
  std::uint64_t frames_ = 0;         // number of written frames
};

}  // namespace

base::Result<std::uint64_t> ExportVideo(const recording::McapReader& reader,
                                        const recording::Selection& selection,
                                        const VideoOptions& options) {
  const recording::Summary& summary = reader.summary();
  for (const auto& [id, channel] : summary.channels) {
    if (!selection.Has(channel.topic)) continue;
    const auto schema = summary.schemas.find(channel.schema_id);
    const std::string type = schema == summary.schemas.end() ? "" : schema->second.name;
    if (type == messages::SchemaOf<CompressedImage>().name) continue;
    return Fail(
        ErrorCode::kInvalidArgument,
        "a video needs a topic of type sensor_msgs/msg/CompressedImage, but this one is of type " +
            type,
        channel.topic);
  }
  std::error_code ignored;
  if (std::filesystem::exists(options.output, ignored)) {
    return Fail(ErrorCode::kInvalidArgument, "the file exists already; choose another name",
                options.output);
  }
  return Exporter(reader, selection, options).Run();
}

}  // namespace gsv::app
