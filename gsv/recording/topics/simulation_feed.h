// A queue of snapshots and events between a simulation and a slower consumer. The stepping thread
// does not wait for the consumer.
//
// Threads      any; Next() from one thread only.
// Bounded      snapshots are limited by a capacity. If the queue is full, the producer waits, or
//              the snapshot is dropped and counted. Producers of events never wait, because events
//              are emitted under the simulation's locks; excess events are dropped.
// Determinism  with WhenFull::kWait, no snapshot is dropped. In lockstep, the stepping thread reads
//              the lists of sensors while the threads of all robots wait, so the lists do not
//              depend on thread timing.
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

// Sensors by robot.
using SensorLists = std::map<std::string, std::vector<model::SensorDescription>>;

// Returns the sensors of all robots, avatars and stations of `layout`.
SensorLists SensorsOf(const simulation::Simulation& simulation, const world::Layout& layout);

// A snapshot, with the sensors and the status that the stepping thread sampled at the same time.
struct Observation {
  std::shared_ptr<const world::Snapshot> snapshot;
  // Null if the sensors were not read at this snapshot.
  std::shared_ptr<const SensorLists> sensors;
  std::optional<simulation::SimulationStatus> status;  // set whenever the status is due
  // Set whenever the status is set; empty if the scenario has no expectations.
  std::vector<simulation::ExpectationState> expectations{};
};
// One element of the queue.
using Occurrence = std::variant<Observation, simulation::Event>;

struct FeedOptions {
  WhenFull when_full = WhenFull::kDrop;
  std::size_t capacity = 256;  // maximum number of snapshots in the queue
  base::SimTime status_period = std::chrono::milliseconds(200);
};

class SimulationFeed final : public simulation::Observer {
 public:
  // `simulation` must exist while its stepping thread calls this feed, and during CloseAtLatest().
  SimulationFeed(const simulation::Simulation& simulation, FeedOptions options);

  void OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) override;
  void OnEvent(const simulation::Event& event) override;

  // Returns the next snapshot or event. Returns nullopt after `timeout` of wall-clock time, or if
  // is_over().
  std::optional<Occurrence> Next(std::chrono::milliseconds timeout);

  // Closes the feed, and wakes producers that wait. Queued entries remain. A reset of the
  // simulation also closes the feed.
  void Close();
  // Appends the current state of the simulation, which must still exist, and closes the feed.
  void CloseAtLatest();
  bool is_over() const;           // Whether the feed is closed and the queue is empty.
  bool was_reset() const;         // whether a reset of the simulation has closed the feed
  std::uint64_t dropped() const;  // The number of dropped snapshots.

 private:
  // Makes the observation of a snapshot. Samples the status and the sensors if they are due.
  Observation Observe(const std::shared_ptr<const world::Snapshot>& snapshot);

  const simulation::Simulation& simulation_;
  const FeedOptions options_;

  // Only the stepping thread uses the next four members: the instants at which the status and the
  // lists of sensors are read, and the state at the last reading of the lists.
  Instants status_instants_;
  Instants sensor_instants_;
  std::shared_ptr<const world::Layout> layout_;
  std::uint64_t sensor_changes_ = 0;  // Simulation::sensor_changes()

  mutable base::Mutex mutex_;
  base::ConditionVariable news_;  // notified when the queue gets an element or is closed
  base::ConditionVariable room_;  // notified when the queue has space for a snapshot
  std::deque<Occurrence> queue_ GSV_GUARDED_BY(mutex_);
  std::size_t snapshots_ GSV_GUARDED_BY(mutex_) = 0;  // number of snapshots in queue_
  bool closed_ GSV_GUARDED_BY(mutex_) = false;        // whether the queue accepts no more entries
  bool was_reset_ GSV_GUARDED_BY(mutex_) = false;
  std::uint64_t dropped_ GSV_GUARDED_BY(mutex_) = 0;  // number of dropped snapshots
};

}  // namespace gsv::recording
