// A queue of snapshots and events between a simulation and a slower consumer: the stepping thread
// does not wait.
//
// Threads      any; Next() from one.
// Bounded      snapshots by a capacity: if the queue is full, the producer waits or the snapshot is
//              dropped and counted. Events never wait, as they come under the simulation's locks;
//              excess ones are dropped.
// Determinism  in lockstep nothing is dropped, and the stepping thread takes the lists of sensors
//              while all agents wait.
#pragma once

#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/recording/mcap/mcap_writer.h"
#include "gsv/recording/topics/instants.h"
#include "gsv/simulation/simulation.h"

namespace gsv::recording {

using SensorLists = std::map<std::string, std::vector<model::SensorDescription>>;  // by robot

// The sensors of all robots, avatars and stations of `layout`.
SensorLists SensorsOf(const simulation::Simulation& simulation, const world::Layout& layout);

struct Observation {
  std::shared_ptr<const world::Snapshot> snapshot;
  std::shared_ptr<const SensorLists> sensors;          // null: unchanged, or not checked
  std::optional<simulation::SimulationStatus> status;  // at its rate
};
using Occurrence = std::variant<Observation, simulation::Event>;

struct FeedOptions {
  WhenFull when_full = WhenFull::kDrop;
  std::size_t capacity = 256;  // snapshots
  base::SimTime status_period = std::chrono::milliseconds(200);
};

class SimulationFeed final : public simulation::Observer {
 public:
  // The stepping thread and CloseAtLatest() use `simulation`, which must exist then.
  SimulationFeed(const simulation::Simulation& simulation, FeedOptions options);

  void OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) override;
  void OnEvent(const simulation::Event& event) override;

  // The next occurrence; nothing after `timeout` of wall-clock time, or at the end.
  std::optional<Occurrence> Next(std::chrono::milliseconds timeout);

  // Closes the feed and releases waiting producers. Queued occurrences remain. A reset of the
  // simulation closes it, too.
  void Close();
  // As Close(), and appends the current state of the simulation, which must still exist.
  void CloseAtLatest();
  bool is_over() const;  // closed, and nothing is queued
  bool was_reset() const;
  std::uint64_t dropped() const;  // snapshots

 private:
  Observation Observe(const std::shared_ptr<const world::Snapshot>& snapshot);

  const simulation::Simulation& simulation_;
  const FeedOptions options_;

  // Used by the stepping thread only.
  Instants status_instants_;
  Instants sensor_instants_;
  std::shared_ptr<const world::Layout> layout_;  // for which the sensors were listed

  mutable base::Mutex mutex_;
  base::ConditionVariable news_;
  base::ConditionVariable room_;
  std::deque<Occurrence> queue_ GSV_GUARDED_BY(mutex_);
  std::size_t snapshots_ GSV_GUARDED_BY(mutex_) = 0;  // in queue_
  bool closed_ GSV_GUARDED_BY(mutex_) = false;
  bool was_reset_ GSV_GUARDED_BY(mutex_) = false;
  std::uint64_t dropped_ GSV_GUARDED_BY(mutex_) = 0;
};

}  // namespace gsv::recording
