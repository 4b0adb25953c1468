// What people may tell a simulation, by name: the same over HTTP and as services.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "gsv/simulation/simulation.h"

namespace gsv::gateway {

inline constexpr std::int64_t kMostSteps = 1'000'000'000;  // that one command may ask for

struct SimulationCommand {
  std::string_view name;
  std::string_view summary;  // as in docs/api.yaml
  bool takes_count = false;  // of steps; else `count` is of no account
  base::Status (*run)(simulation::Simulation& simulation, std::int64_t count) = nullptr;
};

// start, pause, resume, stop, reset, step. May block: a reset calls behaviours.
std::span<const SimulationCommand> SimulationCommands();

// As a service answers: with nothing, where all is well.
inline base::Result<std::string> WithoutWords(const base::Status& done) {
  if (!done) return base::Fail(done.error());
  return std::string();
}

// Null if there is none of that name.
const SimulationCommand* FindSimulationCommand(std::string_view name);

}  // namespace gsv::gateway
