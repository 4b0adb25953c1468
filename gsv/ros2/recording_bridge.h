// A recording in ROS 2: its messages go out on their topics as its time advances, and /clock with them.
//
// The file is untrusted input. Topics get valid names; those whose messages are not CDR are left out.
//
// Threads  its own.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "gsv/ros2/dds/participant.h"
#include "gsv/ros2/options.h"

namespace gsv::ros2 {

class RecordingBridge {
 public:
  // The position of the replay, and its speed in recorded seconds per second.
  struct Position {
    base::SimTime time{};
    double speed = 1;
  };

  // Opens the recording a second time. `participant` outlives the bridge. `position` is called on the bridge's thread.
  // After a jump, messages from there on are published. Fails as McapReader::Open() does.
  static base::Result<std::unique_ptr<RecordingBridge>> Start(dds::Participant& participant,
                                                              Distro distro,
                                                              const std::string& path,
                                                              std::function<Position()> position);
  virtual ~RecordingBridge() = default;
};

// The topic under which a recorded one is published: each part with the characters that ROS names can have.
std::string PublishedTopic(const std::string& recorded);

}  // namespace gsv::ros2
