// Reads a stranger's world in a process of its own first: what crashes there, hangs, or takes too
// much does no harm here, and is told in a sentence.
//
// The trial's outcome is not used, only that it came to an end: what is then read here is what was
// read there. See docs/security.md for what this stops, and what it does not.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>
#include <vector>

#include "apps/gsv/machine/confinement.h"

namespace gsv::app {

struct TrialLimits {
  Confinement confinement;
  std::chrono::seconds wall_time{120};
};

// kBadModel: it did not come to an end. `model_path`: where models are looked for.
// Threads  any; takes as long as reading does.
base::Status TryToRead(const std::string& world,
                       const std::vector<std::filesystem::path>& model_path,
                       const TrialLimits& limits);

}  // namespace gsv::app
