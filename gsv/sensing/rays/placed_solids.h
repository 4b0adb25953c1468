// The ray scene of one snapshot: the static solids, and the moving solids at their poses.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/base/thread_team.h"
#include "gsv/sensing/rays/box_index.h"
#include "gsv/sensing/rays/echo.h"
#include "gsv/sensing/rays/layout_solids.h"
#include "gsv/sensing/rays/ray_row.h"
#include "gsv/sensing/rays/sectors.h"
#include "gsv/sensing/rays/sphere_grid.h"

namespace gsv::sensing {

// Casts rays at the solids of one snapshot.
class PlacedSolids final : public RayScene {
 public:
  // Sets the poses of `snapshot`, which must have the layout of `solids`. Reuses memory. No rays
  // may be cast during this call.
  void MoveTo(std::shared_ptr<const LayoutSolids> solids, const world::Snapshot& snapshot,
              base::ThreadTeam* team);
  // Do the same in steps: between BeginMove() and EndMove(), the caller calls PlaceBody() for each
  // moving body. Calls for different bodies may run concurrently. LayoutSolids::follow_bodies must
  // be true.
  void BeginMove(std::shared_ptr<const LayoutSolids> solids);
  void PlaceBody(int body, const geometry::Pose& world_from_model) {
    const auto i = static_cast<std::size_t>(body);
    for (std::uint32_t at = solids_->first_part[i]; at < solids_->first_part[i + 1]; ++at) {
      PlaceAt(at, world_from_model);
    }
  }
  void EndMove();

  std::optional<Hit> Cast(const Ray& ray, int ignored_body) const override;
  void Cast(std::span<const Ray> rays, int ignored_body,
            std::span<std::optional<Hit>> hits) const override;
  double Range(const Ray& ray, int ignored_body) const override;
  void Scan(const Fan& fan, int ignored_body, std::span<double> ranges) const override;
  bool Gather(const geometry::Vector3& place, double reach, int ignored_body,
              CandidateSet& candidates) const override;
  double Range(const Ray& ray, int ignored_body, const CandidateSet& candidates) const override;
  void Ranges(const RayPacket& rays, const geometry::Vector3& place, int ignored_body,
              std::span<double> ranges) const override;

  // See FindEchoes().
  std::optional<Echo> EchoOf(const Ray& ray, int ignored_body) const;

 private:
  // A moving part at its pose in the snapshot.
  struct PlacedPart {
    geometry::Pose part_from_world;  // transforms rays to the frame of the part's solids
    const Part* part;                // the solids in the part's frame
  };
  struct Shadings;  // the solids near a fan, and for each solid the sector of rays that may hit it

  // Sets the pose of the moving part with this index.
  void Place(std::size_t index, const world::Snapshot& snapshot);
  void PlaceAt(std::size_t index, const geometry::Pose& world_from_part);
  // Returns the index of the bounding boxes of spheres_, and builds it on first use.
  const BoxIndex& index() const;
  int BodyOf(std::size_t part) const { return solids_->moving[part].body; }
  // Returns the nearest hit of a ray.
  Nearest Find(const Ray& ray, int ignored_body) const;
  // Returns the surface normal at a hit, in the world.
  geometry::Vector3 NormalAt(const Nearest& nearest, const Ray& ray) const;
  // Returns what is stored in a hit on a moving part: the body, the index of the part, and the
  // first primitive index.
  Bearer BearerOf(std::size_t part) const;
  // Casts a ray at one moving part.
  void CastAtPart(std::size_t index, const Ray& ray, Nearest& nearest) const;
  // Finds the bounded solids within the fan's reach. Returns false if there are too many.
  bool FindShadings(const Fan& fan, int ignored_body, Shadings& shadings) const;
  // Casts the rays of a packet at the solids whose bounding spheres they hit. For each hit, sets
  // the distance in `nearest`, and sets the body to some number other than -1. The other members of
  // `nearest` may be wrong.
  void CastAtTouched(const TouchedSpheres& moving, const TouchedSpheres& standing,
                     const RayPacket& packet, int ignored_body, std::span<Nearest> nearest) const;
  // Casts a ray at everything that index() does not contain: planes, and the triangles of static
  // meshes.
  void CastAtUnindexed(const Ray& ray, int ignored_body, Nearest& nearest) const;
  // Returns false if CastAtUnindexed() would find nothing for all rays of a fan.
  bool UnindexedReach(const Fan& fan, int ignored_body) const;
  // Casts the rays of the sector at one solid of Shadings.
  void CastInto(std::uint32_t solid, const Sector& sector, const Fan& fan, RayRow& row) const;

  std::shared_ptr<const LayoutSolids> solids_;
  // The next two vectors have the order of LayoutSolids::moving. `spheres_` contains only bounded
  // parts.
  std::vector<PlacedPart> parts_;
  std::vector<BoundingSphere> spheres_;  // bounding spheres in the world
  SphereGrid grid_;                      // the grid of spheres_, for packets

  // The index of the spheres' bounding boxes, for rays outside of packets. The first such ray builds
  // it.
  mutable base::Mutex index_mutex_;
  mutable std::atomic<bool> is_indexed_{false};  // whether index_ is built for the present spheres_
  mutable std::vector<geometry::Bounds> boxes_ GSV_GUARDED_BY(index_mutex_);  // for index_
  mutable BoxIndex index_;
};

}  // namespace gsv::sensing
