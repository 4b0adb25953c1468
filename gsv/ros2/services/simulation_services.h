// The services and the action of simulation_interfaces 2 (the standard that Gazebo and Isaac Sim follow), and the
// parameter services of the node /gsv.
//
// Source   github.com/ros-simulation/simulation_interfaces, 2.0.
// Threads  as ServiceHost.
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <utility>

#include "gsv/ros2/services/results.h"
#include "gsv/ros2/services/service_host.h"
#include "gsv/ros2/services/spawner.h"

namespace gsv::ros2 {

// The simulation that the services control, and their shared state.
class ServedSimulation {
 public:
  using SetNamespace =
      std::function<base::Status(const std::string& robot, const std::string& name_space)>;

  // The host and the spawner must outlive this. The name of the node is "/gsv". With a null spawner
  // nothing can be added. `namespace_setter` is called with an added robot's namespace.
  ServedSimulation(ServiceHost& service_host, std::string node_name,
                   const std::shared_ptr<simulation::Simulation>& simulation,
                   Spawner* model_spawner, SetNamespace namespace_setter)
      : host(service_host),
        node(std::move(node_name)),
        spawner(model_spawner),
        set_namespace(std::move(namespace_setter)),
        simulation_(simulation) {}

  // Offers a service of simulation_interfaces, for example "get_entities", "GetEntities". `answer`
  // is called with the simulation and a Request, and returns the Response with its result.
  template <typename Request, typename Response, typename Answer>
  void Offer(const char* name, const char* type, ServiceHost::Lane lane, Answer answer) {
    host.Offer<Request>(
        node + "/" + name, std::string("simulation_interfaces/srv/") + type, lane,
        [simulation = simulation_, answer = std::move(answer)](const Request& request) -> Response {
          if (const auto there = simulation.lock()) return answer(*there, request);
          Response gone;
          gone.result = Failed(messages::simulation_interfaces::Result::kResultIncorrectState,
                               "the simulation has ended");
          return gone;
        });
  }

  std::shared_ptr<simulation::Simulation> simulation() const { return simulation_.lock(); }

  ServiceHost& host;
  const std::string node;
  Spawner* const spawner;
  const SetNamespace set_namespace;
  std::set<std::string> spawned;  // names of added entities; used on the slow lane

 private:
  const std::weak_ptr<simulation::Simulation> simulation_;
};

class StepAction;

class SimulationServices {
 public:
  // `participant` and `spawner` must outlive this. See ServedSimulation and ServiceHost.
  SimulationServices(dds::Participant& participant, bool has_hashes,
                     const std::shared_ptr<simulation::Simulation>& simulation, Spawner* spawner,
                     ServedSimulation::SetNamespace set_namespace);
  ~SimulationServices();

  const std::vector<dds::Guid>& readers() const { return host_->readers(); }
  const std::vector<dds::Guid>& writers() const { return host_->writers(); }

 private:
  std::unique_ptr<ServiceHost> host_;  // destroyed first: its handlers use the others
  std::unique_ptr<ServedSimulation> served_;
  std::unique_ptr<StepAction> steps_;
};

}  // namespace gsv::ros2
