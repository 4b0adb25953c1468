// How `gsv campaign run` has a campaign's runs done: here, by servers, by a job queue, or a share
// of them for another queue. Each gives the exit code, after having told what went wrong.
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
  int jobs = 0;          // runs at once; 0: one a processor, or as many as the servers take
  double timeout = 300;  // wall seconds a run
  double poll = 0;       // seconds between questions to the queue; 0: as the engine has it
  bool waits = true;     // for what was handed to the queue
  std::string failures;  // a folder; empty: nothing is recorded
  std::string broker;    // whose servers do the runs; empty: this machine
  std::string servers;   // a constraint that they fulfil; empty: any
};

// NAME.sqlite has its spool in NAME.runs.
std::filesystem::path SpoolOf(const std::string& results_file);

// Adds to the results what lies in the spool, if there is one. Where there are no results yet it
// makes them. Leaves alone what another driver is about to gather.
int GatherSpool(const std::string& results_file);

// Until all runs are done, a signal comes, or there is no server any more.
int RunHere(const campaign::Campaign& campaign, campaign::Results& results,
            const EngineOptions& options, Signals& signals);
int RunByQueue(const campaign::Campaign& campaign, campaign::Results& results,
               const std::string& results_file, const EngineOptions& options, Signals& signals);

// The share's runs, into the spool. What an earlier attempt at it has done is left out.
int RunShard(const campaign::Campaign& campaign, const std::string& results_file,
             const Shard& shard, const EngineOptions& options, Signals& signals);

// A task of a batch, which a job queue starts.
struct TaskArguments {
  std::string batch_file;
  std::size_t task = 0;
  std::string job = "none", node;   // for the journal; node: empty: this machine's name
  int jobs = 1;                     // runs at once
  bool until_stdin_closes = false;  // it ends then as by a signal
};
int RunTask(const TaskArguments& arguments, Signals& signals);

}  // namespace gsv::app
