// A child process that ends with this process.
//
// Threads  one at a time. The thread that starts the child must live as long as the child, because
//          the kernel ends the child when that thread ends.
#pragma once

#include <sys/types.h>

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::app {

class ChildProcess {
 public:
  // The child's stdin is empty, or stays open until this object is destroyed.
  enum class Input { kEmpty, kOpen };

  // Starts a program. `arguments[0]` is its path. The child's stdout can be read here. The child
  // writes to this process's stderr. If `quiet` is true, the child's stderr is discarded.
  static base::Result<std::unique_ptr<ChildProcess>> Start(std::vector<std::string> arguments,
                                                           bool quiet, Input input = Input::kEmpty);
  // Starts a program as Start() does, but its stderr can be read here too. `environment` has
  // further variables, as NAME=VALUE.
  static base::Result<std::unique_ptr<ChildProcess>> StartCaptured(
      std::vector<std::string> arguments, std::vector<std::string> environment);
  // Sends SIGTERM, and SIGKILL if the child still runs two seconds later.
  ~ChildProcess();
  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  pid_t pid() const { return pid_; }
  // Descriptors for OutputReader, valid during the lifetime of this object. errors() is -1 unless
  // stderr is captured.
  int output() const { return output_; }
  int errors() const { return errors_; }
  int pid_descriptor() const { return pid_descriptor_; }
  // Returns and clears the output that was read from the child, but not yet returned by ReadLine().
  std::string TakeBuffer() { return std::exchange(buffer_, {}); }
  // Writes to the child's stdin, which must be kOpen. Returns kUnavailable if the child has ended
  // or closed its stdin.
  base::Status Write(std::string_view text);
  // Returns the next line of the child's stdout, without the newline. Returns nullopt at the end of
  // stdout, after the time limit, or if a line is longer than about 64 KiB. Never returns a last line
  // that does not end with a newline: this line stays in the buffer (TakeBuffer()).
  std::optional<std::string> ReadLine(std::chrono::milliseconds timeout);
  // Returns how the child ended, such as "exit code 5" or "signal 11". Empty while it runs.
  std::string Ending();
  // Waits for the child's end or the time limit, and returns Ending().
  std::string AwaitEnd(std::chrono::milliseconds timeout);
  // Sends a signal to the child.
  void Signal(int signal);

 private:
  // How the child's streams are connected.
  struct Streams {
    bool quiet = false;  // whether stderr is discarded
    Input input = Input::kEmpty;
    bool captures_errors = false;          // whether stderr can be read here
    std::vector<std::string> environment;  // further variables, as NAME=VALUE
  };
  // Starts a program. `arguments[0]` is its path.
  static base::Result<std::unique_ptr<ChildProcess>> Start(std::vector<std::string> arguments,
                                                           Streams streams);
  ChildProcess(pid_t pid, int input, int output, int errors);

  const pid_t pid_;
  const int input_;  // -1 if there is none
  const int output_;
  const int errors_;           // -1 if there is none
  int pid_descriptor_ = -1;    // becomes readable when the child ends
  std::string buffer_;         // output that ReadLine() has read, but not yet returned
  std::optional<int> status_;  // the status from waitpid()
};

}  // namespace gsv::app
