// While a recording is replayed, publishes its messages and /clock in ROS 2.
// The file is untrusted input. Topics are renamed to valid ROS names. Topics whose messages are not
// in CDR are omitted.
//
// Threads  publishes on a thread of its own.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "gsv/ros2/dds/participant.h"
#include "gsv/ros2/options.h"

namespace gsv::ros2 {

class RecordingBridge {
 public:
  // The position of the replay, and its speed (recorded seconds per second of wall-clock time).
  struct Position {
    base::SimTime time{};
    double speed = 1;
  };

  // Opens the recording a second time. `participant` must outlive the bridge. `position` is called
  // on the bridge's thread. After a seek, the messages after the new position are published. Fails
  // for the same reasons as McapReader::Open().
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
