// The signals that end a program (SIGINT, SIGTERM, and SIGHUP of a terminal that is closed) as
// something to ask for: no handler interrupts anything.
#pragma once

#include <csignal>

namespace gsv::app {

class Signals {
 public:
  // Blocks them for this thread and all that it starts later: call first in main(). SIGHUP stays
  // ignored where it is, as by nohup.
  Signals();
  // The signal that has come; 0: none within `milliseconds`.
  int WaitFor(int milliseconds);
  void Wait();  // for one

 private:
  sigset_t set_;
};

}  // namespace gsv::app
