// sba::ScenarioService: whole scenarios, each run in a child process as `gsv test` does.
//
// Threads  ORB threads; one more a run, and one that ends those that nobody asks about.
#pragma once

#include <set>
#include <thread>

#include "gsv/base/mutex.h"

#include "idl/scenario.hh"

namespace gsv::app {

class ScenarioRunServant;

class ScenarioServiceServant final : public POA_sba::ScenarioService {
 public:
  // `capacity`: how many at once; 0: none.
  ScenarioServiceServant(PortableServer::POA_ptr poa, int capacity);
  ~ScenarioServiceServant() override;

  sba::ScenarioRun_ptr run(const char* scenario, const sba::NameValues& options) override;

  int under_way() const;
  // Ends all runs; calls on their references find nothing any more.
  void Close();

 private:
  friend class ScenarioRunServant;

  void Forget(ScenarioRunServant* run);
  void EndAbandoned();

  const PortableServer::POA_var poa_;
  const int capacity_;
  mutable base::Mutex mutex_;
  base::ConditionVariable closing_changed_;
  bool closing_ GSV_GUARDED_BY(mutex_) = false;
  std::set<ScenarioRunServant*> runs_ GSV_GUARDED_BY(mutex_);  // the POA holds them
  std::jthread janitor_;
};

}  // namespace gsv::app
