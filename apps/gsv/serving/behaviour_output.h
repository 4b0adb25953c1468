// Handles the output of the behaviour programs that this process starts. Prints each line on
// stderr, and emits it as an event (IsOutput()) in the simulations whose robots the program serves.
//
// A line belongs to the robot that the program serves, or, if it serves several robots, to its
// behaviour. Lines are stored until a robot has the behaviour.
//
// Bounded  events: 200 lines per second and program, of 2000 bytes each. Further lines are printed
//          on stderr, but as events they are only counted.
// Threads  created, used and destroyed on the main thread.
#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "apps/gsv/machine/output_reader.h"
#include "gsv/simulation/simulation.h"

namespace gsv::app {

class ChildProcess;

// Returns the last error in a program's stderr. For a Python exception, this includes file and
// line, as in "ValueError: too far in wander.py line 12". Otherwise it is the last line, or an
// empty text.
std::string LastError(const std::vector<std::string>& lines);

class BehaviourOutput {
 public:
  using ListSimulations = std::function<std::vector<std::shared_ptr<simulation::Simulation>>()>;

  // `list` returns the simulations of this process. It is called from any thread.
  explicit BehaviourOutput(ListSimulations list);
  ~BehaviourOutput();

  // Begins to handle the program's stderr.
  void Begin(const ChildProcess& program, const std::string& behaviour);
  // Begins to handle the program's stdout too. Called after the program has reported on stdout that
  // it is ready.
  void BeginOutput(ChildProcess& program);
  // Returns the last error of a program that has ended; see LastError(). Waits for its last lines,
  // for at most a second.
  std::string LastErrorOf(const ChildProcess& program);
  // Waits until all output of the programs so far was emitted.
  void WaitForOutput() { reader_->WaitForOutput(); }
  // After this call, the ends of programs are expected and not reported.
  void ExpectEnds();

 private:
  // A line that is to be emitted as an event.
  struct Line {
    std::string_view kind;  // kind of the event, such as simulation::kStdoutEvent
    std::string text;
  };
  // A program whose output is handled.
  struct Program {
    std::string behaviour;
    std::vector<Line> waiting;                       // lines that wait for a robot
    std::vector<std::string> errors{};               // the last lines of stderr
    std::chrono::steady_clock::time_point second{};  // the start of the current second
    int lines = 0;                                   // number of lines in that second
    int left_out = 0;  // number of lines above the limit in that second
    bool has_ended = false;
  };

  // Handles a line that a program has written.
  void OnLine(pid_t pid, OutputReader::Stream stream, const std::string& line);
  // Handles the end of a program. `ending` says how it has ended.
  void OnEnd(pid_t pid, const std::string& ending);
  // Emits a line as an event, or stores it until a robot has the behaviour.
  void Emit(pid_t pid, Program& program, std::string_view kind, std::string text)
      GSV_REQUIRES(mutex_);
  // Emits the waiting lines if a robot has the behaviour.
  void Flush(pid_t pid, Program& program) GSV_REQUIRES(mutex_);
  void FlushAll();  // calls Flush() for each program

  const ListSimulations list_;  // returns the simulations of this process
  base::Mutex mutex_;
  base::ConditionVariable ended_;  // notified when a program has ended
  std::map<pid_t, Program> programs_ GSV_GUARDED_BY(mutex_);
  // Whether ExpectEnds() was called.
  bool expects_ends_ GSV_GUARDED_BY(mutex_) = false;
  std::unique_ptr<OutputReader> reader_;
};

}  // namespace gsv::app
