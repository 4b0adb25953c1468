// Owns the parts of a gsv process that runs simulations: the ORB, the connection to a broker (a new
// or an existing broker), sensor types, simulations, behaviour programs, services, and the gateway.
//
// Threads  created and destroyed on the main thread.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/gsv/machine/child_process.h"
#include "apps/gsv/machine/running_instances.h"
#include "apps/gsv/servers/scenario_service.h"
#include "apps/gsv/serving/behaviour_launcher.h"
#include "apps/gsv/serving/ros2_access.h"
#include "apps/gsv/serving/server_limits.h"
#include "apps/gsv/serving/viewer_options.h"
#include "apps/gsv/simulations/sensor_types.h"
#include "gsv/formats/files/read_limits.h"
#include "gsv/services/broker_behaviours.h"
#include "gsv/services/server_load.h"
#include "gsv/services/simulation_host.h"
#include "gsv/services/simulation_servant.h"

namespace gsv::app {

class LostSimulations;
class Recordings;
class SimulationBuilder;

// The parts of a process, and their options.
struct RuntimeOptions {
  std::string
      broker;  // the reference of a broker; if empty, the runtime starts a broker on loopback
  // if false, the process has no behaviours over CORBA, no services and no viewer
  bool has_broker = true;
  std::vector<std::filesystem::path> model_path;  // folders that are searched for models
  std::map<std::string, std::string> drives;      // drives by model, see ReadOptions::drives
  // A library that has already read files with these options; null for a new library.
  std::shared_ptr<formats::ModelLibrary> library;
  SensorTypeOptions sensors;  // sensor types of plug-ins
  formats::ReadLimits limits;
  ServerLimits server_limits;
  bool viewer = true;                 // whether to serve the viewer
  ViewerOptions web;                  // address, tokens and certificate of the viewer
  std::optional<ros2::Options> ros2;  // empty if there is no ROS 2 bridge
  // The name of the server in crash reports. If it is empty, there are no crash reports about this
  // process.
  std::string noted_as;
};

// All parts of a gsv process that runs simulations.
class Runtime {
 public:
  // Starts the parts that the options request.
  static base::Result<std::unique_ptr<Runtime>> Start(const RuntimeOptions& options);
  ~Runtime();

  services::SimulationHost& host() { return *host_; }
  services::BrokerBehaviours& behaviours() { return *behaviours_; }
  BehaviourLauncher& launcher() { return *launcher_; }
  broker::BrokerClient& broker() { return *broker_; }
  Recordings& recordings() { return *recordings_; }
  // Null without --ros2.
  Ros2Access* ros2() { return ros2_ != nullptr && ros2_->is_on() ? ros2_.get() : nullptr; }
  const std::string& viewer_url() const { return viewer_url_; }  // Empty if there is no viewer.

  // Registers sba::SimulationService, with the existing simulations, at the broker for the lifetime
  // of this object. Writes the file by which this user's other commands find this process. If
  // `scenarios` > 0, also registers sba::ScenarioService for that number of concurrent scenarios.
  base::Status OfferService(const std::string& name, int scenarios = 0);

  // Call this when the process must end soon. From now on, all calls that stop behaviours have one
  // second in total. After that, behaviour programs have half a second to end.
  void EndSoon();

 private:
  Runtime() = default;
  base::Status StartBroker(const RuntimeOptions& options);
  base::Status StartGateway(const RuntimeOptions& options);
  // Returns the functions of this program that the CORBA services call.
  services::ServiceHooks Hooks();
  base::Status OfferScenarios(const std::string& name, int scenarios);

  std::unique_ptr<ChildProcess> broker_process_;  // null if the broker was already running
  CORBA::ORB_var orb_;
  std::unique_ptr<broker::BrokerClient> broker_;
  std::shared_ptr<services::SimulationHost> host_;
  std::unique_ptr<Recordings> recordings_;
  std::unique_ptr<LostSimulations> lost_;  // null if there are no crash reports
  std::unique_ptr<services::BrokerBehaviours> behaviours_;
  std::unique_ptr<BehaviourLauncher> launcher_;
  std::unique_ptr<SimulationBuilder> builder_;
  std::unique_ptr<gateway::Gateway> gateway_;
  std::unique_ptr<Ros2Access> ros2_;
  std::string viewer_url_;
  PortableServer::Servant_var<services::SimulationServiceServant> service_;
  PortableServer::Servant_var<ScenarioServiceServant> scenarios_;
  PortableServer::Servant_var<services::ServerLoad> load_;
  std::vector<std::string> offers_;         // ids of the offers
  std::unique_ptr<InstanceRecord> record_;  // the file by which other commands find this process
};

}  // namespace gsv::app
