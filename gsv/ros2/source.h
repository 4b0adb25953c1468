// Something that is published at regular instants of simulated time.
//
// Threads  one at a time.
#pragma once

#include <cstdint>
#include <memory>

#include "gsv/recording/topics/instants.h"
#include "gsv/ros2/dds/participant.h"
#include "gsv/sensing/rays/ray_scene.h"
#include "gsv/world/snapshot.h"

namespace gsv::ros2 {

// A source's messages are a function of this.
struct Moment {
  std::shared_ptr<const world::Snapshot> snapshot;
  std::uint64_t seed = 0;  // seed of the simulation
  sensing::RaySceneCache& rays;
};

class Source {
 public:
  explicit Source(base::SimTime period) : period_(period), instants_(period) {}
  virtual ~Source() = default;

  base::SimTime period() const { return period_; }
  // Whether an instant has come; asked once for each snapshot.
  bool Pass(base::SimTime time) { return instants_.Pass(time); }

  // Whether anybody listens.
  virtual bool is_wanted() const = 0;
  // Publish() waits for something outside of its thread, such as a renderer.
  virtual bool takes_long() const { return false; }
  // Encodes and sends messages on topics that have subscriptions.
  virtual void Publish(const Moment& moment) = 0;

 private:
  const base::SimTime period_;
  recording::Instants instants_;
};

}  // namespace gsv::ros2
