// The scenarios of `gsv test` and `gsv campaign`, each run in its own child process, and the
// results.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "gsv/base/error.h"

namespace gsv::app {

struct TestCase {
  std::string file;  // as given
  std::string name;  // the file's path, without its extension
};

// The scenarios of files and folders (all *.yaml in a folder, by name). Adds their problems to
// `problems`; kNotFound if a name matches nothing.
base::Result<std::vector<TestCase>> FindTestCases(const std::vector<std::string>& names,
                                                  base::Problems& problems);

// "2/3": the second of three shares.
struct Shard {
  std::size_t index = 1, count = 1;
};
base::Result<Shard> ParseShard(const std::string& text);
// Every count-th case, so that shares have about equal sizes.
std::vector<TestCase> ShareOf(std::vector<TestCase> cases, const Shard& shard);

struct TestOptions {
  std::filesystem::path failures;   // folder for files of failures; empty: nothing is kept
  int threads = 0;                  // per run; 0: as `gsv run` chooses
  double timeout = 300;             // s of wall-clock time per run
  double kept_seconds = 10;         // s of a recording before the failure
  std::vector<std::string> drives;  // see --drive of `gsv run`
  int repeat = 1;
  bool record = true;
};

struct TestResult {
  enum class Status { kPassed, kFailed, kError, kInterrupted };
  TestCase test;
  Status status = Status::kError;
  std::string message;        // why it did not pass
  bool is_bad_input = false;  // a file that it names is missing or invalid
  std::string folder;         // with the files of a failure; empty: none
  std::string command;        // that repeats it
  double wall_seconds = 0;
  std::vector<std::string> hashes;  // by repetition
  nlohmann::ordered_json report;    // of `gsv run`, for the last repetition; empty: none
};

// Runs it for each repetition, until it fails. Ends the run if `is_cancelled`.
//
// Threads  any number at once, each for its own case; the calling thread must live until it
//          returns.
TestResult RunTestCase(const TestCase& test, const TestOptions& options,
                       const std::atomic<bool>& is_cancelled);

}  // namespace gsv::app
