// A program that this one starts, and that ends with it.
//
// Threads  one at a time. The thread that starts it must live as long as this process: the kernel
//          ends the child when that thread ends.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::app {

class ChildProcess {
 public:
  // The child's stdin: empty, or open until this object is destroyed.
  enum class Input { kEmpty, kOpen };

  // `arguments[0]` is the program's path. Its stdout can be read here. It has this process's
  // stderr, or none if `quiet`.
  static base::Result<std::unique_ptr<ChildProcess>> Start(std::vector<std::string> arguments,
                                                           bool quiet, Input input = Input::kEmpty);
  // Sends SIGTERM, and SIGKILL if the child still runs two seconds later.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t pid() const { return pid_; }
  // Writes to its stdin, which must be kOpen. kUnavailable: it has ended, or closed its stdin.
  base::Status Write(std::string_view text);
  // Its next line on stdout, without the newline. Nothing after its end or the time limit.
  std::optional<std::string> ReadLine(std::chrono::milliseconds timeout);
  // The way in which it ended ("exit code 5", "signal 11"); empty while it runs.
  std::string Ending();
  // Waits for its end or the time limit, and returns the same.
  std::string AwaitEnd(std::chrono::milliseconds timeout);
  void Signal(int signal);

 private:
  ChildProcess(pid_t pid, int input, int output);

  const pid_t pid_;
  const int input_;  // -1: none
  const int output_;
  int pid_descriptor_ = -1;  // becomes readable when it ends
  std::string buffer_;
  std::optional<int> status_;  // of waitpid()
};

}  // namespace gsv::app
