// What `gsv rec info` tells of a recording.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::recording {

// They tell what people do, whenever that is.
inline constexpr std::string_view kUserTopics[]{"/gsv/events", "/rosout", "/gsv/edits"};

struct RecordingInfo {
  struct Channel {
    std::string topic;
    std::string type;  // "sensor_msgs/msg/Range"
    std::uint64_t messages = 0;
  };
  struct File {
    std::string name;
    std::string media_type;
    std::uint64_t size = 0;
  };

  std::string path;
  std::uint64_t size = 0;  // bytes
  std::string profile;
  std::string library;
  base::SimTime start{};  // of the first message
  base::SimTime end{};    // of the last
  std::uint64_t messages = 0;
  std::uint64_t chunks = 0;
  bool indexed = false;
  std::vector<Channel> channels;  // by topic
  std::vector<File> attachments;
  std::vector<MetadataRecord> metadata;
  std::string content_hash;  // empty if it cannot be computed; then a problem tells why
  base::Problems problems;

  base::SimTime duration() const { return end - start; }
};

// Reads all of the file, for the content hash.
[[nodiscard]] base::Result<RecordingInfo> ReadInfo(const std::string& path,
                                                   const Limits& limits = {});

// Of the newest message that a simulation's steps brought: not of those that tell of people's
// doings (kUserTopics) or of the wall clock. 0: there is none.
[[nodiscard]] base::Result<base::SimTime> EndOfSteps(const McapReader& reader);

// For people: lines, the last one ending in a newline.
std::string ToText(const RecordingInfo& info);
// One JSON object: file, size_bytes, duration_s, start_s, end_s, messages, chunks, indexed,
// profile, library, content_hash, channels:[{topic, type, messages}],
// attachments:[{name, media_type, size_bytes}], metadata:{NAME:{key:value}}, warnings:[…].
std::string ToJson(const RecordingInfo& info);

}  // namespace gsv::recording
