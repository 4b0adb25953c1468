#include "gsv/sensing/rays/placed_solids.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "gsv/base/check.h"
#include "gsv/base/each_processor.h"
#include "gsv/geometry/constants.h"
#include "gsv/sensing/rays/candidate_set.h"
#include "gsv/sensing/rays/packet_bounds.h"
#include "gsv/sensing/rays/ray_pairs.h"
#include "gsv/sensing/rays/sectors.h"

namespace gsv::sensing {
namespace {

using geometry::kInfinity;

using geometry::Bounds;
using geometry::Pose;
using geometry::Vector3;

// kPartsAtOnce is the number of parts that a thread places at a time. For fewer parts than
// kMinParts, a second thread saves no time.
constexpr std::size_t kPartsAtOnce = 128, kMinParts = 400;

// If a part has at most this number of shapes, rays are cast at all of its shapes. Otherwise, rays
// are cast only at the shapes that the part's index finds.
constexpr std::uint32_t kFewShapes = 4;

// If more rays of a packet than this hit a shape's bounding sphere, the shape may be long. Then
// each ray is first tested with the bounding box.
constexpr int kMaxRaysOfCompact = 4;

// In lists of solids, this bit of the number distinguishes static shapes from moving parts.
constexpr std::uint32_t kStanding = 1u << 31;

// Solids are sorted by distance only if the reach of the rays is at least this, in m.
constexpr double kMinReach = 1e-6;

bool IsSound(const Ray& ray) {
  return ray.max_distance >= 0 && IsFinite(ray.origin) && IsFinite(ray.direction);
}

double DistanceOf(const Nearest& nearest) {
  return nearest.body < 0 ? kInfinity : nearest.distance;
}

// Returns an upper bound of the distance from the place to the points of the packet's rays. It is
// infinite if a ray or the place is invalid; see IsSound(). The loops have a fixed length, so that
// the compiler uses vectors.
GSV_FOR_EACH_PROCESSOR
double ReachOf(const RayPacket& packet, const Vector3& place) {
  RayPacket::Coordinates reaches;
  std::array<std::int64_t, RayPacket::kMax> faults;
  const auto count = static_cast<std::int64_t>(packet.count);
  for (std::int64_t i = 0; i < std::int64_t{RayPacket::kMax}; ++i) {
    const double length = packet.max_distance[i];
    const double away = std::abs(packet.origin_x[i] - place.x) +
                        std::abs(packet.origin_y[i] - place.y) +
                        std::abs(packet.origin_z[i] - place.z);
    // The product of zero and a number that is not finite is NaN.
    const double zero = 0 * (away + length + std::abs(packet.direction_x[i]) +
                             std::abs(packet.direction_y[i]) + std::abs(packet.direction_z[i]));
    reaches[i] = i < count ? away + length : 0;
    faults[i] = static_cast<std::int64_t>(i < count) &
                (static_cast<std::int64_t>(zero != 0) | static_cast<std::int64_t>(!(length >= 0)));
  }
  std::int64_t fault = 0;
  for (const std::int64_t each : faults) fault |= each;
  double reach = 0;
  for (const double each : reaches) reach = std::max(reach, each);
  return fault != 0 ? kInfinity : reach;
}

Bounds Around(const Ray& ray) {
  const Vector3& a = ray.origin;
  const Vector3 b = ray.origin + ray.max_distance * ray.direction;
  return {{std::min(a.x, b.x), std::min(a.y, b.y), std::min(a.z, b.z)},
          {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)}};
}

// Does the same as Moved(), but is inlined.
[[gnu::flatten]] Ray MovedInline(const Pose& to_from, const Ray& ray, double length) {
  return Moved(to_from, ray, length);
}

// Whether the ray intersects the bounding sphere.
bool Passes(const Ray& ray, double length, const BoundingSphere& ball) {
  const Vector3 to_centre = ball.centre - ray.origin;
  const double along = std::clamp(Dot(to_centre, ray.direction), 0.0, length);
  const Vector3 gap = to_centre - along * ray.direction;
  return Dot(gap, gap) <= ball.radius * ball.radius;
}

// Calls cast(ray, nearest) for ray i of a row, and sets the ray's range to the result.
template <class Cast>
void ShortenRay(RayRow& row, std::size_t i, const Cast& cast) {
  const Ray ray = row.At(i);
  Nearest nearest;
  nearest.distance = ray.max_distance;
  cast(ray, nearest);
  if (nearest.body >= 0) row.SetRange(i, nearest.distance);
}

// Solids, and for each solid the rays of a packet that are cast at it. Each solid has at least one
// ray.
class CastList {
 public:
  // Adds a solid. Does nothing if `rays` is 0. The function is branch-free, because the processor
  // could hardly predict whether `rays` is 0.
  void Add(std::uint32_t number, unsigned rays) {
    list_[count_] = {number, rays};
    count_ += rays != 0;
  }

  // Calls cast(number, i) for each ray i of each solid. One loop is used instead of two nested
  // loops, because the processor could hardly predict the number of rays of each solid.
  template <class Cast>
  void ForEach(const Cast& cast) {
    list_[count_] = {};
    const TouchedSpheres::Touched* at = list_.data();
    for (unsigned rays = at->rays; rays != 0;) {
      cast(at->number, static_cast<std::size_t>(std::countr_zero(rays)));
      rays &= rays - 1;
      const bool is_last = rays == 0;
      at += is_last;
      rays = is_last ? at->rays : rays;
    }
  }

 private:
  std::array<TouchedSpheres::Touched, TouchedSpheres::kMax + 1> list_;
  std::size_t count_ = 0;
};

// Casts rays of a packet at cylinders and boxes, several pairs at a time. For a hit, sets only two
// members of `nearest`: the distance, and the body to 0, which means only that something was hit.
class PacketCaster {
 public:
  PacketCaster(const RayPacket& packet, std::span<Nearest> nearest)
      : packet_(packet), nearest_(nearest) {}

  // Casts ray i at a shape of a set. The set's frame is the frame of a part, or the world if
  // `part_from_world` is null. Returns false if the caller must cast this ray at this shape itself.
  bool Add(std::size_t i, const Pose* part_from_world, const SolidSet& set, std::uint32_t shape) {
    if (!is_fast_) return false;
    const geometry::Shape& at = set.ShapeAt(shape);
    const Pose& shape_from_set = set.ShapeFromSet(shape);
    if (const auto* const cylinder = std::get_if<geometry::Cylinder>(&at)) {
      AddTo(part_from_world ? pairs_.moving_cylinders : pairs_.cylinders, i, part_from_world,
            shape_from_set, *cylinder);
    } else if (const auto* const box = std::get_if<geometry::Box>(&at)) {
      AddTo(part_from_world ? pairs_.moving_boxes : pairs_.boxes, i, part_from_world,
            shape_from_set, *box);
    } else {
      return false;
    }
    return true;
  }

  // Must be called after the last Add().
  void Finish() {
    Cast<geometry::Cylinder, true>(pairs_.moving_cylinders);
    Cast<geometry::Box, true>(pairs_.moving_boxes);
    Cast<geometry::Cylinder, false>(pairs_.cylinders);
    Cast<geometry::Box, false>(pairs_.boxes);
  }

 private:
  struct Pairs {
    RayPairs moving_cylinders, moving_boxes, cylinders, boxes;
  };

  template <class Shape>
  void AddTo(RayPairs& pairs, std::size_t i, const Pose* part_from_world,
             const Pose& shape_from_set, const Shape& shape) {
    if (pairs.is_full()) {
      part_from_world != nullptr ? Cast<Shape, true>(pairs) : Cast<Shape, false>(pairs);
    }
    pairs.Add(packet_, i, part_from_world, shape_from_set, shape);
  }

  template <class Shape, bool kHaveParts>
  void Cast(RayPairs& pairs) {
    if (pairs.count() == 0) return;
    pairs.Cast<Shape, kHaveParts>();
    for (std::size_t k = 0; k < pairs.count(); ++k) {
      // Branch-free, because the processor could hardly predict hits.
      Nearest& nearest = nearest_[pairs.ray(k)];
      const bool is_hit = pairs.distance(k) <= nearest.distance;
      nearest.distance = is_hit ? pairs.distance(k) : nearest.distance;
      nearest.body = is_hit ? 0 : nearest.body;
    }
    pairs.Clear();
  }

  const RayPacket& packet_;
  const std::span<Nearest> nearest_;
  const bool is_fast_ = RayPairs::AreFast();
  static constinit thread_local Pairs pairs_;
};

constinit thread_local PacketCaster::Pairs PacketCaster::pairs_;

}  // namespace

[[gnu::flatten]] void PlacedSolids::Place(std::size_t index, const world::Snapshot& snapshot) {
  const auto& [part, body] = solids_->moving[index];
  Pose world_from_part = snapshot.state.bodies[body].world_from_model;
  if (part->link >= 0) {
    world_from_part = world_from_part * world::ModelFromLink(snapshot, body, part->link);
  }
  PlaceAt(index, world_from_part);
}

[[gnu::flatten]] void PlacedSolids::PlaceAt(std::size_t index,
                                            const geometry::Pose& world_from_part) {
  const Part* const part = solids_->moving[index].part;
  parts_[index] = {Inverse(world_from_part), part};
  if (index >= solids_->bounded) return;
  spheres_[index] = {world_from_part * part->ball.centre, part->ball.radius};
}

void PlacedSolids::MoveTo(std::shared_ptr<const LayoutSolids> solids,
                          const world::Snapshot& snapshot, base::ThreadTeam* team) {
  BeginMove(std::move(solids));
  const auto place = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) Place(i, snapshot);
  };
  if (team != nullptr) {
    team->ParallelFor(parts_.size(), parts_.size() < kMinParts ? kMinParts : kPartsAtOnce, place);
  } else {
    place(0, parts_.size());
  }
  EndMove();
}

void PlacedSolids::BeginMove(std::shared_ptr<const LayoutSolids> solids) {
  solids_ = std::move(solids);
  parts_.resize(solids_->moving.size());
  spheres_.resize(solids_->bounded);
}

void PlacedSolids::EndMove() {
  grid_.Build(spheres_, {});
  is_indexed_.store(false, std::memory_order_relaxed);
}

const BoxIndex& PlacedSolids::index() const {
  if (!is_indexed_.load(std::memory_order_acquire)) {
    const base::MutexLock lock(index_mutex_);
    if (!is_indexed_.load(std::memory_order_relaxed)) {
      boxes_.clear();
      for (const BoundingSphere& sphere : spheres_) boxes_.push_back(BoundsOf(sphere));
      index_.Build(boxes_, /*often=*/true);
      is_indexed_.store(true, std::memory_order_release);
    }
  }
  return index_;
}

Bearer PlacedSolids::BearerOf(std::size_t part) const {
  // The upper bits of a primitive index are the number of the part. If two hits on a body have
  // equal distances, the hit with the lower index is kept, whatever the order of the casts.
  return {solids_->moving[part].body, static_cast<int>(part),
          static_cast<std::uint32_t>(parts_[part].part->number) << 24};
}

void PlacedSolids::CastAtPart(std::size_t index, const Ray& ray, Nearest& nearest) const {
  const auto& [part_from_world, part] = parts_[index];
  const Ray moved = MovedInline(part_from_world, ray, nearest.distance);
  if (part->solids.ShapesAlone() == 1) {
    return part->solids.CastAtShape(0, moved, -1, nearest, BearerOf(index));
  }
  part->solids.Cast(moved, -1, nearest, BearerOf(index));
}

// Call this after all other casts. Their hits have then shortened the ray, so fewer triangles are
// tested. There may be many triangles.
void PlacedSolids::CastAtUnindexed(const Ray& ray, int ignored_body, Nearest& nearest) const {
  for (std::size_t i = solids_->bounded; i < parts_.size(); ++i) {
    if (solids_->moving[i].body != ignored_body) CastAtPart(i, ray, nearest);
  }
  solids_->standing.CastAtOthers(ray, ignored_body, nearest);
}

Nearest PlacedSolids::Find(const Ray& ray, int ignored_body) const {
  Nearest nearest;
  nearest.distance = ray.max_distance;
  if (!IsSound(ray)) return nearest;
  solids_->standing.CastAtShapes(ray, ignored_body, nearest);
  index().Walk(ray, nearest.distance, [&](std::uint32_t i) {
    if (BodyOf(i) == ignored_body || !Passes(ray, nearest.distance, spheres_[i])) return;
    CastAtPart(i, ray, nearest);
  });
  CastAtUnindexed(ray, ignored_body, nearest);
  return nearest;
}

Vector3 PlacedSolids::NormalAt(const Nearest& nearest, const Ray& ray) const {
  if (nearest.part < 0) return solids_->standing.NormalAt(nearest.solid, ray);
  const auto& [part_from_world, part] = parts_[nearest.part];
  return Inverse(part_from_world.orientation) *
         part->solids.NormalAt(nearest.solid, Moved(part_from_world, ray, ray.max_distance));
}

std::optional<Hit> PlacedSolids::Cast(const Ray& ray, int ignored_body) const {
  const Nearest nearest = Find(ray, ignored_body);
  if (nearest.body < 0) return {};
  return Hit{nearest.distance, NormalAt(nearest, ray), nearest.body};
}

std::optional<Echo> PlacedSolids::EchoOf(const Ray& ray, int ignored_body) const {
  const Nearest nearest = Find(ray, ignored_body);
  if (nearest.body < 0) return {};
  const SolidSet& set = nearest.part < 0 ? solids_->standing : parts_[nearest.part].part->solids;
  return Echo{nearest.distance, std::abs(Dot(NormalAt(nearest, ray), ray.direction)),
              set.ReflectanceOf(nearest.solid)};
}

void FindEchoes(const RayScene& scene, std::span<const Ray> rays, int ignored_body,
                std::span<std::optional<Echo>> echoes) {
  GSV_CHECK(rays.size() == echoes.size());
  const auto* const solids = dynamic_cast<const PlacedSolids*>(&scene);
  GSV_CHECK(solids != nullptr);
  for (std::size_t i = 0; i < rays.size(); ++i) echoes[i] = solids->EchoOf(rays[i], ignored_body);
}

void PlacedSolids::Cast(std::span<const Ray> rays, int ignored_body,
                        std::span<std::optional<Hit>> hits) const {
  GSV_CHECK(rays.size() == hits.size());
  for (std::size_t i = 0; i < rays.size(); ++i) hits[i] = Cast(rays[i], ignored_body);
}

double PlacedSolids::Range(const Ray& ray, int ignored_body) const {
  return DistanceOf(Find(ray, ignored_body));
}

// A list of solids and their sectors.
struct PlacedSolids::Shadings {
  static constexpr std::size_t kMax = 2 * FoundBoxes::kMax;
  struct Shading {
    Sector sector;
    std::uint32_t solid;  // kStanding | number of the static shape, or number of the part
  };

  std::array<Shading, kMax> all;
  // indices of the first `count` solids, ordered by distance
  std::array<std::uint16_t, kMax> order;
  std::size_t count = 0;

  // Sets `order`. If the distances of solids differ by less than a fraction of the reach, their
  // order is undefined.
  void Sort(double reach) {
    constexpr std::size_t kBuckets = 64;
    const double per_metre = reach > kMinReach ? kBuckets / reach : 0;
    std::array<std::uint8_t, kMax> bucket_of;
    std::array<std::uint16_t, kBuckets> begins{};
    for (std::size_t i = 0; i < count; ++i) {
      const double bucket = std::min(all[i].sector.nearest * per_metre, kBuckets - 1.0);
      bucket_of[i] = static_cast<std::uint8_t>(bucket);
      ++begins[bucket_of[i]];
    }
    std::uint16_t begin = 0;
    for (std::uint16_t& each : begins) each = std::exchange(begin, begin + each);
    for (std::size_t i = 0; i < count; ++i) {
      order[begins[bucket_of[i]]++] = static_cast<std::uint16_t>(i);
    }
  }
};

bool PlacedSolids::FindShadings(const Fan& fan, int ignored_body, Shadings& shadings) const {
  const Vector3& place = fan.world_from_fan.position;
  BoxBatch boxes;
  SectorBatch sectors;
  std::array<std::uint32_t, BoxBatch::kMax> solids;
  const auto flush = [&] {
    FindSectors(fan, boxes, sectors);
    for (std::size_t i = 0; i < boxes.count; ++i) {
      if (const auto sector = sectors.At(i)) shadings.all[shadings.count++] = {*sector, solids[i]};
    }
    boxes.count = 0;
  };
  const auto add = [&](std::uint32_t solid, const Pose& box_from_world, const Bounds& box) {
    solids[boxes.count] = solid;
    boxes.Add(box_from_world, box);
    if (boxes.count == BoxBatch::kMax) flush();
  };
  const SolidSet& standing = solids_->standing;
  FoundBoxes found;
  if (!standing.Near(place, fan.max_distance, found)) return false;
  for (const std::uint32_t shape : std::span(found.boxes).first(found.count)) {
    if (standing.BodyOfShape(shape) == ignored_body) continue;
    add(kStanding | shape, standing.ShapeFromSet(shape), standing.OwnBoundsOfShape(shape));
  }
  found.count = 0;
  if (!index().Near(place, fan.max_distance, found)) return false;
  for (const std::uint32_t part : std::span(found.boxes).first(found.count)) {
    if (BodyOf(part) == ignored_body) continue;
    add(part, parts_[part].part_from_world, parts_[part].part->solids.bounds());
  }
  if (boxes.count > 0) flush();
  shadings.Sort(fan.max_distance);
  return true;
}

bool PlacedSolids::UnindexedReach(const Fan& fan, int ignored_body) const {
  for (std::size_t i = solids_->bounded; i < parts_.size(); ++i) {
    if (solids_->moving[i].body != ignored_body) return true;
  }
  return solids_->standing.OthersReach(fan);
}

void PlacedSolids::CastInto(std::uint32_t solid, const Sector& sector, const Fan& fan,
                            RayRow& row) const {
  const double nearest = sector.nearest;
  const auto cast_at = [&](const geometry::Shape& shape, const ShapeFrame& frame) {
    ForRunsIn(sector, fan, [&](std::size_t first, std::size_t last) {
      row.CastAt(shape, frame, nearest, first, last);
    });
  };
  if (const std::uint32_t shape = solid & ~kStanding; shape != solid) {
    const SolidSet& set = solids_->standing;
    const Pose& shape_from_set = set.ShapeFromSet(shape);
    return cast_at(set.ShapeAt(shape),
                   {shape_from_set * row.origin(), std::span(&shape_from_set.orientation, 1)});
  }
  const Pose& part_from_world = parts_[solid].part_from_world;
  const SolidSet& set = parts_[solid].part->solids;
  const std::uint32_t shapes = set.ShapesAlone();
  if (shapes == 0 || shapes > kFewShapes) {
    return ForRunsIn(sector, fan, [&](std::size_t first, std::size_t last) {
      for (std::size_t i = first; i <= last; ++i) {
        if (row.range(i) < nearest) continue;
        ShortenRay(row, i, [&](const Ray& ray, Nearest& found) { CastAtPart(solid, ray, found); });
      }
    });
  }
  const Vector3 place_in_part = part_from_world * row.origin();
  for (std::uint32_t i = 0; i < shapes; ++i) {
    const Pose& shape_from_part = set.ShapeFromSet(i);
    const std::array rotations{part_from_world.orientation, shape_from_part.orientation};
    cast_at(set.ShapeAt(i), {shape_from_part * place_in_part, rotations});
  }
}

void PlacedSolids::Scan(const Fan& fan, int ignored_body, std::span<double> ranges) const {
  GSV_CHECK(ranges.size() == fan.directions.size());
  Shadings shadings;
  const bool is_sound = geometry::IsFinite(fan.world_from_fan) && fan.max_distance >= 0;
  RayRow row(fan);
  if (!is_sound || !FindShadings(fan, ignored_body, shadings)) {
    for (std::size_t i = 0; i < ranges.size(); ++i) ranges[i] = Range(row.At(i), ignored_body);
    return;
  }
  for (const std::uint16_t i : std::span(shadings.order).first(shadings.count)) {
    CastInto(shadings.all[i].solid, shadings.all[i].sector, fan, row);
  }
  if (UnindexedReach(fan, ignored_body)) {
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      ShortenRay(row, i, [&](const Ray& ray, Nearest& found) {
        CastAtUnindexed(ray, ignored_body, found);
      });
    }
  }
  for (std::size_t i = 0; i < ranges.size(); ++i) ranges[i] = row.range(i);
}

bool PlacedSolids::Gather(const Vector3& place, double reach, int ignored_body,
                          CandidateSet& candidates) const {
  if (!IsFinite(place) || !(reach >= 0)) return false;
  candidates.Begin(place, reach);
  FoundBoxes found;
  if (!index().Near(place, reach, found)) return false;
  for (std::size_t i = 0; i < found.count; ++i) {
    const BoundingSphere& ball = spheres_[found.boxes[i]];
    const Vector3 gap = ball.centre - place;
    const double furthest = reach + ball.radius;
    candidates.Add(
        ball, found.boxes[i],
        (BodyOf(found.boxes[i]) != ignored_body) & (Dot(gap, gap) <= furthest * furthest));
  }
  return solids_->standing.Gather(candidates, kStanding) && candidates.Finish();
}

void PlacedSolids::Ranges(const RayPacket& packet, const Vector3& place, int ignored_body,
                          std::span<double> ranges) const {
  GSV_CHECK(ranges.size() == packet.count);
  const double reach = ReachOf(packet, place);
  TouchedSpheres moving, standing;
  const auto find_touched = [&] {
    const PacketSearch search(packet, place, reach);
    return grid_.FindTouched(search, moving) && solids_->standing.FindTouched(search, standing);
  };
  if (!std::isfinite(reach) || !find_touched()) {
    for (std::size_t i = 0; i < packet.count; ++i) ranges[i] = Range(packet.At(i), ignored_body);
    return;
  }
  std::array<Nearest, RayPacket::kMax> nearest;
  for (std::size_t i = 0; i < packet.count; ++i) nearest[i].distance = packet.max_distance[i];
  CastAtTouched(moving, standing, packet, ignored_body, nearest);
  const bool has_unindexed = parts_.size() > solids_->bounded || solids_->standing.HasOthers();
  for (std::size_t i = 0; i < packet.count; ++i) {
    if (has_unindexed) CastAtUnindexed(packet.At(i), ignored_body, nearest[i]);
    ranges[i] = DistanceOf(nearest[i]);
  }
}

void PlacedSolids::CastAtTouched(const TouchedSpheres& moving, const TouchedSpheres& standing,
                                 const RayPacket& packet, int ignored_body,
                                 std::span<Nearest> nearest) const {
  PacketCaster caster(packet, nearest);
  CastList at_parts, at_shapes;
  for (const TouchedSpheres::Touched& each : moving.all()) {
    at_parts.Add(each.number, BodyOf(each.number) != ignored_body ? each.rays : 0);
  }
  at_parts.ForEach([&](std::uint32_t number, std::size_t i) {
    const auto& [part_from_world, part] = parts_[number];
    const bool is_single = part->solids.ShapesAlone() == 1;
    if (is_single && caster.Add(i, &part_from_world, part->solids, 0)) return;
    CastAtPart(number, packet.At(i), nearest[i]);
  });
  const SolidSet& set = solids_->standing;
  std::optional<PacketBounds> bounds;
  for (const TouchedSpheres::Touched& each : standing.all()) {
    unsigned rays = set.BodyOfShape(each.number) != ignored_body ? each.rays : 0;
    // Many rays hit the bounding sphere of a long shape, but not its bounding box.
    if (std::popcount(rays) > kMaxRaysOfCompact) {
      if (!bounds) bounds.emplace(packet);
      rays &= bounds->Touching(set.PaddedBoundsOf(each.number));
    }
    at_shapes.Add(each.number, rays);
  }
  at_shapes.ForEach([&](std::uint32_t number, std::size_t i) {
    if (caster.Add(i, nullptr, set, number)) return;
    set.CastAtShape(number, packet.At(i), ignored_body, nearest[i]);
  });
  caster.Finish();
}

double PlacedSolids::Range(const Ray& ray, int ignored_body, const CandidateSet& candidates) const {
  Nearest nearest;
  nearest.distance = ray.max_distance;
  if (!IsSound(ray)) return kInfinity;
  const Bounds around = Around(ray);
  candidates.Find(ray, nearest.distance, [&](std::uint32_t i) {
    const std::uint32_t shape = i & ~kStanding;
    if (shape == i) return CastAtPart(i, ray, nearest);
    if (!solids_->standing.ShapeReaches(shape, around)) return;
    solids_->standing.CastAtShape(shape, ray, ignored_body, nearest);
  });
  CastAtUnindexed(ray, ignored_body, nearest);
  return DistanceOf(nearest);
}

}  // namespace gsv::sensing
