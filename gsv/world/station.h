// Stations: objects with sensors, such as a camera on a wall or a lidar on a post. A station has an
// agent like a robot, for its sensors (ADR 042).
#pragma once

#include "gsv/world/layout.h"

namespace gsv::world {

// A station has an agent as a robot has, which reads its sensors; there is nothing to drive
// (ADR 042).
inline bool IsStation(const Body& body) { return !body.is_robot() && !body.model->sensors.empty(); }

// Whether the body's sensors are read, recorded and shown: it is a robot, an avatar or a station.
inline bool HasAgent(const Body& body) { return body.is_robot() || IsStation(body); }

}  // namespace gsv::world
