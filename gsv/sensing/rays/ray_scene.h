// Casts rays against the solids of a world at one instant.
//
// Exactness    the broad phase (a grid or Embree) only finds candidates. The distance is then
//              computed in double precision from the triangle or the analytic shape. The distance
//              is bit-identical on every machine and for every number of threads.
// Threads      const members may run concurrently.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "gsv/base/thread_team.h"
#include "gsv/sensing/rays/fan.h"
#include "gsv/sensing/rays/ray_packet.h"
#include "gsv/world/ray_caster.h"
#include "gsv/world/snapshot.h"

namespace gsv::sensing {

using world::Hit;
using world::Ray;

// Returns the ray in another frame, with the given length in metres.
inline Ray Moved(const geometry::Pose& to_from, const Ray& ray, double length) {
  return {to_from * ray.origin, to_from.orientation * ray.direction, length};
}

class CandidateSet;

// The solids of a world at one instant, for ray casting.
class RayScene : public world::RayCaster {
 public:
  using world::RayCaster::Cast;

  // Casts many rays. hits[i] is the result for rays[i].
  virtual void Cast(std::span<const Ray> rays, int ignored_body,
                    std::span<std::optional<Hit>> hits) const = 0;

  // Returns only the distance, which is faster; infinite if Cast() finds nothing.
  virtual double Range(const Ray& ray, int ignored_body) const = 0;

  // Sets ranges[i] to the range of ray i of a fan. This is even faster than Range(). It takes the
  // nearest solid first, and computes for each solid which rays may hit it.
  virtual void Scan(const Fan& fan, int ignored_body, std::span<double> ranges) const = 0;

  // Gathers the candidate set: the solids within `reach` of `place`, without `ignored_body`. With
  // this set, casting several rays from near `place` is faster. Returns false if there are too many
  // candidates.
  virtual bool Gather(const geometry::Vector3& place, double reach, int ignored_body,
                      CandidateSet& candidates) const = 0;

  // Sets ranges[i] to the range of ray i of the packet. If the rays start near `place`, this
  // function is faster than Range().
  virtual void Ranges(const RayPacket& rays, const geometry::Vector3& place, int ignored_body,
                      std::span<double> ranges) const = 0;

  // Like Range() above, for a ray within the candidate set (CandidateSet::Covers()). `ignored_body`
  // must be the body that Gather() ignored.
  virtual double Range(const Ray& ray, int ignored_body, const CandidateSet& candidates) const = 0;
};

// A ray scene whose bodies are not yet all at their places, see RaySceneCache::Begin().
class SceneDraft {
 public:
  virtual ~SceneDraft() = default;
  // Places the solids of a body. Threads: calls for different bodies may run concurrently.
  virtual void Place(int body, const geometry::Pose& world_from_model) = 0;
};

// Builds the ray scenes of snapshots on demand. The static part is built once per layout, and a
// scene without users is reused for the next snapshot.
class RaySceneCache {
 public:
  RaySceneCache();
  ~RaySceneCache();
  RaySceneCache(const RaySceneCache&) = delete;
  RaySceneCache& operator=(const RaySceneCache&) = delete;

  // Returns the scene of a snapshot. Any thread may call it; calls with one of the last four
  // snapshots return the same scene. Builds scenes in parallel on `team`, if it is given.
  std::shared_ptr<const RayScene> At(const std::shared_ptr<const world::Snapshot>& snapshot,
                                     base::ThreadTeam* team = nullptr);

  // Begins the scene of a snapshot before the snapshot is complete. The caller places each body of
  // the layout that is not static, and then passes the draft to Add(). So bodies can be placed
  // while they are in the cache of a processor. Returns null if the poses of bodies are not enough,
  // because solids move with joints or are unbounded.
  std::unique_ptr<SceneDraft> Begin(const std::shared_ptr<const world::Layout>& layout);
  // At() then completes this draft if it is called for the snapshot.
  void Add(const std::shared_ptr<const world::Snapshot>& snapshot,
           std::unique_ptr<SceneDraft> draft);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace gsv::sensing
