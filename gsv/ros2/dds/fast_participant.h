// The participant by Fast DDS 2.9.
#pragma once

#include <memory>

#include "gsv/ros2/dds/participant.h"

namespace gsv::ros2::dds {

// Fails when the domain is out of range or no socket can be had. Removes ROS_DISCOVERY_SERVER from the
// environment, which would take the place of `options`, and logs that.
base::Result<std::unique_ptr<Participant>> MakeFastParticipant(const ParticipantOptions& options);

}  // namespace gsv::ros2::dds
