// The services and the action of simulation_interfaces 2 (the standard that Gazebo and Isaac Sim
// follow), and the parameter services of the node /gsv.
//
// Source   github.com/ros-simulation/simulation_interfaces, 2.0.
// Threads  see ServiceHost.
#pragma once

#include <functional>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/ros2/services/results.h"
#include "gsv/ros2/services/service_host.h"
#include "gsv/ros2/services/spawner.h"

namespace gsv::ros2 {

// The simulation that the services control, and the state that the services share. Serve() replaces
// the simulation by another simulation, or by none.
//
// Threads  any, except for spawned().
class ServedSimulation {
 public:
  // Sets the ROS namespace of a robot.
  using SetNamespace =
      std::function<base::Status(const std::string& robot, const std::string& name_space)>;

  // The host and the spawner must outlive this object. An example of a node name
  // is "/gsv". If the spawner is null, requests to add entities fail.
  ServedSimulation(ServiceHost& service_host, std::string node_name, Spawner* model_spawner)
      : host(service_host), node(std::move(node_name)), spawner(model_spawner) {}

  // Sets the simulation; null means that no world is loaded. `set_namespace` is called with the
  // namespace of each robot that is added, until Serve() is called again.
  void Serve(const std::shared_ptr<simulation::Simulation>& simulation, SetNamespace set_namespace);

  // Offers a service of simulation_interfaces. For example, `name` is "get_entities" and `type` is
  // "GetEntities". `answer` is called with the simulation and a Request, and returns the Response
  // with its result.
  template <typename Request, typename Response, typename Answer>
  void Offer(const char* name, const char* type, ServiceHost::Lane lane, Answer answer) {
    host.Offer<Request>(node + "/" + name, std::string("simulation_interfaces/srv/") + type, lane,
                        [this, answer = std::move(answer)](const Request& request) -> Response {
                          if (const auto there = simulation()) return answer(*there, request);
                          Response gone;
                          gone.result = NoSimulation();
                          return gone;
                        });
  }

  // Returns null if no simulation is set.
  std::shared_ptr<simulation::Simulation> simulation() const;
  // Returns the result for a request that needs a simulation, if no simulation is set.
  messages::simulation_interfaces::Result NoSimulation() const;
  // Calls the function `set_namespace` of Serve().
  base::Status SetNamespaceOf(const std::string& robot, const std::string& name_space) const;
  // Whether clients can load another world.
  bool loads_worlds() const { return spawner != nullptr && spawner->loads_worlds(); }
  // Returns the names of the entities that clients have added to the simulation. Serve() clears
  // them. Call it only on the thread of ServiceHost::Lane::kSlow.
  std::set<std::string>& spawned();

  ServiceHost& host;       // offers the services
  const std::string node;  // name of the node, such as "/gsv"
  Spawner* const spawner;  // adds models and loads worlds; null if requests to add entities fail

 private:
  mutable base::Mutex mutex_;
  std::weak_ptr<simulation::Simulation> simulation_ GSV_GUARDED_BY(mutex_);
  SetNamespace set_namespace_ GSV_GUARDED_BY(mutex_);
  std::uint64_t count_ GSV_GUARDED_BY(mutex_) = 0;  // number of calls of Serve()
  std::set<std::string> spawned_;                   // names of added entities, see spawned()
  std::uint64_t spawned_in_ = 0;                    // value of count_ when spawned_ was last used
};

class StepAction;

// All services of the node /gsv.
class SimulationServices {
 public:
  // `participant` and `spawner` must outlive this object. See ServiceHost for `has_hashes`, and
  // ServedSimulation for `spawner`. Clients find no service before the first call of Serve().
  SimulationServices(dds::Participant& participant, bool has_hashes, Spawner* spawner);
  ~SimulationServices();

  // Calls ServedSimulation::Serve(). The services are not offered before the first call, so that
  // the first request of a client already reaches this simulation. One call at a time.
  void Serve(const std::shared_ptr<simulation::Simulation>& simulation,
             ServedSimulation::SetNamespace set_namespace);
  // Ends the services: no handler runs afterwards.
  void Close();

  // The endpoints of the services, for the node graph. Empty before the first Serve().
  const std::vector<dds::Guid>& readers() const { return readers_; }
  const std::vector<dds::Guid>& writers() const { return writers_; }

 private:
  // Offers all services.
  void Offer();

  std::vector<dds::Guid> readers_, writers_;
  // Close() destroys the host first, because its handlers use the other members.
  std::unique_ptr<ServiceHost> host_;
  std::unique_ptr<ServedSimulation> served_;  // the simulation that the services control
  std::unique_ptr<StepAction> steps_;
};

}  // namespace gsv::ros2
