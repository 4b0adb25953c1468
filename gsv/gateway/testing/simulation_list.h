// For tests: a directory of simulations.
#pragma once

#include <algorithm>
#include <mutex>

#include "gsv/gateway/program/ports.h"

namespace gsv::gateway::testing {

class SimulationList final : public SimulationDirectory {
 public:
  void Add(std::shared_ptr<simulation::Simulation> simulation) {
    const std::lock_guard lock(mutex_);
    simulations_.push_back(std::move(simulation));
  }

  void Remove(const std::string& name) {
    const std::lock_guard lock(mutex_);
    std::erase_if(simulations_, [&](const auto& s) { return s->specification().name == name; });
  }

  std::vector<std::shared_ptr<simulation::Simulation>> List() override {
    const std::lock_guard lock(mutex_);
    return simulations_;
  }

  std::shared_ptr<simulation::Simulation> Find(const std::string& name) override {
    const std::lock_guard lock(mutex_);
    for (const auto& simulation : simulations_) {
      if (simulation->specification().name == name) return simulation;
    }
    return nullptr;
  }

 private:
  std::mutex mutex_;
  std::vector<std::shared_ptr<simulation::Simulation>> simulations_;
};

}  // namespace gsv::gateway::testing
