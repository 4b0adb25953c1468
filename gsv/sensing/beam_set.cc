#include "gsv/sensing/beam_set.h"

#include <algorithm>
#include <cstring>

#include "gsv/base/check.h"
#include "gsv/base/each_processor.h"

namespace gsv::sensing {
namespace {

using geometry::Pose;

// A link with fewer beams casts its rays one by one. To gather a candidate set for so few rays
// takes longer than the set saves.
constexpr std::size_t kMinPacket = 3;

// Computes the rays of the beams. A ray starts at the origin of world_from_sensor = world_from_link
// * link_from_sensor, and points along the x axis of world_from_sensor. The results are
// bit-identical to those of class Pose, because the operations and their order are the same.
GSV_FOR_EACH_PROCESSOR
void PlaceRays(const Pose& world_from_link, const BeamSet::Beams& __restrict beams,
               RayPacket& __restrict rays) {
  const double tx = world_from_link.position.x, ty = world_from_link.position.y,
               tz = world_from_link.position.z;
  const double aw = world_from_link.orientation.w, ax = world_from_link.orientation.x,
               ay = world_from_link.orientation.y, az = world_from_link.orientation.z;
  for (std::size_t i = 0; i < RayPacket::kMax; ++i) {
    const double vx = beams.x[i], vy = beams.y[i], vz = beams.z[i];
    const double cx = (ay * vz - az * vy) + vx * aw;
    const double cy = (az * vx - ax * vz) + vy * aw;
    const double cz = (ax * vy - ay * vx) + vz * aw;
    rays.origin_x[i] = tx + (vx + (ay * cz - az * cy) * 2.0);
    rays.origin_y[i] = ty + (vy + (az * cx - ax * cz) * 2.0);
    rays.origin_z[i] = tz + (vz + (ax * cy - ay * cx) * 2.0);
    rays.max_distance[i] = beams.max[i];
  }
  for (std::size_t i = 0; i < RayPacket::kMax; ++i) {
    const double bw = beams.qw[i], bx = beams.qx[i], by = beams.qy[i], bz = beams.qz[i];
    const double w = aw * bw - ax * bx - ay * by - az * bz;
    const double x = aw * bx + ax * bw + ay * bz - az * by;
    const double y = aw * by - ax * bz + ay * bw + az * bx;
    const double z = aw * bz + ax * by - ay * bx + az * bw;
    // Products with the zeros of the x axis are kept, because the sign of these products affects
    // the bits of the result.
    const double cx = (y * 0.0 - z * 0.0) + 1.0 * w;
    const double cy = (z * 1.0 - x * 0.0) + 0.0 * w;
    const double cz = (x * 0.0 - y * 1.0) + 0.0 * w;
    rays.direction_x[i] = 1.0 + (y * cz - z * cy) * 2.0;
    rays.direction_y[i] = 0.0 + (z * cx - x * cz) * 2.0;
    rays.direction_z[i] = 0.0 + (x * cy - y * cx) * 2.0;
  }
}

}  // namespace

void BeamSet::Add(const Sensor& sensor) {
  const Beam* const beam = sensor.beam();
  GSV_CHECK(beam != nullptr);
  const model::SensorDescription& description = sensor.description();
  if (beams_.empty() || beams_.back().link != description.link ||
      beams_.back().count == RayPacket::kMax) {
    beams_.emplace_back().link = description.link;
  }
  Beams& beams = beams_.back();
  const std::size_t i = beams.count++;
  const Pose& pose = description.link_from_sensor;
  beams.x[i] = pose.position.x, beams.y[i] = pose.position.y, beams.z[i] = pose.position.z;
  beams.qw[i] = pose.orientation.w, beams.qx[i] = pose.orientation.x;
  beams.qy[i] = pose.orientation.y, beams.qz[i] = pose.orientation.z;
  beams.min[i] = beam->min, beams.max[i] = beam->max;
  ++size_;
}

bool BeamSet::IsIdenticalTo(const BeamSet& other) const {
  const auto are_identical = [](const Beams& a, const Beams& b) {
    const auto has_same = [&](RayPacket::Coordinates Beams::*each) {
      return std::memcmp((a.*each).data(), (b.*each).data(), sizeof(a.*each)) == 0;
    };
    return a.link == b.link && a.count == b.count && has_same(&Beams::x) && has_same(&Beams::y) &&
           has_same(&Beams::z) && has_same(&Beams::qw) && has_same(&Beams::qx) &&
           has_same(&Beams::qy) && has_same(&Beams::qz) && has_same(&Beams::min) &&
           has_same(&Beams::max);
  };
  return std::equal(beams_.begin(), beams_.end(), other.beams_.begin(), other.beams_.end(),
                    are_identical);
}

void BeamSet::Sample(const Sampling& sampling, std::span<double> values) const {
  GSV_CHECK(values.size() == size_);
  const RayScene& scene = sampling.Rays();
  const world::Snapshot& snapshot = *sampling.snapshot();
  const int body = sampling.body();
  std::size_t first = 0;
  for (const Beams& beams : beams_) {
    RayPacket rays;
    PlaceRays(world::LinkPose(snapshot, body, beams.link), beams, rays);
    rays.count = beams.count;
    RayPacket::Coordinates echoes;
    if (beams.count < kMinPacket) {
      for (std::size_t i = 0; i < beams.count; ++i) echoes[i] = scene.Range(rays.At(i), body);
    } else {
      const geometry::Vector3& place = snapshot.state.bodies[body].world_from_model.position;
      scene.Ranges(rays, place, body, std::span(echoes).first(beams.count));
    }
    for (std::size_t i = 0; i < beams.count; ++i) {
      values[first + i] = Beam{beams.min[i], beams.max[i]}.ValueOf(echoes[i]);
    }
    first += beams.count;
  }
}

}  // namespace gsv::sensing
