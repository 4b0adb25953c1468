// Opens the gates of a crowd beside the stepping thread. To wake somebody costs tens of
// microseconds when a processor is not free; a thousand of them would make the next step late.
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

  // Opens them, a few at once, many soon and in this order; leaves `gates` empty. An agent waits
  // again only after its gate has been opened, so no more come together than there are agents.
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
