// A source of messages that are published at regular instants of simulated time.
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

// The instant of the simulation for which a source makes its messages.
struct Moment {
  std::shared_ptr<const world::Snapshot> snapshot;
  std::uint64_t seed = 0;        // seed of the simulation, for the noise of sensors
  sensing::RaySceneCache& rays;  // the ray scenes that all sources share
};

// A source publishes messages on one or several topics. They are made from snapshots, at a fixed
// period.
class Source {
 public:
  explicit Source(base::SimTime period) : period_(period), instants_(period) {}
  virtual ~Source() = default;

  base::SimTime period() const { return period_; }
  // Whether a message is due at this time. Called once for each snapshot.
  bool AdvanceTo(base::SimTime time) { return instants_.AdvanceTo(time); }

  // Whether a topic of the source has subscriptions.
  virtual bool is_wanted() const = 0;
  // Whether Publish() waits for another thread, such as the renderer's.
  virtual bool takes_long() const { return false; }
  // Encodes and sends messages on topics that have subscriptions.
  virtual void Publish(const Moment& moment) = 0;

 private:
  const base::SimTime period_;
  recording::Instants instants_;
};

}  // namespace gsv::ros2
