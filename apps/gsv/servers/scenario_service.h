// Implements sba::ScenarioService, through which campaigns run scenarios on this server. Each
// scenario runs in a child process, as with `gsv test`.
//
// Threads  the ORB's threads call the servants. Each run has its own thread, and another thread
//          ends abandoned runs.
#pragma once

#include <set>
#include <thread>

#include "gsv/base/mutex.h"

#include "idl/scenario.hh"

namespace gsv::app {

// One run, as a CORBA object.
class ScenarioRunServant;

class ScenarioServiceServant final : public POA_sba::ScenarioService {
 public:
  // `capacity` is the number of concurrent runs, or 0 for none.
  ScenarioServiceServant(PortableServer::POA_ptr poa, int capacity);
  ~ScenarioServiceServant() override;

  sba::ScenarioRun_ptr run(const char* scenario, const sba::NameValues& options) override;

  int running() const;  // number of runs in progress
  // Ends all runs. Later calls on their references fail.
  void Close();

 private:
  friend class ScenarioRunServant;

  // Removes a run from runs_, and deactivates its object.
  void Forget(ScenarioRunServant* run);
  // The function of janitor_: ends the runs whose campaign no longer calls.
  void EndAbandoned();

  const PortableServer::POA_var poa_;
  const int capacity_;  // maximum number of concurrent runs
  mutable base::Mutex mutex_;
  base::ConditionVariable closing_changed_;                    // notified by Close()
  bool closing_ GSV_GUARDED_BY(mutex_) = false;                // whether Close() was called
  std::set<ScenarioRunServant*> runs_ GSV_GUARDED_BY(mutex_);  // owned by the POA
  std::jthread janitor_;                                       // executes EndAbandoned()
};

}  // namespace gsv::app
