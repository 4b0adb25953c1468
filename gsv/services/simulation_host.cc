#include "gsv/services/simulation_host.h"

#include <algorithm>

namespace gsv::services {

using simulation::Simulation;

base::Result<std::string> SimulationHost::FreeName(std::string wanted) const {
  const auto is_taken = [this](const std::string& name) GSV_REQUIRES(mutex_) {
    return std::any_of(simulations_.begin(), simulations_.end(),
                       [&](const auto& s) { return s->specification().name == name; });
  };
  if (simulations_.size() >= max_simulations_) {
    return base::Fail(base::ErrorCode::kUnavailable, "this server already runs " +
                                                         std::to_string(max_simulations_) +
                                                         " simulations; destroy one first, or "
                                                         "raise --limit simulations");
  }
  if (!wanted.empty()) {
    if (wanted.size() > 128 || wanted.find('/') != std::string::npos) {
      return base::Fail(base::ErrorCode::kInvalidArgument,
                        "a simulation's name has 1 to 128 characters and no \"/\"", wanted);
    }
    if (is_taken(wanted)) {
      return base::Fail(base::ErrorCode::kInvalidArgument,
                        "there is already a simulation of this name", wanted);
    }
    return wanted;
  }
  for (int number = 1;; ++number) {
    std::string name = "simulation_" + std::to_string(number);
    if (!is_taken(name)) return name;
  }
}

base::Result<std::shared_ptr<Simulation>> SimulationHost::Create(
    simulation::Specification specification, const std::string& world, base::Problems& problems) {
  if (specification.world == nullptr) {
    auto read = library_->ReadWorld(world, problems);
    if (!read) return base::Fail(read.error());
    specification.world = std::make_shared<const model::WorldDescription>(*std::move(read));
  }
  const base::MutexLock lock(mutex_);
  auto name = FreeName(specification.name);
  if (!name) return base::Fail(name.error());
  specification.name = *std::move(name);
  auto created = Simulation::Create(std::move(specification), sensors_);
  if (created) simulations_.push_back(*created);
  return created;
}

base::Status SimulationHost::Remove(const std::string& name) {
  // destroyed after the lock is released, because destroying a simulation may take a long time
  std::shared_ptr<Simulation> removed;
  const base::MutexLock lock(mutex_);
  const auto it = std::find_if(simulations_.begin(), simulations_.end(),
                               [&](const auto& s) { return s->specification().name == name; });
  if (it == simulations_.end()) {
    return base::Fail(base::ErrorCode::kNotFound, "there is no simulation of this name", name);
  }
  removed = std::move(*it);
  simulations_.erase(it);
  return {};
}

std::shared_ptr<Simulation> SimulationHost::Find(const std::string& name) const {
  const base::MutexLock lock(mutex_);
  for (const auto& simulation : simulations_) {
    if (simulation->specification().name == name) return simulation;
  }
  return nullptr;
}

std::vector<std::shared_ptr<Simulation>> SimulationHost::List() const {
  const base::MutexLock lock(mutex_);
  return simulations_;
}

}  // namespace gsv::services
