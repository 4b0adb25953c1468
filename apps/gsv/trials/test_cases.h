// The scenarios that `gsv test` and `gsv campaign` run, each in a child process of its own, and
// what comes of one.
#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "gsv/base/error.h"

namespace gsv::app {

struct TestCase {
  std::string file;  // as it was named
  std::string name;  // the file's path, without its ending
};

// Those that files and folders (all *.yaml in them, by name) stand for. What is wrong with any is
// added to `problems`; kNotFound when a name stands for nothing.
base::Result<std::vector<TestCase>> FindTestCases(const std::vector<std::string>& names,
                                                  base::Problems& problems);

// "2/3": the second of three shares.
struct Shard {
  std::size_t index = 1, count = 1;
};
base::Result<Shard> ParseShard(const std::string& text);
// Every count-th, so that shares are about equally large.
std::vector<TestCase> ShareOf(std::vector<TestCase> cases, const Shard& shard);

struct TestOptions {
  std::filesystem::path failures;   // a folder for what failed; empty: nothing is kept
  int threads = 0;                  // of a run; 0: as `gsv run` chooses
  double timeout = 300;             // wall seconds a run
  double kept_seconds = 10;         // of a recording before the failure
  std::vector<std::string> drives;  // as --drive of `gsv run`
  int repeat = 1;
  bool record = true;
};

struct TestResult {
  enum class Status { kPassed, kFailed, kError, kInterrupted };
  TestCase test;
  Status status = Status::kError;
  std::string message;        // why it did not pass
  bool is_bad_input = false;  // what it names is not there, or of no use
  std::string folder;         // with what a failure left; empty: nothing
  std::string command;        // that shows it again
  double wall_seconds = 0;
  std::vector<std::string> hashes;  // by repetition
  nlohmann::ordered_json report;    // of `gsv run`, of the last repetition; empty: none came
};

// Runs it as often as it is to be repeated, until it fails. Ends the run when `is_cancelled`.
//
// Threads  any number at once, each for a case of its own; the calling thread must live until it
//          returns.
TestResult RunTestCase(const TestCase& test, const TestOptions& options,
                       const std::atomic<bool>& is_cancelled);

}  // namespace gsv::app
