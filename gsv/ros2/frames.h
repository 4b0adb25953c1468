// The frames of one robot in ROS 2: PREFIXodom → PREFIXBASE → links → sensors, by REP-105.
//
// All frame names of the robot begin with PREFIX, see Frames(). BASE names the model's frame. If
// the frame of the canonical link equals the model's frame, BASE is this link's name. Otherwise,
// BASE is base_link, or base_footprint if a link has the name base_link. If neither BASE nor a link
// has the name base_link, AppendStatic() adds a frame PREFIXbase_link that equals the model's
// frame. So there is always a frame PREFIXbase_link.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gsv/messages/tf2_msgs.h"
#include "gsv/model/model.h"
#include "gsv/model/sensor_description.h"
#include "gsv/world/snapshot.h"

namespace gsv::ros2 {

inline constexpr std::string_view kRosWorldFrame = "world";

// The names of one robot's frames, and the transforms between them.
class Frames {
 public:
  // `prefix` is prepended to frame names; it is empty or ends with a slash.
  Frames(std::string prefix, const model::Model& model);

  std::string odom() const { return prefix_ + "odom"; }
  const std::string& base() const { return base_; }  // PREFIXBASE; see the top of this file
  std::string OfLink(const model::Model& model, int link) const;
  // Returns the frame of a sensor. This is the link's frame if sensor and link have equal poses.
  // Otherwise, it is the sensor's own frame.
  std::string OfSensor(const model::Model& model, const model::SensorDescription& sensor) const;

  // Appends the transforms base → fixed links and links → sensors (and optical frames, if any).
  void AppendStatic(const model::Model& model, const std::vector<model::SensorDescription>& sensors,
                    const std::vector<bool>& is_optical, base::SimTime time,
                    messages::tf2_msgs::TFMessage& message) const;
  // Appends the transforms odom → base and base → moving links.
  void AppendMoving(const world::Snapshot& snapshot, int body, bool has_odometry,
                    messages::tf2_msgs::TFMessage& message) const;

 private:
  bool IsMoving(int link) const;

  const std::string prefix_;
  const std::vector<int> moving_;  // links
  std::string base_;               // name of the base frame, with the prefix
};

// Returns the pose of a robot according to its wheel odometry.
geometry::Pose OdometryPose(const world::Odometry& odometry);

}  // namespace gsv::ros2
