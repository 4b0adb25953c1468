#include "gsv/ros2/services/simulation_services.h"

#include "gsv/ros2/services/entity_services.h"
#include "gsv/ros2/services/parameter_services.h"
#include "gsv/ros2/services/run_services.h"
#include "gsv/ros2/services/spawn_services.h"
#include "gsv/ros2/services/step_action.h"
#include "gsv/ros2/services/world_services.h"

namespace gsv::ros2 {
namespace {

constexpr const char* kServiceNode = "/gsv";

}  // namespace

void ServedSimulation::Serve(const std::shared_ptr<simulation::Simulation>& simulation,
                             SetNamespace set_namespace) {
  const base::MutexLock lock(mutex_);
  simulation_ = simulation;
  set_namespace_ = std::move(set_namespace);
  ++count_;
}

std::shared_ptr<simulation::Simulation> ServedSimulation::simulation() const {
  const base::MutexLock lock(mutex_);
  return simulation_.lock();
}

messages::simulation_interfaces::Result ServedSimulation::NoSimulation() const {
  return Failed(
      messages::simulation_interfaces::Result::kResultIncorrectState,
      loads_worlds() ? "no world is loaded. Call load_world" : "the simulation has ended");
}

base::Status ServedSimulation::SetNamespaceOf(const std::string& robot,
                                              const std::string& name_space) const {
  const base::MutexLock lock(mutex_);
  if (set_namespace_) return set_namespace_(robot, name_space);
  return base::Fail(base::ErrorCode::kEnded, "the simulation has ended");
}

std::set<std::string>& ServedSimulation::spawned() {
  const base::MutexLock lock(mutex_);
  if (std::exchange(spawned_in_, count_) != count_) spawned_.clear();
  return spawned_;
}

SimulationServices::SimulationServices(dds::Participant& participant, bool has_hashes,
                                       Spawner* spawner)
    : host_(std::make_unique<ServiceHost>(participant, has_hashes)),
      served_(std::make_unique<ServedSimulation>(*host_, kServiceNode, spawner)) {}

void SimulationServices::Serve(const std::shared_ptr<simulation::Simulation>& simulation,
                               ServedSimulation::SetNamespace set_namespace) {
  served_->Serve(simulation, std::move(set_namespace));
  if (steps_ == nullptr && host_ != nullptr) Offer();
}

void SimulationServices::Offer() {
  OfferParameterServices(*host_, kServiceNode);
  OfferEntityServices(*served_);
  OfferSpawnServices(*served_);
  OfferWorldServices(*served_);
  OfferRunServices(*served_);
  steps_ = std::make_unique<StepAction>(*served_);
  readers_ = host_->readers();
  writers_ = host_->writers();
}

SimulationServices::~SimulationServices() { Close(); }

void SimulationServices::Close() { host_.reset(); }

}  // namespace gsv::ros2
