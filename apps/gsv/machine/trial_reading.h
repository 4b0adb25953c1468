// Reads an untrusted world first as a trial, in a child process with a sandbox. If the child
// crashes, hangs or exceeds its limits, this process gets an error and is not harmed.
//
// This process uses only the exit status of the child. If the status is 0, this process reads the
// file itself. docs/security.md describes what this protects against, and what it does not.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/gsv/machine/sandbox.h"

namespace gsv::app {

// The limits of a trial.
struct TrialLimits {
  Sandbox sandbox;
  std::chrono::seconds wall_time{120};  // maximum wall-clock time
};

// Returns the reason why a trial failed. `ending` is the ChildProcess::Ending() of the child, or
// empty if the child still ran at the limit of wall-clock time.
std::string WhyTrialFailed(const std::string& ending, const TrialLimits& limits);

// Returns kBadModel if the trial did not end regularly. `model_path` has folders to search for
// models.
// Threads  any; takes as long as reading the world.
base::Status TryToRead(const std::string& world,
                       const std::vector<std::filesystem::path>& model_path,
                       const TrialLimits& limits);

}  // namespace gsv::app
