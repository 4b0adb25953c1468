// Withdraws the offers of services that are gone.
//
// Every offered service is asked once a period whether it still exists. The questions are spread
// over the period, few are underway at a time, and each ends with its timeout. A service that says
// that it is gone, or whose port refuses connections, is dead at once; one that does not answer is
// dead when it has not answered for `patience`. An address that does not answer is asked once a
// period, for all services there.
//
// A dead offer is seen for at most two periods, and as long as it takes to ask the silent
// addresses: their number times `timeout` over `concurrent`.
//
// Threads  its own.
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
  std::chrono::milliseconds period{60'000};     // zero: no service is checked
  std::chrono::milliseconds patience{600'000};  // how long a service may be silent
  std::chrono::milliseconds timeout{1'000};     // of one question
  int concurrent = 4;                           // questions underway
};

enum class Liveness {
  kAlive,
  kGone,    // it reported so, or its port refuses connections
  kSilent,  // nothing came back in time
};

class LivenessMonitor {
 public:
  // Asks the service behind a stringified reference, for at most the time given. Called by
  // several threads at once.
  using Ask =
      std::function<Liveness(const std::string& reference, std::chrono::milliseconds timeout)>;

  LivenessMonitor(const LivenessOptions& options, Trader& trader, Ask ask);
  // Waits for the questions that are underway.
  ~LivenessMonitor();
  LivenessMonitor(const LivenessMonitor&) = delete;
  LivenessMonitor& operator=(const LivenessMonitor&) = delete;

 private:
  using Clock = std::chrono::steady_clock;

  struct Service {
    std::string reference;
    std::string address;
    std::vector<std::uint64_t> offers;
  };

  void Work();
  void AskDueServices();
  // The next service that is due, or null at the end. Waits for it.
  std::shared_ptr<const Service> Next(base::MutexLock& lock) GSV_REQUIRES(mutex_);
  void StartRound() GSV_REQUIRES(mutex_);
  // True when it is dead.
  bool Judge(const Service& service, Liveness pulse) GSV_REQUIRES(mutex_);
  void Withdraw(const Service& service, Liveness pulse);

  const LivenessOptions options_;
  Trader& trader_;
  const Ask ask_;

  base::Mutex mutex_;
  base::ConditionVariable ending_changed_;
  bool ending_ GSV_GUARDED_BY(mutex_) = false;
  std::vector<std::shared_ptr<const Service>> round_ GSV_GUARDED_BY(mutex_);
  std::size_t next_ GSV_GUARDED_BY(mutex_) = 0;
  Clock::time_point round_start_ GSV_GUARDED_BY(mutex_);
  std::set<std::string> silent_addresses_ GSV_GUARDED_BY(mutex_);                 // in this round
  std::map<std::string, Clock::time_point> silent_since_ GSV_GUARDED_BY(mutex_);  // by reference
  std::vector<std::thread> workers_;  // last: they use the others
};

}  // namespace gsv::broker
