#include "apps/gsv/running/film.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "apps/gsv/running/ffmpeg.h"
#include "apps/gsv/running/image_file.h"
#include "gsv/rendering/images/apng.h"

namespace gsv::app {
namespace {

using base::ErrorCode;
using base::Fail;

enum class FilmKind { kWebm, kMp4, kApng, kFolder, kUnknown };

FilmKind KindOfFilm(const std::filesystem::path& path) {
  const std::string extension = path.extension();
  if (extension == ".webm") return FilmKind::kWebm;
  if (extension == ".mp4") return FilmKind::kMp4;
  if (extension == ".apng") return FilmKind::kApng;
  return extension.empty() ? FilmKind::kFolder : FilmKind::kUnknown;
}

// Owns the file of a film. The destructor removes the file unless the film was completed.
class UnfinishedFile {
 public:
  explicit UnfinishedFile(std::string path) : path_(std::move(path)) {}
  ~UnfinishedFile() {
    std::error_code ignored;
    if (!is_complete_) std::filesystem::remove_all(path_, ignored);
  }
  UnfinishedFile(const UnfinishedFile&) = delete;
  UnfinishedFile& operator=(const UnfinishedFile&) = delete;
  void Complete() { is_complete_ = true; }
  const std::string& path() const { return path_; }

 private:
  const std::string path_;
  bool is_complete_ = false;
};

class VideoFilm final : public Film {
 public:
  VideoFilm(std::unique_ptr<Ffmpeg> encoder, const std::string& path)
      : file_(path), encoder_(std::move(encoder)) {}

  base::Status Add(const model::Image& image) override {
    return encoder_->Write(image.pixels) ? base::Status() : NotWritten();
  }
  base::Status Finish() override {
    if (!encoder_->Finish()) return NotWritten();
    file_.Complete();
    return {};
  }

 private:
  base::Status NotWritten() const {
    return Fail(ErrorCode::kUnavailable, "ffmpeg could not write the video; its messages are above",
                file_.path());
  }

  UnfinishedFile file_;  // outlives the encoder, which writes this file
  const std::unique_ptr<Ffmpeg> encoder_;
};

class ApngFilm final : public Film {
 public:
  explicit ApngFilm(const FilmOptions& options)
      : file_(options.output),
        encoder_(static_cast<std::uint32_t>(options.frames), options.frames_a_second) {
    errno = 0;
    stream_.open(options.output, std::ios::binary);
    open_error_ = errno;
  }

  base::Status Add(const model::Image& image) override {
    const auto bytes = encoder_.Add(image);
    return bytes ? Write(*bytes) : Fail(bytes.error());
  }
  base::Status Finish() override {
    if (auto written = Write(rendering::ApngEncoder::End()); !written) return written;
    file_.Complete();
    return {};
  }

 private:
  base::Status Write(const std::vector<std::uint8_t>& bytes) {
    errno = 0;
    stream_.write(reinterpret_cast<const char*>(bytes.data()),
                  static_cast<std::streamsize>(bytes.size()));
    if (stream_.flush()) return {};
    const int error = stream_.is_open() ? errno : open_error_;
    return Fail(ErrorCode::kUnavailable,
                "cannot write the film: " + std::string(std::strerror(error)), file_.path());
  }

  UnfinishedFile file_;
  rendering::ApngEncoder encoder_;
  std::ofstream stream_;
  int open_error_ = 0;  // errno
};

class FolderFilm final : public Film {
 public:
  explicit FolderFilm(const std::string& path) : folder_(path) {}

  base::Status Add(const model::Image& image) override {
    return WriteImage(image, fmt::format("{}/{:06}.png", folder_.path(), ++frames_));
  }
  base::Status Finish() override {
    folder_.Complete();
    return {};
  }

 private:
  UnfinishedFile folder_;
  std::uint64_t frames_ = 0;
};

base::Result<std::unique_ptr<Film>> StartVideo(const FilmOptions& options, FilmKind kind) {
  const std::vector<std::string> codec =
      kind == FilmKind::kMp4
          ? std::vector<std::string>{"-c:v", "libx264", "-crf", "18", "-movflags", "+faststart"}
          : std::vector<std::string>{"-c:v",      "libvpx-vp9", "-crf",      "24", "-b:v",    "0",
                                     "-deadline", "good",       "-cpu-used", "5",  "-row-mt", "1"};
  auto encoder = Ffmpeg::Start(options.ffmpeg,
                               {"-f", "rawvideo", "-pix_fmt", "rgb24", "-s",
                                fmt::format("{}x{}", options.width, options.height), "-framerate",
                                fmt::format("{}", options.frames_a_second)},
                               codec, options.output, "write to NAME.apng or to a folder");
  if (!encoder) return Fail(encoder.error());
  return std::make_unique<VideoFilm>(*std::move(encoder), options.output);
}

}  // namespace

std::string CheckFilmName(const std::string& path) {
  if (KindOfFilm(path) != FilmKind::kUnknown) return {};
  return "the name of a film must end with .webm, .mp4 or .apng, or be that of a new folder, but " +
         path + " does not";
}

base::Result<std::unique_ptr<Film>> Film::Start(const FilmOptions& options) {
  if (const std::string problem = CheckFilmName(options.output); !problem.empty()) {
    return Fail(ErrorCode::kInvalidArgument, problem);
  }
  std::error_code error;
  if (std::filesystem::exists(options.output, error)) {
    return Fail(ErrorCode::kInvalidArgument, "the file exists already; choose another name",
                options.output);
  }
  const FilmKind kind = KindOfFilm(options.output);
  if (kind == FilmKind::kApng) return std::make_unique<ApngFilm>(options);
  if (kind != FilmKind::kFolder) return StartVideo(options, kind);
  if (!std::filesystem::create_directory(options.output, error)) {
    return Fail(ErrorCode::kUnavailable, "cannot make the folder: " + error.message(),
                options.output);
  }
  return std::make_unique<FolderFilm>(options.output);
}

}  // namespace gsv::app
