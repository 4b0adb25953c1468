// Reads an untrusted world in a sandboxed process first. If that crashes, hangs or exceeds its
// limits, this process is not harmed and gets an error.
//
// Only the regular end of the trial is used: the file is then read again here. docs/security.md
// describes what this protects against, and what not.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/gsv/machine/sandbox.h"

namespace gsv::app {

struct TrialLimits {
  Sandbox sandbox;
  std::chrono::seconds wall_time{120};
};

// kBadModel: the trial did not end regularly. `model_path`: folders to search for models.
// Threads  any; takes as long as reading.
base::Status TryToRead(const std::string& world,
                       const std::vector<std::filesystem::path>& model_path,
                       const TrialLimits& limits);

}  // namespace gsv::app
