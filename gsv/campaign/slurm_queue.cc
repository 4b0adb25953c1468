#include "gsv/campaign/slurm_queue.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include <fmt/format.h>

namespace gsv::campaign {
namespace {

constexpr std::size_t kMostTasks = 1001;  // Slurm's own default for MaxArraySize

std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

// The last line that says something, without the program's name: "sbatch: error: Batch job
// submission failed: Invalid partition name specified".
std::string Complaint(const std::string& output) {
  std::istringstream lines(output);
  std::string last;
  for (std::string line; std::getline(lines, line);) {
    if (line.find_first_not_of(" \t\r") != std::string::npos && !line.starts_with("Try "))
      last = line;
  }
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

// "17" or "17;cluster", after what sbatch may have remarked.
std::string JobIn(const std::string& output) {
  std::istringstream lines(output);
  std::string job;
  for (std::string line; std::getline(lines, line);) {
    const std::string number = line.substr(0, line.find(';'));
    if (IsNumber(number)) job = number;
  }
  return job;
}

}  // namespace

base::Result<std::string> SlurmQueue::Ask(const std::vector<std::string>& command) const {
  auto outcome = execute_(command);
  if (!outcome) return base::Fail(outcome.error());
  if (outcome->ending == "exit code 0") return outcome->output;
  if (outcome->ending == "exit code 127") {
    return base::Fail(base::ErrorCode::kUnavailable,
                      "Slurm's commands are not on the PATH; run this on a login node of the "
                      "cluster, or with --engine local",
                      command.front());
  }
  // Only who ended by himself has refused; of one that was killed nobody knows what he has done.
  const bool has_refused = outcome->ending.starts_with("exit code");
  return base::Fail(has_refused ? base::ErrorCode::kNotRunning : base::ErrorCode::kUnavailable,
                    has_refused ? Complaint(outcome->output) : "it ended with " + outcome->ending,
                    command.front());
}

base::Result<std::size_t> SlurmQueue::MostTasks() const {
  const auto text = Ask({"scontrol", "show", "config"});
  if (!text) return base::Fail(text.error());
  const std::size_t at = text->find("MaxArraySize");
  const std::size_t digits = text->find_first_of("0123456789", at);
  std::size_t most = kMostTasks;
  if (at != std::string::npos && digits != std::string::npos)
    std::from_chars(&(*text)[digits], text->data() + text->size(), most);
  if (most < 2) {
    return base::Fail(base::ErrorCode::kNotRunning,
                      "this Slurm takes no job arrays (MaxArraySize); ask its administrator",
                      "scontrol");
  }
  return most;
}

base::Result<std::string> SlurmQueue::Submit(const Spool& spool, const Batch& batch) const {
  std::vector<std::string> command{"sbatch",
                                   "--parsable",
                                   "--requeue",
                                   "--job-name=" + batch.name,
                                   fmt::format("--array=0-{}", batch.tasks() - 1),
                                   "--output=" + (spool.logs() / (batch.name + "-%a.log")).string(),
                                   "--open-mode=append"};
  if (!options_.partition.empty()) command.push_back("--partition=" + options_.partition);
  if (!options_.time_limit.empty()) command.push_back("--time=" + options_.time_limit);
  command.insert(command.end(), options_.options.begin(), options_.options.end());
  command.push_back("--wrap=exec " + Quoted(program_) + " campaign task " +
                    Quoted(spool.FileOf(batch)));
  const auto output = Ask(command);
  if (!output) {
    if (output.error().code != base::ErrorCode::kNotRunning) return base::Fail(output.error());
    return base::Fail(base::ErrorCode::kNotRunning, "Slurm refuses: " + output.error().message,
                      "sbatch");
  }
  if (std::string job = JobIn(*output); !job.empty()) return job;
  return base::Fail(base::ErrorCode::kUnavailable, "it named no job: " + Complaint(*output),
                    "sbatch");
}

base::Result<std::map<std::string, QueuedTask>> SlurmQueue::TasksOf(
    const std::vector<Batch>& batches) const {
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

}  // namespace gsv::campaign
