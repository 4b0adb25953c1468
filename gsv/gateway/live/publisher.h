// A Publisher is the thread that runs all live streams with clients at the publish rate, and at
// once after a subscription. It sleeps while there are no viewers.
#pragma once

#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/gateway/live/live_stream.h"
#include "gsv/gateway/program/ports.h"

namespace gsv::gateway {

// The thread that runs all live streams with clients.
class Publisher {
 public:
  // Sensors are read on `watchers`, commands run on `commanders`. `recordings` and `registry` may
  // be null. Both pools, `recordings` and `registry` must outlive the publisher and its streams.
  Publisher(std::shared_ptr<SimulationDirectory> directory, WorkerPool& watchers,
            WorkerPool& commanders, RecordingSwitch* recordings,
            access::ViewerRegistry* registry = nullptr);
  ~Publisher();

  // Returns the hub of a simulation, which is created at the first call.
  std::shared_ptr<Hub> HubOf(const std::shared_ptr<simulation::Simulation>& simulation);
  // Requests the topics of a robot's sensors, see SensorTopics::Want().
  void WantSensorsOf(const std::shared_ptr<simulation::Simulation>& simulation,
                     const std::string& robot);

  // Whether the simulation has viewers.
  bool IsWatched(const std::shared_ptr<simulation::Simulation>& simulation) const;

  // Ends the thread and refuses further clients.
  void Stop();

 private:
  // A simulation and its live stream.
  struct Entry {
    std::string name;
    std::weak_ptr<simulation::Simulation> simulation;
    std::shared_ptr<LiveStream> stream;
  };

  // Returns the live stream of a simulation, which is created at the first call.
  std::shared_ptr<LiveStream> StreamOf(const std::shared_ptr<simulation::Simulation>& simulation);
  // The main function of the thread.
  void Run();
  // Makes the thread run a round at once.
  void Wake();
  // Runs each stream with clients once. Returns false if there are no viewers.
  bool Round();
  // Closes streams whose simulation is no longer in the directory.
  void DropEnded();
  // Returns a copy of entries_.
  std::vector<Entry> Entries() const;

  const std::shared_ptr<SimulationDirectory> directory_;
  WorkerPool& watchers_;               // reads sensors
  WorkerPool& commanders_;             // runs commands
  RecordingSwitch* const recordings_;  // starts and stops recordings
  access::ViewerRegistry* const registry_;
  mutable base::Mutex mutex_;
  base::ConditionVariable changed_;  // notified when a round is requested or the thread must end
  std::vector<Entry> entries_ GSV_GUARDED_BY(mutex_);
  bool is_woken_ GSV_GUARDED_BY(mutex_) = false;  // whether a round was requested, see Wake()
  bool is_stopping_ GSV_GUARDED_BY(mutex_) = false;
  Pacing directory_pacing_;  // limits the rate of DropEnded(); used by thread_ only
  std::thread thread_;       // executes Run()
};

}  // namespace gsv::gateway
