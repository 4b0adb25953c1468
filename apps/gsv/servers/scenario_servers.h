// Executes the runs of a campaign on servers (`gsv serve --scenarios N`), which it finds through a
// broker.
//
// Servers may be added and removed during the work: the broker is queried about once a second. A
// server is lost if it was killed, or cannot be reached for ten seconds. Its runs in progress are
// repeated on another server.
//
// Threads  any number may call Run(), each for its own run.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <vector>

#include "apps/gsv/trials/test_cases.h"
#include "gsv/base/mutex.h"
#include "gsv/broker/client/broker_client.h"
#include "idl/scenario.hh"

namespace gsv::app {

class ScenarioServers {
 public:
  // Finds the servers. `constraint` uses the properties of gsv::ScenarioService (docs/services.md),
  // and may be empty. Returns kUnavailable if there is no server. Starts this process's ORB.
  static base::Result<std::unique_ptr<ScenarioServers>> Find(const std::string& broker,
                                                             const std::string& constraint);
  ~ScenarioServers();

  // Waits until a slot is free, and runs the scenario on the least loaded server. Returns the
  // outcome: status, message, report, wall-clock time. Returns kInterrupted if the run was
  // cancelled or no servers are left.
  TestResult Run(const std::string& scenario, double timeout,
                 const std::atomic<bool>& is_cancelled);

  // Returns an error sentence if no server was available for a minute. Run() then starts no more
  // runs. Otherwise, returns an empty text.
  std::string failure() const;

 private:
  using Clock = std::chrono::steady_clock;
  // A server that the broker offers.
  struct Server {
    std::string key, name;  // the server's reference, and its name in messages
    sba::ScenarioService_var service;
    // Number of runs that the server executes at once, and number of runs that it executes for this
    // process.
    int slots = 0, given = 0;
    // the time until which it gets no runs, because it was lost or has no free slot
    Clock::time_point avoided_until{};
  };
  // How an attempt to run a scenario on a server has ended.
  enum class Ending { kDone, kNoFreeSlot, kLost };

  ScenarioServers(const CORBA::ORB_var& orb, broker::BrokerClient broker, std::string constraint)
      : orb_(orb), broker_(std::move(broker)), constraint_(std::move(constraint)) {}

  // Queries the broker for servers.
  base::Status Refresh();
  // Updates servers_ with the offers of the broker.
  void Merge(const std::vector<broker::FoundOffer>& offers) GSV_REQUIRES(mutex_);
  // Waits for a server with a free slot, and increments its number of runs (`given`). Returns null
  // if the run is cancelled, or if no server was available for a minute.
  std::shared_ptr<Server> Acquire(const std::atomic<bool>& is_cancelled);
  // Returns the server with the smallest ratio of given / slots, or null if none has a free slot.
  std::shared_ptr<Server> ServerWithMostFreeSlots() GSV_REQUIRES(mutex_);
  // Decrements the server's number of runs after a run. A lost server gets no runs for 30 s, and a
  // full server for 1 s.
  void Release(Server& server, Ending ending);
  // Runs a scenario on a server. Sets `result` if the ending is kDone.
  Ending RunAt(Server& server, const std::string& scenario, double timeout,
               const std::atomic<bool>& is_cancelled, TestResult& result);

  CORBA::ORB_var orb_;
  broker::BrokerClient broker_;
  const std::string constraint_;
  mutable base::Mutex mutex_;
  base::ConditionVariable room_;  // notified when a slot may be free
  std::vector<std::shared_ptr<Server>> servers_
      GSV_GUARDED_BY(mutex_);  // in the order in which the broker returns the offers
  // Whether a thread is in Refresh().
  bool is_refreshing_ GSV_GUARDED_BY(mutex_) = false;
  Clock::time_point refreshed_ GSV_GUARDED_BY(mutex_){},
      served_{};  // the last time at which a server was available
  std::string failure_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::app
