// Slurm, by its own commands: sbatch, squeue, scontrol (slurm.schedmd.com; 20.11 or newer).
// Accounting (sacct) is not needed.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "gsv/campaign/spool.h"

namespace gsv::campaign {

struct CommandOutcome {
  std::string ending;  // "exit code 0"
  std::string output;  // stdout and stderr
};

// Runs a command and waits for it, but not for ever. Fails when it did not end in time.
using Execute =
    std::function<base::Result<CommandOutcome>(const std::vector<std::string>& command)>;

struct QueuedTask {
  std::string state;   // of squeue: "PENDING", "RUNNING", …
  std::string reason;  // why it waits: "Resources", …
};

class SlurmQueue {
 public:
  // `program`: gsv, as the nodes find it.
  SlurmQueue(Execute execute, SlurmOptions options, std::string program)
      : execute_(std::move(execute)), options_(std::move(options)), program_(std::move(program)) {}

  // How many tasks a job array may have.
  base::Result<std::size_t> MostTasks() const;
  // Gives the job's number. kNotRunning when Slurm refuses: then nothing was queued.
  base::Result<std::string> Submit(const Spool& spool, const Batch& batch) const;
  // The tasks of these batches that wait or run, by ShareOf().
  base::Result<std::map<std::string, QueuedTask>> TasksOf(const std::vector<Batch>& batches) const;

 private:
  base::Result<std::string> Ask(const std::vector<std::string>& command) const;

  Execute execute_;
  SlurmOptions options_;
  std::string program_;
};

}  // namespace gsv::campaign
