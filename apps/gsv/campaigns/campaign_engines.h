// Executes the runs of a campaign for `gsv campaign run`: here, on servers, by a job queue, or a
// share of them for another queue. Each function prints errors and returns the exit code.
#pragma once

#include <filesystem>
#include <string>

#include "apps/gsv/process/signals.h"
#include "apps/gsv/trials/test_cases.h"
#include "gsv/campaign/engine.h"
#include "gsv/campaign/results.h"

namespace gsv::app {

struct EngineOptions {
  campaign::Engine engine;
  int jobs = 0;          // concurrent; 0: one per processor, or as the servers allow
  double timeout = 300;  // of a run, s of wall-clock time
  double poll = 0;       // s between queries of the queue; 0: the engine's default
  bool waits = true;     // waits for the submitted runs
  std::string failures;  // a folder; empty: failed runs are not recorded
  std::string broker;    // the broker of the servers for the runs; empty: this machine
  std::string servers;   // a constraint on the servers; empty: any
};

// The spool of NAME.sqlite is NAME.runs.
std::filesystem::path SpoolOf(const std::string& results_file);

// Adds the results in the spool, if there is one; creates the results file if necessary. Leaves
// those that another driver is about to collect.
int GatherSpool(const std::string& results_file);

// Returns when all runs are done, after a signal, or when no server is left.
int RunHere(const campaign::Campaign& campaign, campaign::Results& results,
            const EngineOptions& options, Signals& signals);
int RunByQueue(const campaign::Campaign& campaign, campaign::Results& results,
               const std::string& results_file, const EngineOptions& options, Signals& signals);

// Executes the share's runs into the spool, except those that an earlier attempt has done.
int RunShard(const campaign::Campaign& campaign, const std::string& results_file,
             const Shard& shard, const EngineOptions& options, Signals& signals);

// A task of a batch, which a job queue starts.
struct TaskArguments {
  std::string batch_file;
  std::size_t task = 0;
  std::string job = "none", node;   // for the journal; node: empty: this machine's name
  int jobs = 1;                     // concurrent runs
  bool until_stdin_closes = false;  // then it ends as after a signal
};
int RunTask(const TaskArguments& arguments, Signals& signals);

}  // namespace gsv::app
