// Implements Participant with Fast DDS 2.9.
#pragma once

#include <memory>

#include "gsv/ros2/dds/participant.h"

namespace gsv::ros2::dds {

// Fails if the domain is out of range or no socket is available. Removes ROS_DISCOVERY_SERVER from
// the environment, because this variable would override `options`, and logs the removal.
base::Result<std::unique_ptr<Participant>> MakeFastParticipant(const ParticipantOptions& options);

}  // namespace gsv::ros2::dds
