// Publishes a recording in ROS 2: its messages and /clock, as its time advances.
//
// The file is untrusted input. Topics get valid names. Topics whose messages are not in CDR are
// omitted.
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

  // Opens the recording a second time. `participant` must outlive the bridge. `position` is called
  // on the bridge's thread. After a jump, the messages from the new position on are published.
  // Fails as McapReader::Open() does.
  static base::Result<std::unique_ptr<RecordingBridge>> Start(dds::Participant& participant,
                                                              Distro distro,
                                                              const std::string& path,
                                                              std::function<Position()> position);
  virtual ~RecordingBridge() = default;
};

// Returns the name under which a recorded topic is published. In each part, characters that are not
// allowed in ROS names are replaced.
std::string PublishedTopic(const std::string& recorded);

}  // namespace gsv::ros2
