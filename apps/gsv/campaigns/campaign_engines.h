// Executes the runs of a campaign for `gsv campaign run`. This machine, servers or a job queue
// execute them. With --shard, this machine executes only one share of them. Each function prints
// errors and returns the exit code.
#pragma once

#include <filesystem>
#include <string>

#include "apps/gsv/process/signals.h"
#include "apps/gsv/trials/test_cases.h"
#include "gsv/campaign/engine.h"
#include "gsv/campaign/results.h"

namespace gsv::app {

// The options of `gsv campaign run`.
struct EngineOptions {
  campaign::Engine engine;  // this machine, or the kind of job queue
  // number of concurrent runs; 0: one per processor or, with servers, as many as the servers accept,
  // up to 64
  int jobs = 0;
  double timeout = 300;  // wall-clock time limit of a run, s
  double poll = 0;       // time between queries of the queue, s; 0 for the engine's default
  bool waits = true;     // whether to wait for the submitted runs
  std::string failures;  // folder for recordings of failed runs; empty: none
  std::string broker;    // the broker of the servers for the runs; empty for this machine
  std::string servers;   // a constraint on the servers; empty for any server
};

// Returns the spool of a results file: the folder in which tasks store the results of their runs.
// The spool of NAME.sqlite is NAME.runs.
std::filesystem::path SpoolOf(const std::string& results_file);

// Adds the results in the spool to the results file, which is created if necessary. Does nothing if
// there is no spool, or if another process is collecting the results.
int GatherSpool(const std::string& results_file);

// Executes the runs on this machine or on servers. Returns when all runs are done, after a signal,
// or when no server is left.
int RunHere(const campaign::Campaign& campaign, campaign::Results& results,
            const EngineOptions& options, Signals& signals);
// Submits the runs to a job queue, and waits for their results if `options` say so.
int RunByQueue(const campaign::Campaign& campaign, campaign::Results& results,
               const std::string& results_file, const EngineOptions& options, Signals& signals);

// Executes the runs of a shard (a share of the campaign's runs) and stores their results in the
// spool. Skips the runs that an earlier attempt has finished.
int RunShard(const campaign::Campaign& campaign, const std::string& results_file,
             const Shard& shard, const EngineOptions& options, Signals& signals);

// A task of a batch. A job queue starts it.
struct TaskArguments {
  std::string batch_file;  // the file that lists the runs of all tasks
  std::size_t task = 0;    // number of this task in the batch
  std::string job = "none",
              node;  // stored in the journal; an empty `node` means this machine's name
  int jobs = 1;      // number of concurrent runs
  // whether the task ends when its stdin is closed, in the same way as after a signal
  bool until_stdin_closes = false;
};
int RunTask(const TaskArguments& arguments, Signals& signals);

}  // namespace gsv::app
