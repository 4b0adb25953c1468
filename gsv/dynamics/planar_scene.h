// What the planar mover derives from a layout: who moves, with what footprint, past which
// obstacles.
//
// Levels   obstacles are sliced once for each distinct interval of heights that a piece of some
//          footprint takes up: from what the robot can drive over (ClimbHeight above its lowest
//          point) or the piece's own lowest point, whichever is higher, to the piece's highest
//          point. So a floor that a robot stands on, a ground plane and a door sill are no
//          obstacles, and a table is one only to what reaches its top or its legs. Beyond
//          kMaxLevels distinct intervals, their ends are rounded up to a grid just coarse enough.
// Caching  slices are kept while obstacles and the heights of robots stay where they are; nothing
//          depends on whether they were kept.
#pragma once

#include <memory>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/dynamics/drive_kinematics.h"
#include "gsv/dynamics/footprint.h"
#include "gsv/dynamics/obstacle_field.h"
#include "gsv/world/state.h"

namespace gsv::dynamics {

struct Mover {
  int body = 0;  // index in the layout; movers are in the order of bodies
  std::shared_ptr<const DriveKinematics> kinematics;
  std::shared_ptr<const Footprint> footprint;
  double climb = 0;
  double spin_radius = 0;   // no part moves faster than speed + spin_radius * turning rate
  std::vector<int> levels;  // of each piece; -1: too low to run into obstacles
};

class PlanarScene {
 public:
  static constexpr int kMaxLevels = 64;

  // Refuses drives that make no sense and poses that are not finite.
  base::Status SetLayout(std::shared_ptr<const world::Layout> layout);

  // Slices anew what has moved since the last call.
  void Prepare(const world::State& state);

  const world::Layout& layout() const { return *layout_; }
  const std::vector<Mover>& movers() const { return movers_; }
  const ObstacleField& field(int level) const { return fields_[level]; }
  // The height of a mover's origin, as last prepared.
  double height(std::size_t mover) const { return heights_[mover]; }

 private:
  bool IsCurrent(const world::State& state) const;
  std::vector<Interval> AssignLevels();
  void SliceLevels(const std::vector<Interval>& levels, const world::State& state);

  std::shared_ptr<const world::Layout> layout_;
  std::vector<Mover> movers_;
  std::vector<int> standing_;                   // bodies that are no movers
  std::vector<geometry::Pose> standing_poses_;  // as sliced
  std::vector<double> heights_;                 // of movers, as sliced
  std::vector<ObstacleField> fields_;
  bool sliced_ = false;
};

}  // namespace gsv::dynamics
