// Attaches the files of the world and the robots (SDFormat, URDF) to a recording.
//
// Attachments  `world/FILE`, and `robots/FOLDER/FILE` once for the model of each robot and avatar.
//              The media type is application/xml. If two attachments would have the same name, the
//              later attachment is named `robots/2/…`.
// Limits       files above 4 MiB, and files after the hundredth, are skipped with a warning.
#pragma once

#include <set>
#include <string>

#include "gsv/recording/mcap/mcap_writer.h"
#include "gsv/world/snapshot.h"

namespace gsv::recording {

inline constexpr std::uintmax_t kMaxSourceBytes = std::uintmax_t{4} << 20;
inline constexpr std::size_t kMaxSources = 100;

// Attaches the files of the world and the robots to one recording.
class SourceAttachments {
 public:
  // `writer` must outlive this object.
  explicit SourceAttachments(McapWriter& writer) : writer_(writer) {}

  // Attaches the file of the world, if it has one.
  void AttachWorld(const model::WorldDescription& world);
  // Attaches the files of new robots.
  void AttachRobots(const world::Snapshot& snapshot);

 private:
  void Attach(const std::string& source, const std::string& folder, const std::string& name,
              base::SimTime time);

  McapWriter& writer_;
  std::set<std::string> sources_;  // sources that were already processed
  std::set<std::string> names_;    // names of the attachments so far
};

}  // namespace gsv::recording
