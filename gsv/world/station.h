// Stations: objects with sensors, such as a camera on a wall or a lidar on a post. A station has an
// agent for its sensors, like a robot (ADR 042).
#pragma once

#include "gsv/world/layout.h"

namespace gsv::world {

// Whether the body is a station. A station has no drive. It has an agent, which reads its sensors
// (ADR 042).
inline bool IsStation(const Body& body) { return !body.is_robot() && !body.model->sensors.empty(); }

// Whether the body has an agent: it is a robot, avatar or station.
inline bool HasAgent(const Body& body) { return body.is_robot() || IsStation(body); }

}  // namespace gsv::world
