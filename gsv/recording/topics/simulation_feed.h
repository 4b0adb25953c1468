// What a simulation does, queued for somebody slower: the stepping thread hands over its snapshots
// and goes on.
//
// Threads      any; Next() from one.
// Bounded      snapshots by a capacity: what finds the queue full waits or is dropped and counted.
//              Events never wait (they come under the simulation's locks); too many are dropped.
// Determinism  in lockstep nothing is dropped, and the sensors' lists are taken by the stepping
//              thread, while all agents wait.
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

// The sensors of all robots, avatars and stations that stand in `layout`.
SensorLists SensorsOf(const simulation::Simulation& simulation, const world::Layout& layout);

struct Observation {
  std::shared_ptr<const world::Snapshot> snapshot;
  std::shared_ptr<const SensorLists> sensors;          // null: as before, or not looked at
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
  // The simulation is used by the stepping thread, which it outlives, and in CloseAtLatest().
  SimulationFeed(const simulation::Simulation& simulation, FeedOptions options);

  void OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) override;
  void OnEvent(const simulation::Event& event) override;

  // The next one; nothing if none comes within `patience` of wall time, or no more will.
  std::optional<Occurrence> Next(std::chrono::milliseconds patience);

  // Takes nothing more, and lets those go on who wait. What is queued stays. A reset of the
  // simulation closes it, too.
  void Close();
  // The same, with the simulation as it stands, which must be there still, behind what is queued:
  // nothing is of a later instant.
  void CloseAtLatest();
  bool is_over() const;  // closed, and nothing is queued
  bool was_reset() const;
  std::uint64_t dropped() const;  // snapshots

 private:
  Observation Observe(const std::shared_ptr<const world::Snapshot>& snapshot);

  const simulation::Simulation& simulation_;
  const FeedOptions options_;

  // The stepping thread's.
  Instants status_instants_;
  Instants sensor_instants_;
  std::shared_ptr<const world::Layout> layout_;  // whose sensors were looked at

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
