#include "gsv/recording/mcap/bag_folder.h"

#include <filesystem>
#include <fstream>

#include <nlohmann/json.hpp>

#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::recording {
namespace {

namespace fs = std::filesystem;
using nlohmann::ordered_json;

constexpr int kBagVersion = 5;

ordered_json TopicsOf(const Summary& summary) {
  ordered_json topics = ordered_json::array();
  for (const auto& [id, channel] : summary.channels) {
    const auto schema = summary.schemas.find(channel.schema_id);
    const auto count = summary.message_counts.find(id);
    topics.push_back(
        {{"topic_metadata",
          {{"name", channel.topic},
           {"type", schema == summary.schemas.end() ? "" : schema->second.name},
           {"serialization_format", channel.message_encoding},
           {"offered_qos_profiles", ""}}},
         {"message_count", count == summary.message_counts.end() ? 0 : count->second}});
  }
  return topics;
}

base::Error CannotWrite(const fs::path& path, const std::string& why) {
  return {base::ErrorCode::kUnavailable, "cannot be written: " + why, path};
}

}  // namespace

base::Result<std::string> MakeBagFolder(const std::string& folder) {
  const fs::path path = fs::path(folder).lexically_normal();
  const fs::path name = path.has_filename() ? path.filename() : path.parent_path().filename();
  std::error_code error;
  if (fs::exists(path, error)) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "already exists; choose another name for the recording", folder);
  }
  if (!fs::create_directory(path, error)) {
    return base::Fail(
        CannotWrite(path, error ? error.message() : "this is not a valid name for a folder"));
  }
  return (path / (name.string() + "_0.mcap")).string();
}

base::Status WriteBagMetadata(const std::string& file) {
  const auto reader = McapReader::Open(file);
  if (!reader) return base::Fail(reader.error());
  const Summary& summary = (*reader)->summary();
  const ordered_json start{{"nanoseconds_since_epoch", summary.start.count()}};
  const ordered_json duration{{"nanoseconds", (summary.end - summary.start).count()}};
  const std::string name = fs::path(file).filename();
  const ordered_json information{{"version", kBagVersion},
                                 {"storage_identifier", "mcap"},
                                 {"duration", duration},
                                 {"starting_time", start},
                                 {"message_count", summary.message_count},
                                 {"topics_with_message_count", TopicsOf(summary)},
                                 {"compression_format", ""},
                                 {"compression_mode", ""},
                                 {"relative_file_paths", {name}},
                                 {"files",
                                  {{{"path", name},
                                    {"starting_time", start},
                                    {"duration", duration},
                                    {"message_count", summary.message_count}}}}};
  const fs::path path = fs::path(file).parent_path() / "metadata.yaml";
  std::ofstream out(path);
  out << ordered_json{{"rosbag2_bagfile_information", information}}.dump(
             1, ' ', false, ordered_json::error_handler_t::replace)
      << '\n'
      << std::flush;
  if (!out) return base::Fail(CannotWrite(path, "the disk is full or cannot be written"));
  return {};
}

std::string RecordingFile(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return path;
  std::string first;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, error)) {
    if (entry.path().extension() != ".mcap") continue;
    if (first.empty() || entry.path().string() < first) first = entry.path();
  }
  return first.empty() ? path : first;
}

}  // namespace gsv::recording
