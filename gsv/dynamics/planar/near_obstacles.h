// Finds the obstacles that movers may run into, and the times of the contacts.
//
// Clearance    for each mover, the distance to the nearest static obstacle at the last search is
//              stored. While the mover stays within that distance, no search for static obstacles
//              is needed. Only searches that would find nothing are skipped, so the results are the
//              same as without the clearance. Dynamic obstacles are searched for in each step.
// Threads      Find() and Stop() may run concurrently for different chunks of movers.
// Units        metres, seconds, world frame.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gsv/dynamics/planar/planar_scene.h"
#include "gsv/dynamics/shapes/contact_collector.h"
#include "gsv/dynamics/shapes/time_of_impact.h"
#include "gsv/geometry/planar_motion.h"

namespace gsv::dynamics {

// Finds collisions of movers with obstacles, and stops the movers there.
class NearObstacles {
 public:
  explicit NearObstacles(const PlanarScene& scene) : scene_(scene) {}

  // Clears all data. Must be called after each PlanarScene::Slice(). Chunks are numbered from 0.
  void Reset(std::size_t chunks);

  // Empties a chunk's list. Then call Find() for the movers of the chunk in ascending order.
  void Clear(std::size_t chunk);
  // Adds the obstacles that a mover at `at` may touch if no part of it moves further than `travel`.
  void Find(std::size_t chunk, std::uint32_t mover, const geometry::PlanarPosition& at,
            double travel);

  // Returns true if the last search shows that a mover at `at` touches no static obstacle while no
  // part of it moves further than `travel`.
  bool IsClear(std::uint32_t mover, const geometry::PlanarPosition& at, double travel) const {
    const Clearance& clearance = clearances_[mover];
    const double room = clearance.radius - (travel + kTouchGap);
    const Vector2 moved = Vector2{at.x, at.y} - clearance.centre;
    return room > 0 && Dot(moved, moved) < room * room;
  }

  // Stops the chunk's movers at the first obstacle in their way. Mover m starts at starts[m] and
  // moves for times[m]. If it is stopped, times[m] becomes the time of the contact and normals[m]
  // the direction towards the obstacle.
  void Stop(std::size_t chunk, std::span<const geometry::PlanarPosition> starts,
            std::span<const geometry::Twist> twists, std::span<double> times,
            std::span<Vector2> normals) const;

  // Appends to `touching` the pairs of a mover and an obstacle that touched at the mover's position
  // in Find().
  void AddTouching(std::vector<BodyPair>& touching) const;
  // Passes the contacts of all movers at `positions` with the found obstacles to the collector.
  void Collect(std::span<const geometry::PlanarPosition> positions,
               ContactCollector& contacts) const;

 private:
  // A piece of a mover and an obstacle near it.
  struct Near {
    // Index of the mover in the scene, of the piece in the mover's footprint, and of the obstacle
    // in `field`.
    std::uint32_t mover, piece, obstacle;
    const ObstacleField* field;
    geometry::PlanarPosition found_at;  // position of the mover at the search
    Separation separation;  // separation of the piece from the obstacle, with the mover at found_at
  };
  // Stores that a mover with its origin at `centre`, at any heading, is further than `radius` from
  // every static obstacle.
  struct Clearance {
    Vector2 centre;      // the mover's origin at the search
    double radius = -1;  // m; negative before the first search
  };
  struct alignas(64) Chunk {  // aligned to a cache line, because threads write to adjacent chunks
    std::vector<Near> near;   // obstacles near the chunk's movers in this step
    std::vector<BodyPair> touching;  // see AddTouching()
  };

  const Footprint::Piece& PieceOf(const Near& near) const {
    return scene_.footprint(near.mover).pieces[near.piece];
  }
  const Obstacle& ObstacleOf(const Near& near) const { return (*near.field)[near.obstacle]; }
  // Returns the separation of the piece from the obstacle if the mover is at `at`.
  Separation SeparationAt(const Near& near, const geometry::PlanarPosition& at) const;
  // Lists the dynamic obstacles (if `dynamic`) or the static obstacles (if not) within `within` of
  // the mover. Returns the distance from the mover's origin to the nearest of these obstacles, or
  // `look` if none is nearer. `look` must be at least the footprint's radius plus `within`.
  double Search(Chunk& chunk, std::uint32_t mover, const geometry::PlanarPosition& at,
                double within, double look, bool dynamic) const;

  const PlanarScene& scene_;
  std::vector<Clearance> clearances_;  // one for each mover, from its last search
  std::vector<Chunk> chunks_;
};

}  // namespace gsv::dynamics
