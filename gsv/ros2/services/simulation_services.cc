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

SimulationServices::SimulationServices(dds::Participant& participant, bool has_hashes,
                                       const std::shared_ptr<simulation::Simulation>& simulation,
                                       Spawner* spawner,
                                       ServedSimulation::SetNamespace set_namespace)
    : host_(std::make_unique<ServiceHost>(participant, has_hashes)),
      served_(std::make_unique<ServedSimulation>(*host_, kServiceNode, simulation, spawner,
                                                 std::move(set_namespace))) {
  OfferParameterServices(*host_, kServiceNode);
  OfferEntityServices(*served_);
  OfferSpawnServices(*served_);
  OfferWorldServices(*served_);
  OfferRunServices(*served_);
  steps_ = std::make_unique<StepAction>(*served_);
}

SimulationServices::~SimulationServices() { host_.reset(); }

}  // namespace gsv::ros2
