// The solids of a world at one instant, to cast rays against.
//
// Exactness    a grid or Embree only finds which primitives a ray may meet; the distance is then
//              computed in double precision from the triangle or the analytic shape, the same on
//              every machine and for every thread count.
// Threads      const members may run concurrently.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "gsv/base/thread_team.h"
#include "gsv/sensing/rays/fan.h"
#include "gsv/world/ray_caster.h"
#include "gsv/world/snapshot.h"

namespace gsv::sensing {

using world::Hit;
using world::Ray;

// A pose turns directions and moves origins: the same ray in another frame, for so many metres.
inline Ray Moved(const geometry::Pose& to_from, const Ray& ray, double length) {
  return {to_from * ray.origin, to_from.orientation * ray.direction, length};
}

class CandidateSet;

class RayScene : public world::RayCaster {
 public:
  using world::RayCaster::Cast;

  // The same for many rays; hits[i] is rays[i]'s.
  virtual void Cast(std::span<const Ray> rays, int ignored_body,
                    std::span<std::optional<Hit>> hits) const = 0;

  // The distance alone, which is found quicker: infinite where Cast() finds nothing.
  virtual double Range(const Ray& ray, int ignored_body) const = 0;

  // The same for all rays of a fan, which is quicker still: for each solid its rays are found, the
  // nearest solids first. ranges[i] is ray i's.
  virtual void Scan(const Fan& fan, int ignored_body, std::span<double> ranges) const = 0;

  // Gathers the solids within `reach` of `place`, but not those of `ignored_body`: for several rays
  // from there it is quicker to look for them once. False if they are too many for that.
  virtual bool Gather(const geometry::Vector3& place, double reach, int ignored_body,
                      CandidateSet& candidates) const = 0;

  // The same as the other one, for rays that Surroundings::Hold() and their ignored body.
  virtual double Range(const Ray& ray, int ignored_body, const CandidateSet& candidates) const = 0;
};

// Ray scenes for snapshots, built when asked for. The static part is built once a layout, and a
// scene that nobody holds any more is moved on to the next snapshot.
class RaySceneCache {
 public:
  RaySceneCache();
  ~RaySceneCache();
  RaySceneCache(const RaySceneCache&) = delete;
  RaySceneCache& operator=(const RaySceneCache&) = delete;

  // Any thread; callers with the same snapshot get the same scene. A scene that has to be built is
  // shared out over `team`, if there is one.
  std::shared_ptr<const RayScene> At(const std::shared_ptr<const world::Snapshot>& snapshot,
                                     base::ThreadTeam* team = nullptr);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gsv::sensing
