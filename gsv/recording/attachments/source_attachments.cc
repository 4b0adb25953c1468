#include "gsv/recording/attachments/source_attachments.h"

#include <filesystem>
#include <fstream>
#include <iterator>

#include "gsv/base/log.h"

namespace gsv::recording {
namespace {

constexpr const char* kMediaType = "application/xml";

base::Result<std::string> ReadSource(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(path, error);
  if (error) return base::Fail(base::ErrorCode::kUnavailable, error.message(), path);
  if (size > kMaxSourceBytes) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "a file of " + std::to_string(size) + " bytes is too large to be attached",
                      path);
  }
  std::ifstream file(path, std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  if (!file.bad() && text.size() <= kMaxSourceBytes) return text;
  return base::Fail(base::ErrorCode::kUnavailable, "cannot be read", path);
}

}  // namespace

void SourceAttachments::AttachWorld(const model::WorldDescription& world) {
  const std::filesystem::path path = world.source;
  Attach(world.source, "world/", path.filename().string(), {});
}

void SourceAttachments::AttachRobots(const world::Snapshot& snapshot) {
  for (const world::Body& body : snapshot.layout->bodies) {
    if (!body.is_robot()) continue;
    const std::filesystem::path path = body.model->source;
    const std::string folder = path.parent_path().filename().string();
    Attach(body.model->source, "robots/",
           folder.empty() ? path.filename().string() : folder + "/" + path.filename().string(),
           snapshot.state.time);
  }
}

void SourceAttachments::Attach(const std::string& source, const std::string& folder,
                               const std::string& name, base::SimTime time) {
  if (source.empty() || !sources_.insert(source).second) return;
  if (names_.size() == kMaxSources) {
    return spdlog::warn("the recording contains the files of the first {} worlds and robots only",
                        kMaxSources);
  }
  const auto text = ReadSource(source);
  if (!text) return spdlog::warn("the recording will not contain {}", text.error().Sentence());
  std::string unique = folder + name;
  for (int number = 2; !names_.insert(unique).second; ++number) {
    unique = folder + std::to_string(number) + "/" + name;
  }
  writer_.Attach({time, {}, unique, kMediaType, std::as_bytes(std::span(*text))});
}

}  // namespace gsv::recording
