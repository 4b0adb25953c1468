// Signals the wait events of many agents on its own thread. Waking one thread takes tens of
// microseconds if no processor is free; a thousand of them would delay the next step.
//
// Threads  Open() from one thread at a time.
#pragma once

#include <memory>
#include <thread>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/simulation/robots/wait_event.h"

namespace gsv::simulation {

class EventSignaler {
 public:
  using Events = std::vector<std::shared_ptr<WaitEvent>>;

  EventSignaler();
  EventSignaler(const EventSignaler&) = delete;
  EventSignaler& operator=(const EventSignaler&) = delete;
  ~EventSignaler();

  // Signals the events and clears `events`: a few at once, many soon and in this order. An agent
  // waits again only after its event was signalled, so that the queue holds at most one event per
  // agent.
  void Open(Events& events);

 private:
  void Run();

  base::Mutex mutex_;
  base::ConditionVariable came_;
  Events waiting_ GSV_GUARDED_BY(mutex_);
  bool quit_ GSV_GUARDED_BY(mutex_) = false;
  std::jthread thread_;
};

}  // namespace gsv::simulation
