// Waits for the signals that end a program (SIGINT, SIGTERM, and SIGHUP of a closed terminal),
// without signal handlers.
#pragma once

#include <csignal>

namespace gsv::app {

class Signals {
 public:
  // Blocks these signals for this thread and all threads that it starts later. Call it first in
  // main(). If SIGHUP is already ignored, for example by nohup, it stays ignored.
  Signals();
  // Returns the received signal, or 0 if there was none within `milliseconds`.
  int WaitFor(int milliseconds);
  void Wait();  // Waits for one signal.

 private:
  sigset_t set_;  // the signals that end the program
};

}  // namespace gsv::app
