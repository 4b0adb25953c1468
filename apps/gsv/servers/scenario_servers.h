// Servers that run scenarios for others, found through a broker: for campaigns with more runs than
// one machine can do.
//
// Servers may join and leave during the work: the broker is queried about once a second. A server
// that was killed, or that cannot be reached for ten seconds, is lost, and its runs in progress are
// given to another server.
//
// Threads  any number call Run(), each for its own run.
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
  // `constraint`: over the properties of gsv::ScenarioService (docs/services.md); empty: any.
  // kUnavailable if there is none. Starts this process's ORB.
  static base::Result<std::unique_ptr<ScenarioServers>> Find(const std::string& broker,
                                                             const std::string& constraint);
  ~ScenarioServers();

  // Runs the scenario on the server with most free slots, and waits for a slot. Returns the
  // outcome: status, message, report, wall-clock time. kInterrupted if the run was cancelled or no
  // servers are left.
  TestResult Run(const std::string& scenario, double timeout,
                 const std::atomic<bool>& is_cancelled);

  // The reason for giving up: there was no server for a minute. Empty: it has not given up.
  std::string failure() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Server {
    std::string key, name;  // its reference; its name for users
    sba::ScenarioService_var service;
    int slots = 0, given = 0;
    Clock::time_point avoided_until{};  // it was lost, or has no free slot
  };
  enum class Ending { kDone, kNoRoom, kLost };

  ScenarioServers(const CORBA::ORB_var& orb, broker::BrokerClient broker, std::string constraint)
      : orb_(orb), broker_(std::move(broker)), constraint_(std::move(constraint)) {}

  base::Status Refresh();
  void Merge(const std::vector<broker::FoundOffer>& offers) GSV_REQUIRES(mutex_);
  std::shared_ptr<Server> Acquire(const std::atomic<bool>& is_cancelled);
  std::shared_ptr<Server> Roomiest() GSV_REQUIRES(mutex_);  // null: none has a free slot
  void Release(Server& server, Ending ending);
  Ending RunAt(Server& server, const std::string& scenario, double timeout,
               const std::atomic<bool>& is_cancelled, TestResult& result);

  CORBA::ORB_var orb_;
  broker::BrokerClient broker_;
  const std::string constraint_;
  mutable base::Mutex mutex_;
  base::ConditionVariable room_;
  std::vector<std::shared_ptr<Server>> servers_
      GSV_GUARDED_BY(mutex_);  // in the order of the broker
  bool is_refreshing_ GSV_GUARDED_BY(mutex_) = false;
  Clock::time_point refreshed_ GSV_GUARDED_BY(mutex_){},
      served_{};  // served_: when a server existed last
  std::string failure_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::app
