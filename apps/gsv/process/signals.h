// Waits for the signals that end a program (SIGINT, SIGTERM, and SIGHUP of a closed terminal),
// without signal handlers.
#pragma once

#include <csignal>

namespace gsv::app {

class Signals {
 public:
  // Blocks them for this thread and all threads that it starts later: call it first in main().
  // SIGHUP stays ignored if it is ignored, as by nohup.
  Signals();
  // The received signal; 0: none within `milliseconds`.
  int WaitFor(int milliseconds);
  void Wait();  // for one signal

 private:
  sigset_t set_;
};

}  // namespace gsv::app
