// A summary of a recording, as `gsv rec info` prints it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::recording {

// Topics with the actions of users. A user may act at any time, also after the last step.
inline constexpr std::string_view kUserTopics[]{"/gsv/events", "/rosout", "/gsv/edits"};

struct RecordingInfo {
  struct Channel {
    std::string topic;
    std::string type;  // such as "sensor_msgs/msg/Range"
    std::uint64_t messages = 0;
  };
  struct File {
    std::string name;
    std::string media_type;
    std::uint64_t size = 0;
  };

  std::string path;
  std::uint64_t size = 0;  // in bytes
  std::string profile;
  std::string library;
  base::SimTime start{};  // time of the first message
  base::SimTime end{};    // time of the last message
  std::uint64_t messages = 0;
  std::uint64_t chunks = 0;       // number of chunks
  bool indexed = false;           // whether the file has a valid summary
  std::vector<Channel> channels;  // ordered by topic
  std::vector<File> attachments;
  std::vector<MetadataRecord> metadata;
  std::string content_hash;  // empty if there is no hash; `problems` gives the reason
  base::Problems problems;

  base::SimTime duration() const { return end - start; }
};

// Reads the whole file, because of the content hash.
[[nodiscard]] base::Result<RecordingInfo> ReadInfo(const std::string& path,
                                                   const Limits& limits = {});

// The time of the newest message about the simulation's steps. Ignores actions of users
// (kUserTopics) and topics that depend on the wall clock. Returns 0 if there is no such message.
[[nodiscard]] base::Result<base::SimTime> EndOfSteps(const McapReader& reader);

// Returns a text for users, which ends in a newline.
std::string ToText(const RecordingInfo& info);
// Returns one JSON object with the keys file, size_bytes, duration_s, start_s, end_s, messages,
// chunks, indexed, profile, library, content_hash, channels:[{topic, type, messages}],
// attachments:[{name, media_type, size_bytes}], metadata:{NAME:{key:value}}, warnings:[…].
std::string ToJson(const RecordingInfo& info);

}  // namespace gsv::recording
