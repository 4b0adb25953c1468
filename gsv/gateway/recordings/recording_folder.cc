#include "gsv/gateway/recordings/recording_folder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <tuple>
#include <utility>

#include "gsv/base/sorting.h"
#include "gsv/recording/mcap/bag_folder.h"
#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::gateway::recordings {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMaxListed = 1000;
constexpr std::size_t kMaxTextBytes = 1000;
constexpr const char* kFailuresFolder = "gsv-failures";

// Whether the recording was finished: whether the file ends with the magic bytes. The content of an
// unfinished file is not listed, because the whole file would have to be read.
bool IsFinished(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::array<char, recording::kMagic.size()> end{};
  in.seekg(-static_cast<std::streamoff>(end.size()), std::ios::end);
  in.read(end.data(), end.size());
  return in && std::equal(end.begin(), end.end(), recording::kMagic.begin(),
                          [](char a, std::byte b) { return static_cast<std::byte>(a) == b; });
}

// Returns the value as a number; nullopt if it is not a number.
std::optional<double> NumberIn(const recording::StringMap& values, const std::string& key) {
  const auto found = values.find(key);
  if (found == values.end()) return std::nullopt;
  char* end = nullptr;
  const double number = std::strtod(found->second.c_str(), &end);
  const bool is_number = end != found->second.c_str() && *end == '\0' && std::isfinite(number);
  return is_number ? std::optional(number) : std::nullopt;
}

std::string TextIn(const recording::StringMap& values, const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? "" : found->second.substr(0, kMaxTextBytes);
}

void AddMetadata(const recording::McapReader& reader, RecordingLine& line) {
  for (const recording::MetadataIndexRecord& index : reader.summary().metadata) {
    if (index.name != "gsv.simulation" && index.name != "gsv.result") continue;
    const auto record = reader.Read(index);
    if (!record) continue;
    const recording::StringMap& values = record->values;
    if (index.name == "gsv.simulation") {
      line.world = TextIn(values, "world");
      const auto robots = NumberIn(values, "robots");
      if (robots && *robots >= 0 && *robots <= 1e9) {
        line.robots = static_cast<std::uint64_t>(*robots);
      }
    } else {
      line.verdict = TextIn(values, "verdict");
      line.sentence = TextIn(values, "sentence");
      line.violation_s = NumberIn(values, "violation_s");
    }
  }
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
  AddMetadata(**reader, line);
  return line;
}

}  // namespace

bool RecordingFolder::IsName(const std::string& name) const {
  const std::string failures = std::string(kFailuresFolder) + "/";
  if (only_.empty() && name.starts_with(failures)) {
    const std::string below = name.substr(failures.size());
    return below.find('/') == std::string::npos && IsName(below);
  }
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
    const bool is_bag = fs::is_regular_file(fs::symlink_status(path / "metadata.yaml", error));
    file = is_bag ? fs::path(recording::RecordingFile(path)) : path / "run.mcap";
  }
  const bool is_file =
      file.extension() == ".mcap" && fs::is_regular_file(fs::symlink_status(file, error));
  return is_file ? file : fs::path();
}

base::Result<std::string> RecordingFolder::Find(const std::string& name) const {
  std::error_code error;
  const bool is_below = name.find('/') != std::string::npos;
  const bool is_link =
      is_below && fs::is_symlink(fs::symlink_status(folder_ / kFailuresFolder, error));
  if (IsName(name) && !is_link) {
    if (const fs::path file = FileOf(folder_ / name); !file.empty()) return file.string();
  }
  return base::Fail(base::ErrorCode::kNotFound,
                    "there is no recording '" + name.substr(0, 200) +
                        "' in this server's folder; open the list of recordings again");
}

RecordingLine RecordingFolder::Describe(const std::string& name, const fs::path& file) {
  RecordingLine line;
  line.name = name;
  std::error_code error;
  line.size = fs::file_size(file, error);
  if (error) line.size = 0;  // the file was removed in the meantime
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
  const auto look_into = [&](const fs::path& folder, const std::string& prefix) {
    std::error_code error;
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error)) {
      const std::string name = prefix + entry->path().filename().string();
      if (!IsName(name)) continue;
      fs::path file = FileOf(entry->path());
      if (file.empty()) continue;
      std::error_code ignored;
      found.push_back({fs::last_write_time(file, ignored), name, std::move(file)});
    }
  };
  look_into(folder_, "");
  std::error_code ignored;
  const fs::path failures = folder_ / kFailuresFolder;
  if (only_.empty() && fs::is_directory(fs::symlink_status(failures, ignored))) {
    look_into(failures, std::string(kFailuresFolder) + "/");
  }
  base::Sort(found, [](const Found& a, const Found& b) {
    return std::tie(b.modified, a.name) < std::tie(a.modified, b.name);
  });
  Listing listing;
  listing.left_out = found.size() - std::min(found.size(), kMaxListed);
  found.resize(found.size() - listing.left_out);
  for (const Found& each : found) listing.lines.push_back(Describe(each.name, each.file));
  const base::MutexLock lock(mutex_);
  std::erase_if(known_, [&](const auto& entry) {
    return std::none_of(found.begin(), found.end(),
                        [&](const Found& each) { return each.name == entry.first; });
  });
  return listing;
}

}  // namespace gsv::gateway::recordings
