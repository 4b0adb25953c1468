#include "apps/gsv/running/video_export.h"

#include <cerrno>
#include <csignal>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "gsv/messages/sensor_msgs.h"

namespace gsv::app {
namespace {

using base::ErrorCode;
using base::Fail;
using messages::sensor_msgs::CompressedImage;

// Limits the video of a recording with wrong time stamps.
constexpr std::uint64_t kMaxFrames = 10'000'000;

// Runs ffmpeg, which reads images from its standard input.
class Encoder {
 public:
  static base::Result<std::unique_ptr<Encoder>> Start(const VideoOptions& options,
                                                      const std::string& format) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) return Fail(ErrorCode::kUnavailable, "cannot make a pipe");
    std::vector<std::string> arguments{
        options.ffmpeg, "-hide_banner", "-loglevel", "error", "-n", "-f", "image2pipe",
        "-framerate", fmt::format("{}", options.frames_a_second), "-c:v",
        format == "png" ? "png" : "mjpeg", "-i", "-",
        // Most players require even side lengths and this pixel format.
        "-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-pix_fmt", "yuv420p", options.output};
    std::vector<char*> pointers;
    pointers.reserve(arguments.size() + 1);
    for (std::string& argument : arguments) pointers.push_back(argument.data());
    pointers.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
    pid_t pid = -1;
    const int failure =
        posix_spawnp(&pid, options.ffmpeg.c_str(), &actions, nullptr, pointers.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    close(ends[0]);
    if (failure != 0) {
      close(ends[1]);
      return Fail(ErrorCode::kUnavailable,
                  "cannot make a video: ffmpeg is not installed. Install it (apt-get install "
                  "ffmpeg), or export the images without --video");
    }
    return std::unique_ptr<Encoder>(new Encoder(pid, ends[1]));
  }

  ~Encoder() { (void)Finish(); }
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;

  // Returns false if ffmpeg accepts no more images.
  bool Write(const std::vector<std::uint8_t>& bytes) {
    for (std::size_t done = 0; done < bytes.size();) {
      const ssize_t size = write(input_, bytes.data() + done, bytes.size() - done);
      if (size < 0 && errno == EINTR) continue;
      if (size < 0) return false;
      done += static_cast<std::size_t>(size);
    }
    return true;
  }

  // Waits until the video is written. Returns whether that succeeded.
  bool Finish() {
    if (input_ >= 0) close(std::exchange(input_, -1));
    if (pid_ >= 0) waitpid(std::exchange(pid_, -1), &status_, 0);
    return WIFEXITED(status_) && WEXITSTATUS(status_) == 0;
  }

 private:
  Encoder(pid_t pid, int input) : pid_(pid), input_(input) {
    std::signal(SIGPIPE, SIG_IGN);  // the end of ffmpeg appears as an error of write()
  }

  pid_t pid_;
  int input_;
  int status_ = -1;
};

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
      auto encoder = Encoder::Start(options_, image.format);
      if (!encoder) return Fail(encoder.error());
      encoder_ = *std::move(encoder);
      start_ = time;
      format_ = image.format;
    }
    if (image.format != format_) {
      return Fail(ErrorCode::kInvalidArgument,
                  "the pictures change from " + format_ + " to " + image.format +
                      "; export the times before and after with --from and --to");
    }
    const double due = base::ToSeconds(time - start_) * options_.frames_a_second;
    if (due > static_cast<double>(kMaxFrames)) {
      return Fail(ErrorCode::kInvalidArgument,
                  "the video would be too long; select a part with --from and --to");
    }
    // Writes the frames before this image's instant. An image that is slightly early counts as
    // equal.
    for (; static_cast<double>(frames_) < due - 1e-6; ++frames_) {
      if (!encoder_->Write(shown_)) return NotFinished();
    }
    shown_ = image.data;
    return {};
  }

  tl::unexpected<base::Error> NotFinished() const {
    return Fail(ErrorCode::kUnavailable, "ffmpeg could not write the video; its messages are above",
                options_.output);
  }

  const recording::McapReader& reader_;
  const recording::Selection& selection_;
  const VideoOptions& options_;
  std::unique_ptr<Encoder> encoder_;
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
