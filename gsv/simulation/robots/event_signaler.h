// Signals the wait events of many agents on its own thread, so that signalling does not delay the
// next step. If no processor is free, waking one thread takes tens of microseconds.
//
// Threads  Open() from one thread at a time.
#pragma once

#include <memory>
#include <thread>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/simulation/robots/wait_event.h"

namespace gsv::simulation {

// A thread that signals wait events, and so wakes the calls of agents.
class EventSignaler {
 public:
  using Events = std::vector<std::shared_ptr<Wakeable>>;

  EventSignaler();
  EventSignaler(const EventSignaler&) = delete;
  EventSignaler& operator=(const EventSignaler&) = delete;
  ~EventSignaler();

  // Signals the events and clears `events`. If there are few events, the caller's thread signals
  // them. If there are many, the signaler's thread signals them soon, in this order. An agent waits
  // again only after its event was signalled, so the queue contains at most one event per agent.
  void Open(Events& events);

 private:
  void Run();  // the function of thread_

  base::Mutex mutex_;
  base::ConditionVariable came_;              // notified when waiting_ gets events, or at the end
  Events waiting_ GSV_GUARDED_BY(mutex_);     // events that the thread must signal
  bool quit_ GSV_GUARDED_BY(mutex_) = false;  // set by the destructor; the thread then ends
  std::jthread thread_;                       // executes Run()
};

}  // namespace gsv::simulation
