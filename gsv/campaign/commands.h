// The interface by which a job queue starts programs. `gsv campaign` implements it with processes,
// tests with a fake.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::campaign {

inline constexpr std::string_view kSucceeded = "exit code 0";

struct CommandOutcome {
  std::string ending;  // "exit code 0", "signal 9"
  std::string output;  // stdout and stderr
};

// A program that runs in the background. Its stdin stays open until this object is destroyed, which
// ends the program.
class StartedProgram {
 public:
  virtual ~StartedProgram() = default;
  virtual std::string Output() = 0;  // stdout and stderr so far
  virtual std::string Ending() = 0;  // as in CommandOutcome; empty while the program runs
};

// Threads  one at a time.
class CommandRunner {
 public:
  virtual ~CommandRunner() = default;
  // Runs a command and waits for its end. `command[0]` is searched on the PATH; a command that is
  // not found ends with exit code 127. kTimeout when the command does not end in time.
  virtual base::Result<CommandOutcome> Run(const std::vector<std::string>& command) = 0;
  // Starts a command and returns.
  virtual base::Result<std::unique_ptr<StartedProgram>> Start(
      const std::vector<std::string>& command) = 0;
};

// Quotes the text as one word of a shell's command line.
std::string Quoted(const std::string& text);
// The last line that is not blank. It usually gives the reason of a failure.
std::string LastLine(const std::string& output);

}  // namespace gsv::campaign
