// Builds simulations for HTTP requests. Worlds and models come from files, and behaviours from the
// broker.
//
// Threads  any. Several requests may be in progress at once.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/gsv/machine/trial_reading.h"
#include "apps/gsv/simulations/population.h"
#include "apps/gsv/simulations/recordings.h"
#include "apps/gsv/simulations/ros2_publisher.h"
#include "gsv/base/mutex.h"
#include "gsv/formats/files/resource_finder.h"
#include "gsv/gateway/program/simulation_factory.h"
#include "gsv/services/broker_behaviours.h"
#include "gsv/services/simulation_host.h"
#include "gsv/services/simulation_servant.h"

namespace gsv::app {

class SimulationBuilder final : public gateway::SimulationFactory {
 public:
  // All arguments must outlive this object. `model_path` has folders with further models. `reading`
  // has the limits for worlds that are not built in.
  SimulationBuilder(services::SimulationHost& host, services::BrokerBehaviours& behaviours,
                    broker::BrokerClient& broker, Recordings& recordings,
                    std::vector<std::filesystem::path> model_path, const TrialLimits& reading = {})
      : host_(host),
        behaviours_(behaviours),
        broker_(broker),
        recordings_(recordings),
        model_path_(std::move(model_path)),
        finder_(model_path_),
        reading_(reading) {}

  // Sets the publisher for simulations whose scenario has the key `ros2`. Null removes it.
  void PublishThrough(Ros2Publisher* publisher);
  // Sets the CORBA service that offers the created simulations to other programs. Null removes it.
  void OfferThrough(services::SimulationServiceServant* service);

  std::vector<std::string> Worlds() override;
  std::vector<ModelLine> Models() override;
  std::vector<std::string> Objects() override;
  base::Result<Behaviours> FindBehaviours(const std::string& constraint) override;
  Ros2Support Ros2() override;
  gateway::FieldResult<Preview> Show(const gateway::SimulationRequest& request) override;
  gateway::FieldResult<std::shared_ptr<simulation::Simulation>> Create(
      const gateway::SimulationRequest& request) override;
  base::Status Destroy(const std::string& simulation) override;
  gateway::FieldResult<std::string> AddRobot(
      const std::shared_ptr<simulation::Simulation>& simulation, const scenario::RobotEntry& robot,
      bool is_avatar) override;
  gateway::FieldResult<std::string> AddObject(
      const std::shared_ptr<simulation::Simulation>& simulation,
      const gateway::ObjectRequest& object) override;
  base::Result<SavedWorld> SaveWorld(const simulation::Simulation& simulation,
                                     const std::string& file) override;

 private:
  using SimulationPointer = std::shared_ptr<simulation::Simulation>;
  // A recently read world, which is cached because a user who adds robots in the viewer requests
  // the same world repeatedly.
  struct KnownWorld {
    std::string file;
    std::filesystem::file_time_type changed;  // time of the file's last change when it was read
    std::shared_ptr<const model::WorldDescription> world;
    std::vector<std::string> warnings;  // problems of the world's files
  };

  // Reads a world, or returns it from known_.
  gateway::FieldResult<KnownWorld> ReadWorld(const std::string& world);
  // Makes the behaviour of a robot from an offer of the broker; null if the robot has none.
  gateway::FieldResult<std::shared_ptr<simulation::BehaviourPort>> BehaviourFor(
      const scenario::RobotEntry& robot);
  // Returns the function that makes the behaviours of a simulation's robots. `published` is the ROS
  // 2 options of the simulation, or null if it is not published to ROS 2.
  BehaviourMaker BehaviourChoice(const ros2::Options* published);
  // Returns the ROS 2 options of a scenario, or nullopt if it is not published to ROS 2 nodes.
  gateway::FieldResult<std::optional<ros2::Options>> Ros2OptionsOf(
      const scenario::Scenario& scenario);
  // Returns the argument of PublishThrough().
  Ros2Publisher* publisher();

  services::SimulationHost& host_;
  services::BrokerBehaviours& behaviours_;
  broker::BrokerClient& broker_;
  Recordings& recordings_;
  const std::vector<std::filesystem::path> model_path_;
  const formats::ResourceFinder finder_;  // finds the files of models in model_path_
  const TrialLimits reading_;             // limits for worlds that are not built in
  base::Mutex mutex_;
  std::vector<KnownWorld> known_ GSV_GUARDED_BY(mutex_);  // the newest is last
  Ros2Publisher* publisher_ GSV_GUARDED_BY(mutex_) = nullptr;
  // The argument of OfferThrough().
  services::SimulationServiceServant* service_ GSV_GUARDED_BY(mutex_) = nullptr;
};

}  // namespace gsv::app
