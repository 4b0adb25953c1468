// Runs a job queue's commands as child processes.
#pragma once

#include "gsv/campaign/commands.h"

namespace gsv::app {

// Starts the commands of a job queue, such as sbatch or ssh, as child processes. Use it on one
// thread, which must live as long as the programs that it starts.
class ChildCommands final : public campaign::CommandRunner {
 public:
  base::Result<campaign::CommandOutcome> Run(const std::vector<std::string>& command) override;
  base::Result<std::unique_ptr<campaign::StartedProgram>> Start(
      const std::vector<std::string>& command) override;
};

}  // namespace gsv::app
