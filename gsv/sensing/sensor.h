// A sensor of a model. It has no state that belongs to one robot: one Sensor serves all robots of
// the model.
//
// Threads      a Sensor's const members may run concurrently; a Sampling belongs to one thread.
// Determinism  Sample() depends only on the sampling's snapshot, robot and seed.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/base/random.h"
#include "gsv/messages/cdr.h"
#include "gsv/sensing/rays/candidate_set.h"
#include "gsv/sensing/rays/ray_scene.h"
#include "gsv/sensing/reading.h"
#include "gsv/world/snapshot.h"

namespace gsv::sensing {

// All inputs of a reading. Sensors of a robot should share a sampling, because the sampling caches
// data that they have in common.
class Sampling {
 public:
  // `body` is the robot's index in the snapshot's layout. `rays` outlives the sampling.
  Sampling(std::shared_ptr<const world::Snapshot> snapshot, int body, std::uint64_t seed,
           RaySceneCache& rays)
      : snapshot_(std::move(snapshot)), body_(body), seed_(seed), rays_(rays) {}

  // Makes this sampling refer to another robot at the same instant.
  void MoveTo(int body);
  // Returns a sampling of the same robot at another instant. `body` is an index in the layout of
  // `snapshot`.
  Sampling At(std::shared_ptr<const world::Snapshot> snapshot, int body) const {
    return {std::move(snapshot), body, seed_, rays_};
  }

  const std::shared_ptr<const world::Snapshot>& snapshot() const { return snapshot_; }
  int body() const { return body_; }
  const world::Body& robot() const { return snapshot_->layout->bodies[body_]; }

  // The solids of the world at this instant, built on first use and shared between samplings. Valid
  // during the lifetime of the sampling.
  const RayScene& Rays() const {
    if (scene_ == nullptr) scene_ = rays_.At(snapshot_);
    return *scene_;
  }

  // Returns the distance along a ray to the nearest surface of another body; infinite if there is
  // none within the ray's length.
  double Range(const Ray& ray) const;

  // Announces `count` rays from near the robot. If there are many, gathering a candidate set saves
  // time.
  void ExpectRays(std::size_t count) const { expected_rays_ += count; }

  // Returns the pose of a sensor of this robot in the world.
  geometry::Pose WorldFromSensor(const model::SensorDescription& description) const {
    if (link_ != description.link) {
      link_ = description.link;
      world_from_link_ = world::LinkPose(*snapshot_, body_, link_);
    }
    return world_from_link_ * description.link_from_sensor;
  }

  std::uint64_t seed() const { return seed_; }

  // Returns the noise of this sensor at this instant, keyed by (seed, robot, sensor, step).
  base::Noise NoiseOf(const model::SensorDescription& description) const {
    return {seed_, base::StableId(robot().name + "/" + description.name),
            static_cast<std::uint64_t>(snapshot_->state.step)};
  }

  // Returns a reading without values, stamped with this instant.
  Reading Stamped() const {
    return {snapshot_->state.step, snapshot_->state.time, {}, nullptr, nullptr};
  }

 private:
  std::shared_ptr<const world::Snapshot> snapshot_;
  int body_;                                       // index of the robot's body in the layout
  std::uint64_t seed_;                             // seed of the simulation
  RaySceneCache& rays_;                            // creates scene_
  mutable std::shared_ptr<const RayScene> scene_;  // null until the first use
  mutable std::size_t expected_rays_ = 0;          // number of rays that ExpectRays() announced
  mutable bool has_gathered_ = false;              // whether candidates_ belong to the present body
  // solids near the robot; null until they are needed
  mutable std::unique_ptr<CandidateSet> candidates_;
  mutable int link_ = -1;  // index of the link whose pose is world_from_link_
  mutable geometry::Pose world_from_link_;
};

class Device;

// A line in the sensor's frame (m), from where the beam starts to where it ends.
struct Segment {
  geometry::Vector3 from, to;
};

// A field of view: the angle from left to right (rad), and width over height.
struct Frustum {
  double horizontal_fov = 0;
  double aspect_ratio = 1;
};

// The ray of a sensor that reads one distance: along the x axis of its frame.
struct Beam {
  double min = 0, max = 0;  // m

  // Returns the value of the reading. `echo` is the distance to the nearest surface within `max`;
  // infinite if there is none.
  double ValueOf(double echo) const { return echo >= min ? std::min(echo, max) : max; }
};

// Base class of all sensors. It computes a reading from a snapshot of the world.
class Sensor {
 public:
  explicit Sensor(model::SensorDescription description) : description_(std::move(description)) {}
  virtual ~Sensor() = default;
  Sensor(const Sensor&) = delete;
  Sensor& operator=(const Sensor&) = delete;

  const model::SensorDescription& description() const { return description_; }

  // Takes a reading. May be slow, for example for an image. A slow call on the stepping thread
  // delays the next step. Fails if something is missing, such as a renderer for a camera or the
  // joint of an encoder.
  virtual base::Result<Reading> Sample(const Sampling& sampling) const = 0;
  // Whether Sample() waits for another thread, such as a renderer.
  virtual bool TakesLong() const { return false; }

  // Whether Sample() casts rays. Callers that sample many sensors then prepare the ray scene first.
  virtual bool CastsRays() const { return false; }

  // Returns the beam if Sample() returns only the value of one beam. Null for other sensors, and
  // for sensors with noise.
  virtual const Beam* beam() const { return nullptr; }

  using Bytes = std::vector<std::uint8_t>;
  // Appends a reading to `out` as the type's message, in CDR; `frame_id` is the sensor's frame. If
  // the type has no message, appends nothing. Fails with kCorrupt if the reading does not have the
  // size of the type's layout.
  virtual base::Status AppendMessage(const Reading& /*reading*/, const std::string& /*frame_id*/,
                                     messages::Bytes& /*out*/) const {
    return {};
  }
  // Returns the message that AppendMessage() appends.
  base::Result<Bytes> Encode(const Reading& reading, const std::string& frame_id) const;
  // Encodes the companion message: a second message beside the message of a reading, such as the
  // camera_info of an image (Companion in registry.h). Returns no bytes if the type has none.
  virtual Bytes EncodeCompanion(base::SimTime /*time*/, const std::string& /*frame_id*/) const {
    return {};
  }
  // Encodes the companion message for one reading (Companion::of_readings). By default, the message
  // is the same for all readings of one instant.
  virtual Bytes EncodeCompanionOf(const Reading& reading, const std::string& frame_id) const {
    return EncodeCompanion(reading.time, frame_id);
  }
  // Returns the beams of a reading for viewers. For sensor types that are drawn as points, the ends
  // of the beams are drawn.
  virtual std::vector<Segment> Beams(const Reading& /*reading*/) const { return {}; }
  // The field of view, if the sensor has one.
  virtual std::optional<Frustum> frustum() const { return std::nullopt; }

  // Returns this sensor as a device, or null if it keeps no state between steps.
  virtual const Device* device() const { return nullptr; }

 private:
  model::SensorDescription description_;
};

}  // namespace gsv::sensing
