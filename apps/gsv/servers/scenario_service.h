// sba::ScenarioService: whole scenarios, each run in a child process as `gsv test` does.
//
// Threads  ORB threads; one more a run, and one that ends those that nobody asks about.
#pragma once

#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>

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
  mutable std::mutex mutex_;
  std::condition_variable closing_changed_;
  bool closing_ = false;
  std::set<ScenarioRunServant*> runs_;  // the POA holds them
  std::jthread janitor_;
};

}  // namespace gsv::app
