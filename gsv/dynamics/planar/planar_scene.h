// Data that the planar mover derives from a layout: obstacles, movers and their footprints. A mover
// is a body that planar kinematics moves.
//
// Levels   Obstacles are sliced once for each distinct range of heights of a piece of a footprint.
//          The range begins at the lowest point of the piece, but not below the height that the
//          robot can climb (ClimbHeight above its lowest point). It ends at the highest point of
//          the piece. So the floor, a ground plane and a door sill are no obstacles. A table is an
//          obstacle only for pieces that reach its top or its legs. If there are more than
//          kMaxLevels ranges, their ends are rounded to a grid.
// Dynamic  Rigid bodies and actors are separate obstacles. Only the rigid bodies and actors in the
//          sight of a mover are sliced. When one of them has moved, they are sliced again. A body
//          that extends less than kRides below the top of a piece lies on the robot and is not an
//          obstacle to it.
// Caching  Slices are kept while the obstacles and the heights of robots do not change. The result
//          does not depend on this.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/dynamics/motion/drive_kinematics.h"
#include "gsv/dynamics/shapes/footprint.h"
#include "gsv/dynamics/shapes/obstacle_field.h"
#include "gsv/world/state.h"

namespace gsv::dynamics {

// The margin of the obstacle fields beyond a footprint, in metres.
inline constexpr double kLookAround = 0.25;
inline constexpr double kRides = 0.005;  // m, see "Dynamic" above

// The properties that movers of one model share.
struct MoverKind {
  DriveKinematics kinematics;  // kinematics of the model's drive
  Footprint footprint;         // the model's shape as prisms, in the model's frame
  double climb = 0;            // see ClimbHeight(), m
  // m: no part of the mover is faster than speed + spin_radius * turning rate
  double spin_radius = 0;
};

// A body that the planar mover moves.
struct Mover {
  int body = 0;            // index of the body in the layout; movers are in the order of bodies
  std::uint32_t kind = 0;  // index of its MoverKind, see PlanarScene::kind()
  std::uint32_t first_level = 0;         // the first level of its pieces, see PlanarScene::level()
  int first_joint = 0, joint_count = 0;  // range of the body's joints in the state
};

// A disc of the plane in which a mover looks for obstacles.
struct Sight {
  Vector2 centre;     // in the world, m
  double radius = 0;  // m
};

// The movers of a layout, and slices of its bodies as obstacles for these movers.
class PlanarScene {
 public:
  static constexpr int kMaxLevels = 64;  // maximum number of levels, see "Levels" above

  // Returns an error for invalid drives and for poses that are not finite.
  base::Status SetLayout(std::shared_ptr<const world::Layout> layout);

  // Slices the static bodies at the poses in `state`, for movers at the heights in `state`.
  void Slice(const world::State& state);
  // Slices the dynamic obstacles that reach into one of the sights, if that is not yet done. The
  // levels are those of the last Slice().
  void SliceDynamicObstacles(const world::State& state, std::span<const Sight> sights);
  // Whether the slices of static bodies are valid: Slice() was called, and no static body has moved
  // since.
  bool HasValidSlices(const world::State& state) const;
  // Whether the mover had the height z at the last Slice().
  bool IsSlicedAtHeight(std::size_t mover, double z) const { return heights_[mover] == z; }

  const world::Layout& layout() const { return *layout_; }
  const std::vector<Mover>& movers() const { return movers_; }
  // The properties that the mover shares with all movers of its model.
  const MoverKind& kind(const Mover& mover) const { return kinds_[mover.kind]; }
  const Footprint& footprint(std::size_t mover) const {
    return kinds_[movers_[mover].kind].footprint;
  }
  // The level of a piece of the mover's footprint; -1 if it is too low to run into obstacles.
  int level(const Mover& mover, std::size_t piece) const {
    return levels_[mover.first_level + piece];
  }
  // The slices of static bodies at this level.
  const ObstacleField& field(int level) const { return fields_[level]; }
  // Whether there are dynamic obstacles: rigid bodies or actors.
  bool has_dynamic() const { return !dynamic_.empty(); }
  // The slices of dynamic obstacles at this level.
  const ObstacleField& dynamic_field(int level) const { return dynamic_fields_[level]; }
  // The height of a mover's origin at the last Slice(), m.
  double height(std::size_t mover) const { return heights_[mover]; }

 private:
  // Assigns each piece of a mover to a level. Returns the height intervals of the levels.
  std::vector<Interval> AssignLevels();
  // Slices the static bodies at each level.
  void SliceLevels(const world::State& state);
  // Returns, for each level, the largest radius of a mover plus kLookAround.
  std::vector<double> MarginsOfLevels() const;
  // Lists in `seen_` the dynamic obstacles that reach into one of the sights.
  void FindDynamicObstacles(const world::State& state, std::span<const Sight> sights);

  std::shared_ptr<const world::Layout> layout_;
  std::vector<MoverKind> kinds_;  // one for each model, and one for each tilted mover
  std::vector<Mover> movers_;
  std::vector<int> levels_;          // levels of all pieces of all movers, see level()
  std::vector<Interval> intervals_;  // height intervals of the levels
  std::vector<int> static_bodies_;   // bodies that are neither movers nor dynamic obstacles
  std::vector<geometry::Pose> static_poses_;   // poses of static bodies when they were sliced
  std::vector<double> heights_;                // heights of the movers at the last slicing
  std::vector<ObstacleField> fields_;          // static obstacles, one field per level
  std::vector<int> dynamic_;                   // indices of rigid bodies and actors
  std::vector<double> dynamic_radii_;          // radii of dynamic_ (DynamicRadius())
  std::vector<int> seen_;                      // indices of the sliced dynamic obstacles
  std::vector<double> dynamic_state_;          // bodies, poses and joints at the last slicing
  std::vector<ObstacleField> dynamic_fields_;  // dynamic obstacles, one field per level
  // Whether fields_ and dynamic_fields_ are valid for the layout.
  bool is_sliced_ = false, is_dynamic_sliced_ = false;
};

}  // namespace gsv::dynamics
