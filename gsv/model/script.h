// The motion of an actor: SDFormat's <script> with its animation.
//
// Frames  a waypoint is a pose of the actor's frame in the frame of its trajectory. The actor's
//         <pose> is the pose of the trajectory's frame in the world.
#pragma once

#include <memory>
#include <vector>

#include "gsv/base/sim_time.h"
#include "gsv/geometry/pose.h"

namespace gsv::model {

// A pose of the actor and the time at which the actor reaches it.
struct Waypoint {
  base::SimTime time{0};  // time since the trajectory's start
  geometry::Pose pose;
};

// A path of the actor through waypoints.
struct Trajectory {
  std::vector<Waypoint> waypoints;  // times are strictly ascending; the first time is 0
  double tension = 0;               // in [0, 1]; 1 means straight lines between waypoints
  // interpolate_x: the gait follows the travelled distance (true) or the time (false)
  bool animated_by_distance = false;
};

// Joint positions of a model over time: a gait.
struct Animation {
  base::SimTime length{0};        // duration of one cycle, > 0; the animation repeats
  double distance = 0;            // distance that one cycle covers, m; 0 if unknown
  int joint_count = 0;            // number of joints of the model that the animation moves
  std::vector<double> positions;  // joint_count values for each of the evenly spaced keyframes
  int frame_count() const {
    return joint_count == 0 ? 0 : static_cast<int>(positions.size()) / joint_count;
  }
};

// The trajectories of an actor and the animation of its joints.
struct Script {
  bool loops = true;       // whether the script starts again after its last trajectory
  base::SimTime delay{0};  // the delay before each start; not negative
  // False: the actor stays at the start of its script (SDFormat's <auto_start>).
  bool starts_by_itself = true;
  std::vector<Trajectory> trajectories;        // executed one after the other; may be empty
  std::shared_ptr<const Animation> animation;  // null if joints do not move
};

// Returns the pose of the actor before its start, in the trajectory's frame.
inline geometry::Pose StartPose(const Script& script) {
  return script.trajectories.empty() ? geometry::Pose{}
                                     : script.trajectories.front().waypoints.front().pose;
}

}  // namespace gsv::model
