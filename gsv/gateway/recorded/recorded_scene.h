// What a recording attaches for those who look at it: its scenes and its models.
//
// Input    hostile: an attachment is a file from somewhere.
// Threads  const members may run concurrently.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/gateway/foxglove/shared_bytes.h"
#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::gateway {

class RecordedScene {
 public:
  // Reads the scenes; one that makes no sense is left out and told of in problems(). `reader` must
  // outlive this.
  explicit RecordedScene(const recording::McapReader& reader);

  const base::Problems& problems() const { return problems_; }

  // As it was attached, for poses with this layout_version; else the first there is. kNotFound,
  // with a sentence, when the recording holds none.
  base::Result<SharedBytes> Scene(std::uint32_t layout_version) const;

  // The places of robots in a message gsv_msgs/Poses of that layout: body's name, index of its
  // pose.
  const std::map<std::string, std::size_t>& BodyPoses(std::uint32_t layout_version) const;

  // Whether one of the scenes has a body of this name.
  bool HasBody(const std::string& name) const;

  // The GLB file of a model. kNotFound.
  base::Result<SharedBytes> Model(const std::string& id) const;

 private:
  struct Entry {
    SharedBytes json;
    std::map<std::string, std::size_t> body_poses;
  };

  base::Status Add(const recording::AttachmentIndexRecord& index);
  void Warn(const base::Error& error);

  const recording::McapReader& reader_;
  std::map<std::uint32_t, Entry> scenes_;                           // by layout version
  std::map<std::string, recording::AttachmentIndexRecord> models_;  // by attachment's name
  base::Problems problems_;
};

}  // namespace gsv::gateway
