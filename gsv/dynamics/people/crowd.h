// Computes the commands of all pedestrians for the next step by the social force model
// (social_force.h). Planar kinematics then moves the pedestrians without overlaps.
//
// Others        Pedestrians avoid planar bodies, actors and rigid bodies. Each of these bodies acts
//               as a disc about its origin. Bodies with a radius above kMaxRadius are ignored.
// Walls         All static bodies are walls, sliced between kStep above a pedestrian's feet and its
//               top. Only the nearest point of each wall exerts a force. A point within 60 degrees
//               of a nearer one is ignored, so that a wall of many pieces acts as one wall.
// Goals         A pedestrian that is within kArrival of its goal has reached the goal. There is no
//               path planning.
// Heading       The body rotates towards its direction of motion.
// Threads       One thread at a time. The work runs on a thread team.
// Determinism   The result is a function of the layout, the state and the step.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "gsv/base/thread_team.h"
#include "gsv/dynamics/people/repulsions.h"
#include "gsv/dynamics/shapes/obstacle_field.h"
#include "gsv/dynamics/shapes/silhouette.h"
#include "gsv/world/pedestrian.h"
#include "gsv/world/state.h"

namespace gsv::dynamics {

// Computes the drive commands of all pedestrians.
class Crowd {
 public:
  static constexpr double kMaxRadius = 1.5;  // m; movable bodies with a larger radius are ignored
  static constexpr double kStep = 0.15;      // m
  static constexpr double kArrival = 1;      // m

  explicit Crowd(std::shared_ptr<base::ThreadTeam> team) : team_(std::move(team)) {}

  // Finds the pedestrians and the walls of a new layout.
  void SetLayout(std::shared_ptr<const world::Layout> layout);

  // Writes the commands of all pedestrians for a step that starts at state.time, and counts the
  // goals that they have reached.
  void Decide(base::SimTime step, world::State& state);

 private:
  // A pedestrian.
  struct Walker {
    int body = 0;                                   // index of the body in the layout
    const world::Pedestrian* pedestrian = nullptr;  // its settings; never null
    // index in levels_ of the heights at which walls are sliced for this pedestrian
    std::size_t level = 0;
    // The present goal, after `reached` goals have been reached. The goal is stored because it is
    // drawn at random only once.
    bool has_goal = false;
    std::uint32_t reached = 0;  // number of goals that the pedestrian has reached
    Vector2 goal;               // in the world, m
  };
  // A body that pedestrians avoid, also a pedestrian itself.
  struct Other {
    int body = 0;                   // index of the body in the layout
    int walker = -1;                // index of the walker; -1 for a body that is not a pedestrian
    double radius = 0, height = 0;  // radius of the disc, height of the body, m
    Vector2 at, velocity;  // position and velocity of the body's origin in the plane, world frame
    double z = 0;          // height of the body's origin, m
  };
  // Number of walkers in a batch. The forces of many pairs are computed together.
  static constexpr std::size_t kBlock = 64;
  // The working memory for one batch of walkers.
  struct Block {
    // For each walker of the batch: the direction to its goal, and the sum of forces on it.
    std::array<Vector2, kBlock> directions, forces;
    Repulsions repulsions;  // the pairs of this batch whose forces are computed together
  };

  // Computes the outlines of all walls again (slices of the static bodies) if a static body has
  // moved.
  void SliceWalls(const world::State& state);
  // Sorts others_ into the grid cells.
  void SortOthers(const world::State& state);
  // Sets the drive commands of the walkers with these indices. `left` is Relaxation(seconds).
  void DecideFor(std::span<const std::uint32_t> walkers, double seconds, double left, Block& block,
                 world::State& state);
  // Returns the direction to the walker's goal. If the walker has reached the goal, increments the
  // walker's count of reached goals.
  Vector2 DirectionOf(Walker& walker, world::State& state) const;
  // Adds the forces of all bodies in range on a walker. `index` is the walker's index in the block.
  void AddForcesOfOthers(const Walker& walker, std::uint32_t index, const world::BodyState& body,
                         Block& block) const;
  // Sets the walker's drive command from the direction of its goal and the sum of forces.
  void Command(const Walker& walker, Vector2 direction, Vector2 force, double seconds, double left,
               world::State& state) const;
  // Returns the force of all walls on a walker at this position.
  Vector2 ForceOfWalls(const Walker& walker, Vector2 at) const;

  const std::shared_ptr<base::ThreadTeam> team_;
  std::shared_ptr<const world::Layout> layout_;
  std::vector<Walker> walkers_;  // in the order of bodies

  std::vector<Interval> levels_;       // heights at which walls are sliced
  std::vector<ObstacleField> walls_;   // slices of the walls at each of levels_
  std::vector<int> standing_;          // static bodies, which are walls
  std::vector<geometry::Pose> poses_;  // poses of the bodies in standing_ when they were sliced
  bool is_sliced_ = false;             // whether walls_ are valid for the present layout

  std::vector<Other> others_;  // bodies that pedestrians avoid, in the order of bodies
  // The grid of others_. A cell is at least as wide as the range of the forces. The entries of a
  // cell are consecutive in sorted_.
  double left_ = 0, bottom_ = 0, per_cell_ = 1;  // minimum x and y, m; number of cells per metre
  int columns_ = 0, rows_ = 0;                   // size of the grid in cells
  // The cell of each of others_. For each cell, the start of its entries in sorted_.
  std::vector<std::uint32_t> cell_of_, cell_start_;
  std::vector<Other> sorted_;       // others_, ordered by cell
  std::vector<Vector2> sorted_at_;  // positions of sorted_
  // The walkers, ordered by grid cell. Walkers in one cell mostly have the same bodies in range.
  std::vector<std::uint32_t> walker_order_;
};

}  // namespace gsv::dynamics
