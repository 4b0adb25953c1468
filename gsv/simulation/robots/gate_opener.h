// Opens the gates of a crowd beside the stepping thread. To wake somebody costs tens of
// microseconds when a processor is not free; a thousand of them would make the next step late.
//
// Threads  Open() from one thread at a time.
#pragma once

#include <memory>
#include <thread>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/simulation/robots/wait_gate.h"

namespace gsv::simulation {

class GateOpener {
 public:
  using Gates = std::vector<std::shared_ptr<WaitGate>>;

  GateOpener();
  GateOpener(const GateOpener&) = delete;
  GateOpener& operator=(const GateOpener&) = delete;
  ~GateOpener();

  // Opens them, a few at once, many soon and in this order; leaves `gates` empty. An agent waits
  // again only after its gate has been opened, so no more come together than there are agents.
  void Open(Gates& gates);

 private:
  void Run();

  base::Mutex mutex_;
  base::ConditionVariable came_;
  Gates waiting_ GSV_GUARDED_BY(mutex_);
  bool quit_ GSV_GUARDED_BY(mutex_) = false;
  std::jthread thread_;
};

}  // namespace gsv::simulation
