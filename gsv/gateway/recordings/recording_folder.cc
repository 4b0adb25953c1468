#include "gsv/gateway/recordings/recording_folder.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <tuple>
#include <utility>

#include "gsv/recording/mcap/bag_folder.h"
#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::gateway::recordings {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxListed = 1000;

// A finished file ends with the magic bytes. Any other file would have to be read as a whole.
bool IsFinished(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::array<char, recording::kMagic.size()> end{};
  in.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  in.read(end.data(), end.size());
  return in && std::equal(end.begin(), end.end(), recording::kMagic.begin(),
                          [](char a, std::byte b) { return static_cast<std::byte>(a) == b; });
}

RecordingLine WithContent(RecordingLine line, const fs::path& file) {
  if (!IsFinished(file)) {
    line.state = RecordingLine::State::kUnfinished;
    return line;
  }
  const auto reader = recording::McapReader::Open(file);
  if (!reader) {
    line.state = RecordingLine::State::kUnreadable;
    line.problem = reader.error().message;
    return line;
  }
  const recording::Summary& summary = (*reader)->summary();
  line.start = summary.start;
  line.end = summary.end;
  line.messages = summary.message_count;
  return line;
}

}  // namespace

bool RecordingFolder::IsName(const std::string& name) const {
  if (name.empty() || name.front() == '.' || name.find('/') != std::string::npos) return false;
  if (name.find('\0') != std::string::npos) return false;
  return only_.empty() || name == only_;
}

fs::path RecordingFolder::FileOf(const fs::path& path) const {
  std::error_code error;
  if (!only_.empty()) {
    const fs::path file = recording::RecordingFile(path);
    return fs::is_regular_file(file, error) ? file : fs::path();
  }
  const fs::file_status status = fs::symlink_status(path, error);
  fs::path file = path;
  if (fs::is_directory(status)) {
    if (!fs::is_regular_file(fs::symlink_status(path / "metadata.yaml", error))) return {};
    file = recording::RecordingFile(path);
  }
  const bool is_file =
      file.extension() == ".mcap" && fs::is_regular_file(fs::symlink_status(file, error));
  return is_file ? file : fs::path();
}

base::Result<std::string> RecordingFolder::Find(const std::string& name) const {
  if (IsName(name)) {
    if (const fs::path file = FileOf(folder_ / name); !file.empty()) return file.string();
  }
  return base::Fail(base::ErrorCode::kNotFound,
                    "there is no recording '" + name.substr(0, 200) +
                        "' here: it was moved or deleted, or belongs to another server");
}

RecordingLine RecordingFolder::Look(const std::string& name, const fs::path& file) {
  RecordingLine line;
  line.name = name;
  std::error_code error;
  line.size = fs::file_size(file, error);
  if (error) line.size = 0;  // the file was just removed
  const auto modified = fs::last_write_time(file, error);
  if (!error) {
    line.modified = std::chrono::time_point_cast<std::chrono::system_clock::duration>(
        std::chrono::file_clock::to_sys(modified));
  }
  const base::MutexLock lock(mutex_);
  const auto known = known_.find(name);
  if (known != known_.end() && known->second.size == line.size &&
      known->second.modified == line.modified) {
    return known->second;
  }
  return known_[name] = WithContent(line, file);
}

RecordingFolder::Listing RecordingFolder::List() {
  struct Found {
    fs::file_time_type modified;
    std::string name;
    fs::path file;
  };
  std::vector<Found> found;
  std::error_code error;
  for (fs::directory_iterator entry(folder_, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename();
    if (!IsName(name)) continue;
    fs::path file = FileOf(entry->path());
    if (file.empty()) continue;
    std::error_code ignored;
    found.push_back({fs::last_write_time(file, ignored), name, std::move(file)});
  }
  std::sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
    return std::tie(b.modified, a.name) < std::tie(a.modified, b.name);
  });
  Listing listing;
  listing.left_out = found.size() - std::min(found.size(), kMaxListed);
  found.resize(found.size() - listing.left_out);
  for (const Found& each : found) listing.lines.push_back(Look(each.name, each.file));
  const base::MutexLock lock(mutex_);
  std::erase_if(known_, [&](const auto& entry) {
    return std::none_of(found.begin(), found.end(),
                        [&](const Found& each) { return each.name == entry.first; });
  });
  return listing;
}

}  // namespace gsv::gateway::recordings
