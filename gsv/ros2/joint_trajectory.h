// A trajectory of joints: positions at given times. MoveIt and ros2_control send such trajectories.
// Positions between these times are interpolated.
//
// Source   trajectory_msgs/msg/JointTrajectory; ros2_controllers, "Trajectory Representation": the
//          interpolation is linear if the points have no velocities, and cubic (Hermite) if they
//          have.
// Units    rad and rad/s, or m and m/s for sliding joints.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/sim_time.h"
#include "gsv/model/model.h"

namespace gsv::ros2 {

// A decoded trajectory.
struct JointTrajectory {
  static constexpr std::size_t kMaxPoints = 100'000;  // longer trajectories are refused

  struct Point {
    base::SimTime time{};            // time after the start; increases from point to point
    std::vector<double> positions;   // one position for each joint
    std::vector<double> velocities;  // one velocity for each joint, or empty
  };

  std::optional<base::SimTime> start;  // empty for an immediate start
  std::vector<int> joints;             // indices of the joints in the model
  std::vector<Point> points;           // if empty, the joints stay where they are

  // Returns the positions at a time after the start. Before the first point, they are interpolated
  // from `initial`, the positions at the start. After the last point, they do not change.
  std::vector<double> PositionsAt(base::SimTime time, const std::vector<double>& initial) const;
};

// Reads a JointTrajectory for some of `joints`. `sample` is untrusted input. Fails with kCorrupt if
// the sample cannot be decoded, and with kInvalidArgument if names, counts, times or values are
// wrong.
base::Result<JointTrajectory> ReadJointTrajectory(std::span<const std::byte> sample,
                                                  const model::Model& model,
                                                  const std::vector<int>& joints);

}  // namespace gsv::ros2
