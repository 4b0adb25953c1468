// Histories keeps the last minutes of every simulation of this program (see RunHistory).
//
// Threads  any. This object has its own thread, which samples the simulations.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/gateway/program/ports.h"
#include "gsv/recording/run_history.h"

namespace gsv::gateway::history {

// Keeps the last minutes of every simulation.
class Histories {
 public:
  using SimulationPointer = std::shared_ptr<simulation::Simulation>;
  // Returns whether the simulation has viewers.
  using IsWatched = std::function<bool(const SimulationPointer&)>;

  // `capacity`: bytes for each simulation. This object's own thread calls `is_watched`.
  Histories(std::shared_ptr<SimulationDirectory> directory, std::size_t capacity,
            IsWatched is_watched);
  ~Histories() { Stop(); }

  // Returns the history of a simulation. Starts a history if the simulation has none.
  std::shared_ptr<recording::RunHistory> Of(const SimulationPointer& simulation);

  // Ends the thread.
  void Stop();

 private:
  // A simulation and its history.
  struct Entry {
    std::weak_ptr<simulation::Simulation> simulation;
    std::shared_ptr<recording::RunHistory> history;
  };

  // The main function of the thread.
  void Run();
  // Samples each simulation. Returns true if any simulation has viewers.
  bool Round();

  const std::shared_ptr<SimulationDirectory> directory_;
  const std::size_t capacity_;
  const IsWatched is_watched_;
  base::Mutex mutex_;
  base::ConditionVariable changed_;  // notified when the thread must end
  std::vector<Entry> entries_ GSV_GUARDED_BY(mutex_);
  bool is_stopping_ GSV_GUARDED_BY(mutex_) = false;
  std::thread thread_;  // executes Run()
};

}  // namespace gsv::gateway::history
