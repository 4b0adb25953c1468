// Keeps the last minutes of a running simulation in memory, readable as a recording.
//
// A thread of the owner samples the simulation at rates of wall-clock time, so that sampling a fast
// run takes as much time as sampling a slow run. Each kind of sample (poses, status, readings, list
// of sensors) takes at most 1/20 of that thread's time while a viewer is connected, and 1/50
// otherwise. The stepping thread only stores the events and the collisions of each step.
//
// Records      Events, log, output, notes and collisions are always recorded. Poses, commands and
//              status are sampled at a low rate. While a viewer is connected, the rate is higher,
//              and health, sensor readings (no images) and beams are added.
// One run      a reset of the simulation starts a new history.
// Threads      SampleIfDue() from one thread; other functions from any.
#pragma once

#include <chrono>
#include <deque>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/recording/mcap/chunk_ring.h"
#include "gsv/simulation/simulation.h"

namespace gsv::recording {

// The start of a contact of a robot with another body.
struct Collision {
  base::SimTime time{};
  std::string robot, other;  // names of the robot and of the other body
};

// The history of a running simulation.
class RunHistory {
 public:
  using WallTime = std::chrono::steady_clock::time_point;

  // Rates of poses with and without viewers, in Hz of wall-clock time.
  static constexpr double kWatchedRate = 20;
  static constexpr double kUnwatchedRate = 4;

  // `capacity` is the maximum size of the history in memory, in bytes (see ChunkRing).
  RunHistory(const std::shared_ptr<simulation::Simulation>& simulation, std::size_t capacity);
  ~RunHistory();

  // Samples the simulation if a sample is due. `is_watched`: whether a viewer is connected.
  void SampleIfDue(WallTime now, bool is_watched);

  std::size_t capacity() const { return capacity_; }
  ChunkRing::Extent extent() const;
  // Returns the newest collisions of the run, ordered by time; at most 500.
  std::vector<Collision> collisions() const;

  // Returns a reader of the messages that are kept now. Waits up to half a second for messages that
  // were sampled but not yet written. Fails with kNotFound if there are no messages yet.
  [[nodiscard]] base::Result<std::unique_ptr<McapReader>> Open() const;

 private:
  // Inbox collects the events and collisions that the stepping thread reports. Run is the recording
  // of the current run.
  class Inbox;
  class Run;

  // Returns the recording of the current run; null before the first sample.
  std::shared_ptr<Run> run() const;
  // Appends to collisions_, and drops the oldest. A new run clears the list first.
  void KeepCollisions(const std::vector<Collision>& collisions, bool is_new_run);

  const std::weak_ptr<simulation::Simulation> simulation_;
  const std::size_t capacity_;
  const std::shared_ptr<Inbox> inbox_;

  mutable base::Mutex mutex_;
  std::shared_ptr<Run> run_ GSV_GUARDED_BY(mutex_);          // null before the first sample
  std::deque<Collision> collisions_ GSV_GUARDED_BY(mutex_);  // the newest collisions of the run
};

}  // namespace gsv::recording
