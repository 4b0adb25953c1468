#include "apps/gsv/campaigns/campaign_commands.h"

#include <chrono>

#include <fmt/format.h>

#include "apps/gsv/machine/child_process.h"

namespace gsv::app {
namespace {

using std::chrono::milliseconds;

constexpr std::chrono::seconds kCommandTimeout{60};
constexpr std::size_t kMaxOutput = 1 << 20;  // maximum size of a program's stored output, bytes
constexpr int kMaxLines = 1000;              // maximum number of lines that one call reads

// Starts a command through the shell, which finds the program on the PATH and merges stderr into
// stdout.
base::Result<std::unique_ptr<ChildProcess>> StartMerged(const std::vector<std::string>& command,
                                                        ChildProcess::Input input) {
  std::vector<std::string> line{"/bin/sh", "-c", "exec \"$@\" 2>&1", "sh"};
  line.insert(line.end(), command.begin(), command.end());
  return ChildProcess::Start(std::move(line), false, input);
}

class StartedChild final : public campaign::StartedProgram {
 public:
  explicit StartedChild(std::unique_ptr<ChildProcess> child) : child_(std::move(child)) {}

  std::string Output() override {
    for (int lines = 0; lines < kMaxLines; ++lines) {
      const auto line = child_->ReadLine(milliseconds(2));
      if (!line) break;
      if (output_.size() < kMaxOutput) output_ += *line + "\n";
    }
    return output_;
  }
  std::string Ending() override { return child_->Ending(); }

 private:
  const std::unique_ptr<ChildProcess> child_;
  std::string output_;
};

}  // namespace

base::Result<campaign::CommandOutcome> ChildCommands::Run(const std::vector<std::string>& command) {
  auto child = StartMerged(command, ChildProcess::Input::kEmpty);
  if (!child) return base::Fail(child.error());
  const auto give_up = std::chrono::steady_clock::now() + kCommandTimeout;
  const auto left = [&] {
    return std::max(milliseconds(0), std::chrono::duration_cast<milliseconds>(
                                         give_up - std::chrono::steady_clock::now()));
  };
  campaign::CommandOutcome outcome;
  while (const auto text = (*child)->ReadLine(left())) outcome.output += *text + "\n";
  outcome.ending = (*child)->AwaitEnd(left());
  if (!outcome.ending.empty()) return outcome;
  return base::Fail(base::ErrorCode::kTimeout,
                    fmt::format("did not respond within {} s", kCommandTimeout.count()),
                    command.front());
}

base::Result<std::unique_ptr<campaign::StartedProgram>> ChildCommands::Start(
    const std::vector<std::string>& command) {
  auto child = StartMerged(command, ChildProcess::Input::kOpen);
  if (!child) return base::Fail(child.error());
  return std::make_unique<StartedChild>(*std::move(child));
}

}  // namespace gsv::app
