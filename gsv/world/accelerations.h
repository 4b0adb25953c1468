// Computes the mean accelerations of bodies and joints over a step. These functions do the work of
// KeepVelocities() and FinishAccelerations() (snapshot.h), but only for a range of bodies or
// joints. So several threads can process the bodies of a large world.
//
// Threads  calls for different bodies may run concurrently.
#pragma once

#include <span>

#include "gsv/world/snapshot.h"

namespace gsv::world {

// Both spans of each function have the same length.
void KeepBodyVelocities(std::span<const BodyState> bodies, std::span<Acceleration> kept);
void FinishBodyAccelerations(std::span<const BodyState> bodies, double step_seconds,
                             std::span<Acceleration> accelerations);
void FinishJointAccelerations(std::span<const double> velocities, double step_seconds,
                              std::span<double> accelerations);

}  // namespace gsv::world
