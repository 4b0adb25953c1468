// A sensor as a model has it. It holds its description and nothing of a robot: one Sensor serves
// all robots of the model.
//
// Threads      a Sensor's const members may run concurrently; a Sampling belongs to one thread.
// Determinism  Sample() is a function of the sampling's snapshot, robot and seed alone.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/random.h"
#include "gsv/sensing/rays/candidate_set.h"
#include "gsv/sensing/rays/ray_scene.h"
#include "gsv/sensing/reading.h"
#include "gsv/world/snapshot.h"

namespace gsv::sensing {

// All that a reading may depend on. What the sensors of a robot have in common is found once, so
// that they had better share a sampling.
class Sampling {
 public:
  // `body` is the robot's index in the snapshot's layout. `rays` outlives the sampling.
  Sampling(std::shared_ptr<const world::Snapshot> snapshot, int body, std::uint64_t seed,
           RaySceneCache& rays)
      : snapshot_(std::move(snapshot)), body_(body), seed_(seed), rays_(rays) {}

  // On to another robot at the same instant.
  void MoveTo(int body);
  // The same at another instant; `body` counts in that one's layout.
  Sampling At(std::shared_ptr<const world::Snapshot> snapshot, int body) const {
    return {std::move(snapshot), body, seed_, rays_};
  }

  const std::shared_ptr<const world::Snapshot>& snapshot() const { return snapshot_; }
  int body() const { return body_; }
  const world::Body& robot() const { return snapshot_->layout->bodies[body_]; }

  // The solids of the world at this instant; built on first use, shared by all who sample it. Valid
  // as long as the sampling.
  const RayScene& Rays() const {
    if (scene_ == nullptr) scene_ = rays_.At(snapshot_);
    return *scene_;
  }

  // The distance along a ray to the nearest surface that is not the robot's; infinite if there is
  // none within the ray's length.
  double Range(const Ray& ray) const;

  // So many rays more are about to be cast from about the robot: it may pay to look around first.
  void ExpectRays(std::size_t count) const { expected_rays_ += count; }

  geometry::Pose WorldFromSensor(const model::SensorDescription& description) const {
    if (link_ != description.link) {
      link_ = description.link;
      world_from_link_ = world::LinkPose(*snapshot_, body_, link_);
    }
    return world_from_link_ * description.link_from_sensor;
  }

  std::uint64_t seed() const { return seed_; }

  // The noise of this sensor at this instant, keyed by (seed, robot, sensor, step).
  base::Noise NoiseOf(const model::SensorDescription& description) const {
    return {seed_, base::StableId(robot().name + "/" + description.name),
            static_cast<std::uint64_t>(snapshot_->state.step)};
  }

  // A reading without values, stamped with this instant.
  Reading Stamped() const {
    return {snapshot_->state.step, snapshot_->state.time, {}, nullptr, nullptr};
  }

 private:
  std::shared_ptr<const world::Snapshot> snapshot_;
  int body_;
  std::uint64_t seed_;
  RaySceneCache& rays_;
  mutable std::shared_ptr<const RayScene> scene_;  // null until it is asked for
  mutable std::size_t expected_rays_ = 0;
  mutable bool has_gathered_ = false;  // candidates_ are those of the body
  mutable std::unique_ptr<CandidateSet> candidates_;
  mutable int link_ = -1;  // whose pose is known
  mutable geometry::Pose world_from_link_;
};

class Device;

// A line in the sensor's frame, from where the beam starts to where it ends.
struct Segment {
  geometry::Vector3 from, to;
};

// What a sensor with a field of view sees: the angle from left to right (rad), width by height.
struct Frustum {
  double horizontal_fov = 0;
  double aspect_ratio = 1;
};

class Sensor {
 public:
  explicit Sensor(model::SensorDescription description) : description_(std::move(description)) {}
  virtual ~Sensor() = default;
  Sensor(const Sensor&) = delete;
  Sensor& operator=(const Sensor&) = delete;

  const model::SensorDescription& description() const { return description_; }

  // May take long (an image): called on the stepping thread, as by the judge of a verdict, it
  // delays the next step by as much. Fails only where the means are missing: a camera without a
  // renderer.
  virtual base::Result<Reading> Sample(const Sampling& sampling) const = 0;
  // Sample() waits for something outside of the caller's thread, such as a renderer.
  virtual bool TakesLong() const { return false; }

  // Whether Sample() casts rays: then who samples many has the scene made ready for all beforehand.
  virtual bool CastsRays() const { return false; }

  using Bytes = std::vector<std::uint8_t>;
  // One of this sensor's readings as its type's message, in CDR; `frame_id` is the sensor's frame.
  // Nothing of a type without a message. kCorrupt for a reading that has another size than the
  // type's layout says.
  virtual base::Result<Bytes> Encode(const Reading& /*reading*/,
                                     const std::string& /*frame_id*/) const {
    return Bytes();
  }
  // The same of the message that goes beside it, of a type with a companion.
  virtual Bytes EncodeCompanion(base::SimTime /*time*/, const std::string& /*frame_id*/) const {
    return {};
  }
  // That message of a type whose companion goes with each reading (Companion::of_readings). Of
  // other types it is the same for every reading of one instant.
  virtual Bytes EncodeCompanionOf(const Reading& reading, const std::string& frame_id) const {
    return EncodeCompanion(reading.time, frame_id);
  }
  // What a viewer draws of a reading; a point at each end for types that are drawn as points.
  virtual std::vector<Segment> Beams(const Reading& /*reading*/) const { return {}; }
  // Nothing of a sensor without a field of view.
  virtual std::optional<Frustum> frustum() const { return std::nullopt; }

  // This sensor as a device, or null if it keeps no state from one step to the next.
  virtual const Device* device() const { return nullptr; }

 private:
  model::SensorDescription description_;
};

}  // namespace gsv::sensing
