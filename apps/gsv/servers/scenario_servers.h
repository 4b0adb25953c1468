// Servers that run scenarios for others, found through a broker: for a campaign that has more runs
// than one machine is to do.
//
// Who joins or leaves while it works is noticed: the broker is asked again about once a second. A
// server that is killed, or that nobody reaches for ten seconds, is lost, and what was under way
// there is given to another.
//
// Threads  any number call Run(), each for a run of its own.
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
  // kUnavailable when there is none. Starts this process's ORB.
  static base::Result<std::unique_ptr<ScenarioServers>> Find(const std::string& broker,
                                                             const std::string& constraint);
  ~ScenarioServers();

  // Runs it where there is most room, waiting for room, and comes back with its outcome: status,
  // message, report, wall time. kInterrupted when it was cancelled or there are no servers any
  // more.
  TestResult Run(const std::string& scenario, double timeout,
                 const std::atomic<bool>& is_cancelled);

  // Why it gave up: there was no server for a minute. Empty: it did not.
  std::string failure() const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Server {
    std::string key, name;  // its reference; what people call it
    sba::ScenarioService_var service;
    int slots = 0, given = 0;
    Clock::time_point avoided_until{};  // it was lost, or has no room
  };
  enum class Ending { kDone, kNoRoom, kLost };

  ScenarioServers(const CORBA::ORB_var& orb, broker::BrokerClient broker, std::string constraint)
      : orb_(orb), broker_(std::move(broker)), constraint_(std::move(constraint)) {}

  base::Status Refresh();
  void Merge(const std::vector<broker::FoundOffer>& offers) GSV_REQUIRES(mutex_);
  std::shared_ptr<Server> Acquire(const std::atomic<bool>& is_cancelled);
  std::shared_ptr<Server> Roomiest() GSV_REQUIRES(mutex_);  // null: none has room
  void Release(Server& server, Ending ending);
  Ending RunAt(Server& server, const std::string& scenario, double timeout,
               const std::atomic<bool>& is_cancelled, TestResult& result);

  CORBA::ORB_var orb_;
  broker::BrokerClient broker_;
  const std::string constraint_;
  mutable base::Mutex mutex_;
  base::ConditionVariable room_;
  std::vector<std::shared_ptr<Server>> servers_
      GSV_GUARDED_BY(mutex_);  // as the broker orders them
  bool is_refreshing_ GSV_GUARDED_BY(mutex_) = false;
  Clock::time_point refreshed_ GSV_GUARDED_BY(mutex_){},
      served_{};  // served_: when there last was a server
  std::string failure_ GSV_GUARDED_BY(mutex_);
};

}  // namespace gsv::app
