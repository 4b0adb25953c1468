// The scenarios of `gsv test` and `gsv campaign`, and their results. Each scenario runs in its own
// child process.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "gsv/base/error.h"

namespace gsv::app {

// One scenario to run.
struct TestCase {
  std::string file;    // as the user gave it
  std::string name;    // the path of the file without its extension
  std::string folder;  // the folder in TestOptions::failures; no other case of the session has it
  bool is_temporary = false;  // whether the file is removed after the run
};

// Returns the scenarios of files and folders. A folder stands for all *.yaml and *.yml files in it,
// ordered by name. Adds the problems of the files to `problems`. Returns kNotFound if a name matches
// nothing.
base::Result<std::vector<TestCase>> FindTestCases(const std::vector<std::string>& names,
                                                  base::Problems& problems);

// A part of the cases. "2/3" is the second of three parts.
struct Shard {
  std::size_t index = 1, count = 1;  // `index` is from 1 to `count`
};
base::Result<Shard> ParseShard(const std::string& text);
// Returns the cases of a shard: every n-th case, so that the shards have about equal sizes.
std::vector<TestCase> ShareOf(std::vector<TestCase> cases, const Shard& shard);

// The options of `gsv test` for each scenario.
struct TestOptions {
  std::filesystem::path failures;   // folder for the files of failures; empty: none
  int threads = 0;                  // number of threads per run; 0 if `gsv run` chooses it
  double timeout = 300;             // wall-clock time limit per run, s
  double kept_seconds = 10;         // how many seconds of the recording before a violation are kept
  double kept_after = 2;            // how many seconds after a violation are kept
  std::vector<std::string> drives;  // see the option --drive of `gsv run`
  int repeat = 1;                   // number of runs of each scenario
  bool record = true;               // whether runs are recorded, to keep the recordings of failures
};

// The result of a scenario, over all its repetitions.
struct TestResult {
  enum class Status { kPassed, kFailed, kError, kInterrupted };
  TestCase test;
  Status status = Status::kError;
  std::string message;        // the reason why it did not pass
  std::string health;         // a line for each robot that stood, was stuck or dead at the end
  bool is_bad_input = false;  // whether a file that the scenario names is missing or invalid
  std::string folder;         // the folder with the files of the failure; may be empty
  double failed_at = 0;       // simulated time of the first violation, else of the end, s
  std::string about;          // the robot that the failure is about; may be empty
  std::string command;        // the command that repeats the failed run
  double wall_seconds = 0;    // wall-clock time of all repetitions
  std::vector<std::string> hashes;  // state hashes of the repetitions
  nlohmann::ordered_json report;    // the report of `gsv run` for the last repetition; may be empty
};

// Runs the case `options.repeat` times, or until a run fails. Ends the run if `is_cancelled`
// becomes true.
//
// Threads  any number at once, each for its own case. Each calling thread starts its own run
//          server, which ends with this thread.
TestResult RunTestCase(const TestCase& test, const TestOptions& options,
                       const std::atomic<bool>& is_cancelled);

}  // namespace gsv::app
