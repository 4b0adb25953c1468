// The clocks of one agent, which determine whether the simulation waits for the agent. The class
// holds only data. It has no threads and reads no clock of the system.
//
// An open clock either runs or waits for an instant. An agent runs from its start until all its
// open clocks wait. It has finished when all its clocks are closed.
#pragma once

#include <algorithm>
#include <cstdint>
#include <utility>

#include <boost/container/small_vector.hpp>

#include "gsv/base/hash.h"
#include "gsv/base/sim_time.h"
#include "gsv/simulation/agent.h"

namespace gsv::simulation {

// The clocks of one agent. A behaviour uses a clock to wait for an instant of simulated time.
class AgentClocks {
 public:
  // Opens a clock, which then runs.
  ClockId Open();
  bool IsOpen(ClockId clock) const { return Find(clock) != nullptr; }
  // Closes a clock.
  void Close(ClockId clock);

  // Makes the clock wait until the first step at or after `until`. Returns true if that step has
  // already been taken; then the clock does not wait. A repeated call with the same instant changes
  // nothing, even if a pending wait has reached the instant: only Wake() ends this wait. So if the
  // simulation pauses at the instant, the agent does not run.
  bool WaitUntil(ClockId clock, base::SimTime until, base::SimTime now);

  // Whether the clock waits.
  bool IsWaiting(ClockId clock) const;
  bool IsWaitingUntil(ClockId clock, base::SimTime until) const;

  // Ends the waits for instants up to `now`. Returns whether a clock that waited now runs again.
  bool Wake(base::SimTime now);

  int count() const { return static_cast<int>(clocks_.size()); }  // The number of open clocks.
  // Whether the behaviour has opened a clock since the start.
  bool HasOpened() const { return next_id_ > 1; }
  // Whether the behaviour has closed all its clocks.
  bool IsFinished() const { return HasOpened() && clocks_.empty(); }
  // Whether a clock runs, or none has been opened yet.
  bool IsRunning() const;

  // The cycle number of the clock's last exchange with a command; 0 if there was none.
  std::uint64_t last_cycle(ClockId clock) const;
  void set_last_cycle(ClockId clock, std::uint64_t cycle);

  void AddToHash(base::Hash& hash) const;

 private:
  // An open clock.
  struct Clock {
    ClockId id = 0;
    bool waiting = false;          // whether the clock waits for `until`
    base::SimTime until{0};        // the instant to wait for
    std::uint64_t last_cycle = 0;  // see AgentClocks::last_cycle()
  };
  // Returns null if the clock is not open.
  const Clock* Find(ClockId id) const {
    const auto it = std::find_if(clocks_.begin(), clocks_.end(),
                                 [id](const Clock& clock) { return clock.id == id; });
    return it == clocks_.end() ? nullptr : &*it;
  }
  Clock* Find(ClockId id) { return const_cast<Clock*>(std::as_const(*this).Find(id)); }

  // The open clocks, ordered by id. Most agents have one, which needs no allocation.
  boost::container::small_vector<Clock, 1> clocks_;
  ClockId next_id_ = 1;
};

}  // namespace gsv::simulation
