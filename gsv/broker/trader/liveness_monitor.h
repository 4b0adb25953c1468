// Withdraws the offers of services that no longer exist.
//
// The monitor calls every offered service once per period. The calls are spread over the period. At
// most `concurrent` calls are in progress at a time, and each call ends within `timeout`. A service
// is dead at once if it reports its end, or if its port refuses connections. A service that does
// not answer is dead after `max_silence`. If an address does not answer, the monitor calls it only
// once per period, for all services at this address.
//
// The offer of a dead service is visible for at most two periods plus the time for silent
// addresses. This time is the number of these addresses times `timeout` / `concurrent`.
//
// Threads  the monitor starts its own threads.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/broker/trader/trader.h"

namespace gsv::broker {

struct LivenessOptions {
  std::chrono::milliseconds period{60'000};  // time between two calls of a service; 0: no calls
  // time without an answer after which a service counts as dead
  std::chrono::milliseconds max_silence{600'000};
  std::chrono::milliseconds timeout{1'000};  // time limit of one call
  int concurrent = 4;                        // number of calls at a time
};

// The state of a service.
enum class Liveness {
  kAlive,
  kGone,    // the service reported its end, or its port refuses connections
  kSilent,  // the service did not answer in time
};

class LivenessMonitor {
 public:
  // Calls the service of a stringified reference, with this time limit. Several threads call this
  // function at the same time.
  using Ask =
      std::function<Liveness(const std::string& reference, std::chrono::milliseconds timeout)>;

  LivenessMonitor(const LivenessOptions& options, Trader& trader, Ask ask);
  // Waits for the calls in progress.
  ~LivenessMonitor();
  LivenessMonitor(const LivenessMonitor&) = delete;
  LivenessMonitor& operator=(const LivenessMonitor&) = delete;

 private:
  using Clock = std::chrono::steady_clock;

  // A service, and the numbers of its offers.
  struct Service {
    std::string reference;
    std::string address;                // "host:port"; several services may have the same address
    std::vector<std::uint64_t> offers;  // numbers of the service's offers
  };

  void Work();  // the function of each thread
  // Calls services when they are due, one after the other, until the monitor ends.
  void AskDueServices();
  // Waits until the next service is due, and returns it. Returns null when the monitor ends.
  std::shared_ptr<const Service> Next(base::MutexLock& lock) GSV_REQUIRES(mutex_);
  // Begins to check all offered services again.
  void StartRound() GSV_REQUIRES(mutex_);
  // Returns true if the service is dead.
  bool Judge(const Service& service, Liveness pulse) GSV_REQUIRES(mutex_);
  // Withdraws all offers of a dead service.
  void Withdraw(const Service& service, Liveness pulse);

  const LivenessOptions options_;
  Trader& trader_;
  const Ask ask_;  // calls a service

  base::Mutex mutex_;
  base::ConditionVariable ending_changed_;      // notified when the monitor ends
  bool ending_ GSV_GUARDED_BY(mutex_) = false;  // whether the monitor ends
  // The services that are checked in this period, and the index of the next service to check.
  std::vector<std::shared_ptr<const Service>> round_ GSV_GUARDED_BY(mutex_);
  std::size_t next_ GSV_GUARDED_BY(mutex_) = 0;
  Clock::time_point round_start_ GSV_GUARDED_BY(mutex_);  // time of the last StartRound()
  // addresses that did not answer since the last StartRound()
  std::set<std::string> silent_addresses_ GSV_GUARDED_BY(mutex_);
  std::map<std::string, Clock::time_point> silent_since_ GSV_GUARDED_BY(mutex_);  // by reference
  std::vector<std::thread> workers_;  // joined by the destructor
};

}  // namespace gsv::broker
