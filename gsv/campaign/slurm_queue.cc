// The engine `slurm`. It uses job arrays and Slurm's own commands sbatch, squeue and scontrol
// (slurm.schedmd.com; 20.11 or newer). Slurm's accounting (sacct) is not needed.
#include <charconv>
#include <sstream>

#include <fmt/format.h>

#include "gsv/campaign/engine.h"
#include "gsv/scenario/yaml_mapping.h"

namespace gsv::campaign {
namespace {

constexpr std::size_t kMaxTasks = 1001;  // Slurm's default for MaxArraySize

struct SlurmOptions {
  std::string partition, time_limit;  // options of sbatch; empty for the queue's defaults
  std::vector<std::string> options;   // further options for sbatch
};

// Returns the last line with a message, without the program's name. A line is, for example,
// "sbatch: error: Batch job submission failed: Invalid partition name specified".
std::string LastMessage(const std::string& output) {
  std::istringstream lines(output);
  std::string text;
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("Try ")) text += line + "\n";
  }
  std::string last = LastLine(text);
  for (const char* prefix : {"error: ", "Batch job submission failed: "}) {
    if (const std::size_t at = last.find(prefix); at != std::string::npos)
      last.erase(0, at + std::string_view(prefix).size());
  }
  return last;
}

bool IsNumber(const std::string& text) {
  return !text.empty() && text.size() <= 9 &&
         text.find_first_not_of("0123456789") == std::string::npos;
}

// Returns the job id from the last line of sbatch's output: "17" or "17;cluster".
std::string JobIn(const std::string& output) {
  std::istringstream lines(output);
  std::string job;
  for (std::string line; std::getline(lines, line);) {
    const std::string number = line.substr(0, line.find(';'));
    if (IsNumber(number)) job = number;
  }
  return job;
}

class SlurmQueue final : public JobQueue {
 public:
  SlurmQueue(SlurmOptions options, const QueueContext& context)
      : options_(std::move(options)), commands_(context.commands), program_(context.program) {}

  base::Result<std::size_t> MaxTasks() override {
    const auto text = Ask({"scontrol", "show", "config"});
    if (!text) return base::Fail(text.error());
    const std::size_t at = text->find("MaxArraySize");
    const std::size_t digits = text->find_first_of("0123456789", at);
    std::size_t most = kMaxTasks;
    if (at != std::string::npos && digits != std::string::npos)
      std::from_chars(&(*text)[digits], text->data() + text->size(), most);
    if (most < 2) {
      return base::Fail(base::ErrorCode::kNotRunning,
                        "this Slurm allows no job arrays (MaxArraySize); ask its administrator",
                        "scontrol");
    }
    return most;
  }

  base::Result<std::string> Submit(const Spool& spool, const Batch& batch) override {
    std::vector<std::string> command{"sbatch",
                                     "--parsable",
                                     "--requeue",
                                     "--job-name=" + batch.name,
                                     fmt::format("--array=0-{}", batch.tasks() - 1),
                                     "--output=" + spool.LogOf(batch, "%a").string(),
                                     "--open-mode=append"};
    if (!options_.partition.empty()) command.push_back("--partition=" + options_.partition);
    if (!options_.time_limit.empty()) command.push_back("--time=" + options_.time_limit);
    command.insert(command.end(), options_.options.begin(), options_.options.end());
    command.push_back("--wrap=" + TaskCommand{.program = program_,
                                              .batch_file = spool.FileOf(batch),
                                              .task = "\"$SLURM_ARRAY_TASK_ID\"",
                                              .job = "\"$SLURM_ARRAY_JOB_ID\"",
                                              .node = "\"$SLURMD_NODENAME\"",
                                              .jobs = "\"${SLURM_CPUS_PER_TASK:-1}\""}
                                      .Text());
    const auto output = Ask(command);
    if (!output) {
      if (output.error().code != base::ErrorCode::kNotRunning) return base::Fail(output.error());
      return base::Fail(base::ErrorCode::kNotRunning, "Slurm refuses: " + output.error().message,
                        "sbatch");
    }
    if (std::string job = JobIn(*output); !job.empty()) return job;
    return base::Fail(base::ErrorCode::kUnavailable,
                      "it printed no job number: " + LastMessage(*output), "sbatch");
  }

  base::Result<std::map<std::string, QueuedTask>> TasksOf(
      const std::vector<Batch>& batches) override {
    std::map<std::string, QueuedTask> tasks;
    if (batches.empty()) return tasks;
    std::map<std::string, const Batch*> by_name;
    std::string names;
    for (const Batch& batch : batches) {
      by_name[batch.name] = &batch;
      names += (names.empty() ? "" : ",") + batch.name;
    }
    const auto output =
        Ask({"squeue", "--noheader", "--array", "--name=" + names, "--format=%j|%K|%T|%r"});
    if (!output) return base::Fail(output.error());
    std::istringstream lines(*output);
    for (std::string line; std::getline(lines, line);) {
      std::istringstream fields(line);
      std::string name, index, state, reason;
      std::getline(fields, name, '|');
      std::getline(fields, index, '|');
      std::getline(fields, state, '|');
      std::getline(fields, reason);
      const auto found = by_name.find(name);
      if (found == by_name.end() || !IsNumber(index)) continue;
      tasks[found->second->ShareOf(std::stoul(index))] = {state, reason};
    }
    return tasks;
  }

 private:
  // Runs a command and returns its output.
  base::Result<std::string> Ask(const std::vector<std::string>& command) {
    auto outcome = commands_.Run(command);
    if (!outcome) {
      if (outcome.error().code != base::ErrorCode::kTimeout) return base::Fail(outcome.error());
      return base::Fail(
          base::ErrorCode::kTimeout,
          outcome.error().message + "; check that Slurm runs, then run the same command again",
          command.front());
    }
    if (outcome->ending == kSucceeded) return outcome->output;
    if (outcome->ending == "exit code 127") {
      return base::Fail(base::ErrorCode::kUnavailable,
                        "the commands of Slurm are not on the PATH; run this on a login node of "
                        "the cluster, or with --engine local",
                        command.front());
    }
    // If a command ended with an exit code, Slurm has refused it. If the command was killed, Slurm
    // may have executed it.
    const bool has_refused = outcome->ending.starts_with("exit code");
    return base::Fail(
        has_refused ? base::ErrorCode::kNotRunning : base::ErrorCode::kUnavailable,
        has_refused ? LastMessage(outcome->output) : "it ended with " + outcome->ending,
        command.front());
  }

  const SlurmOptions options_;
  CommandRunner& commands_;
  const std::string program_;
};

MakeQueue ReadSlurm(scenario::YamlMapping& mapping) {
  SlurmOptions options;
  options.partition = mapping.Text("partition").value_or("");
  options.time_limit = mapping.Text("time_limit").value_or("");
  options.options = mapping.Texts("options");
  return [options](const QueueContext& context) {
    return std::make_unique<SlurmQueue>(options, context);
  };
}

}  // namespace

EngineType SlurmEngine() {
  EngineType type;
  type.name = "slurm";
  type.title = "Slurm";
  type.help = "as Slurm job arrays";
  type.options = {
      {"--partition", "partition", "Slurm partition of the tasks"},
      {"--time-limit", "time_limit",
       "time limit of a task in the form of sbatch, such as 30 or 2:00:00"},
      {"--sbatch", "options", "further option for sbatch, such as --sbatch=--mem=2G", true}};
  type.after_interrupt = "the tasks in Slurm continue (scancel --name ends them)";
  type.read = &ReadSlurm;
  return type;
}

}  // namespace gsv::campaign
