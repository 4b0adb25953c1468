// The interface through which a job queue starts programs. `gsv campaign` implements it with
// processes; tests use a fake.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::campaign {

// The CommandOutcome::ending of a command that succeeded.
inline constexpr std::string_view kSucceeded = "exit code 0";

// The result of a command that has ended.
struct CommandOutcome {
  std::string ending;  // how the command ended, such as "exit code 0" or "signal 9"
  std::string output;  // stdout and stderr of the command together
};

// A program that runs in the background. Its stdin stays open until this object is destroyed. The
// destructor ends the program.
class StartedProgram {
 public:
  virtual ~StartedProgram() = default;
  virtual std::string Output() = 0;  // Returns the stdout and stderr so far.
  // Returns how the program ended, as in CommandOutcome. Empty while it runs.
  virtual std::string Ending() = 0;
};

// Runs commands for a job queue. One thread at a time may use it.
class CommandRunner {
 public:
  virtual ~CommandRunner() = default;
  // Runs a command and waits for its end. `command[0]` is searched on the PATH. A command that is
  // not found ends with exit code 127. Returns kTimeout if the command does not end in time.
  virtual base::Result<CommandOutcome> Run(const std::vector<std::string>& command) = 0;
  // Starts a command and returns.
  virtual base::Result<std::unique_ptr<StartedProgram>> Start(
      const std::vector<std::string>& command) = 0;
};

// Returns the text quoted as one word for a shell's command line.
std::string Quoted(const std::string& text);
// Returns the last line that is not blank, which usually contains the reason of a failure.
std::string LastLine(const std::string& output);

}  // namespace gsv::campaign
