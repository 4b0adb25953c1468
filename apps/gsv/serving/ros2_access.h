// Connects a gsv command to ROS 2: its options, the plug-in with the DDS library, and the
// simulation that is published as topics.
//
// Without --ros2 the plug-in is not loaded.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "apps/gsv/serving/ros2_spawner.h"
#include "apps/gsv/simulations/ros2_publisher.h"
#include "gsv/base/mutex.h"
#include "gsv/ros2/bridge.h"
#include "gsv/ros2/dds/participant.h"
#include "gsv/ros2/options.h"
#include "gsv/ros2/recording_bridge.h"
#include "gsv/scenario/scenario.h"

namespace CLI {
class App;
}

namespace gsv::app {

using ros2::kRos2Behaviour;

// The options as the user gave them.
struct Ros2Arguments {
  bool is_on = false;
  std::string range, distro, cmd_vel;  // empty if not given
  std::vector<std::string> namespaces;
};

// Adds --ros2, --ros2-range, --ros2-namespace, --ros2-cmd-vel and --ros2-distro. `arguments` must
// outlive the parsing.
void AddRos2Options(CLI::App& command, Ros2Arguments& arguments);
// Adds the options of `gsv replay`: --ros2, --ros2-range and --ros2-distro.
void AddRos2ReplayOptions(CLI::App& command, Ros2Arguments& arguments);
// Returns the options, completed with the settings of a scenario.
Ros2Arguments WithSettings(Ros2Arguments arguments,
                           const std::optional<scenario::Ros2Settings>& settings);
// Returns nullopt without --ros2. Fails if another ROS 2 option is given without --ros2.
base::Result<std::optional<ros2::Options>> ParseArguments(const Ros2Arguments& arguments);

// Loads the plug-in that holds the DDS library.
base::Result<std::unique_ptr<ros2::dds::Participant>> MakeParticipant(
    const ros2::dds::ParticipantOptions& options);

// Returns the domain and its range, such as "domain 0, this machine only".
std::string DescribeReach(const ros2::dds::ParticipantOptions& options);

// Publishes a recording while it is replayed.
class Ros2Replay {
 public:
  // Logs a warning if other machines can reach the topics.
  static base::Result<std::unique_ptr<Ros2Replay>> Start(
      const ros2::Options& options, const std::string& path,
      std::function<ros2::RecordingBridge::Position()> position);

  std::string Description() const { return DescribeReach(reach_); }

 private:
  Ros2Replay() = default;

  ros2::dds::ParticipantOptions reach_;
  std::unique_ptr<ros2::dds::Participant> participant_;
  std::unique_ptr<ros2::RecordingBridge> bridge_;
};

// Publishes one simulation at a time, because a ROS 2 domain has a single clock.
class Ros2Access final : public Ros2Publisher {
 public:
  using SimulationPointer = std::shared_ptr<simulation::Simulation>;
  // Returns the simulations of this process.
  using List = std::function<std::vector<SimulationPointer>()>;

  // `options` are the options of the command line. If there are none, only a scenario can start
  // publishing, and DDS has no thread or socket until then. `factory` and `library` must outlive
  // this object, because SpawnEntity uses them to add models. `list` returns the simulations of
  // this process.
  static base::Result<std::unique_ptr<Ros2Access>> Start(std::optional<ros2::Options> options,
                                                         gateway::SimulationFactory& factory,
                                                         formats::ModelLibrary& library, List list);
  ~Ros2Access() override;

  // Whether the command line has --ros2. Call Publish(simulation) and Follow() only if it has.
  bool is_on() const { return options_.has_value(); }
  std::string Description() const { return DescribeReach(reach_); }
  // Returns why other machines can reach the topics. Returns an empty text if they cannot, or need
  // keys.
  std::string Exposure() const;
  // Publishes the simulation of `gsv run`.
  void Publish(const SimulationPointer& simulation);
  // Publishes the first simulation in the list. When that simulation has ended, publishes the first
  // of the other simulations. Also allows ROS 2 nodes to load another world.
  void Follow();

  gateway::SimulationFactory::Ros2Support Support() override;
  base::Result<ros2::Options> OptionsOf(const scenario::Scenario& scenario) override;
  base::Status Publish(const SimulationPointer& simulation, ros2::Options options) override;

 private:
  Ros2Access(std::optional<ros2::Options> options, gateway::SimulationFactory& factory,
             formats::ModelLibrary& library, List list)
      : options_(std::move(options)),
        factory_(factory),
        library_(library),
        list_(std::move(list)) {}
  // Creates the DDS participant, if there is none.
  base::Status Join() GSV_REQUIRES(publishing_);
  // Replaces the published simulation by `simulation`, or removes it if `simulation` is null.
  void Show(const SimulationPointer& simulation, ros2::Options options) GSV_REQUIRES(publishing_);
  // Removes a published simulation that has ended. If follows_ is true, publishes the first
  // simulation in the list.
  void Update() GSV_REQUIRES(publishing_);
  // Publishes `next` if it is not null. Then ends the simulation that was published before. Fails
  // with kNotFound if there is neither.
  base::Status Replace(const SimulationPointer& next);
  // Returns the currently published simulation, or null.
  SimulationPointer Published() GSV_REQUIRES(publishing_);
  void Watch();  // the function of watcher_: calls Update() periodically

  const std::optional<ros2::Options> options_;
  gateway::SimulationFactory& factory_;
  formats::ModelLibrary& library_;
  const List list_;
  ros2::dds::ParticipantOptions reach_;

  base::Mutex publishing_;  // locked while publishing starts or ends
  std::unique_ptr<ros2::dds::Participant> participant_ GSV_GUARDED_BY(publishing_);
  std::unique_ptr<Ros2Spawner> spawner_ GSV_GUARDED_BY(publishing_);
  // The published simulation; expired or null if there is none.
  std::weak_ptr<simulation::Simulation> published_ GSV_GUARDED_BY(publishing_);
  // bridge_ ends with the published simulation. After Follow(), another bridge replaces it, with or
  // without a simulation. With --ros2, services_ exists until this object ends. Without --ros2, it
  // ends with the published simulation.
  std::unique_ptr<ros2::SimulationServices> services_ GSV_GUARDED_BY(publishing_);
  std::unique_ptr<ros2::Bridge> bridge_ GSV_GUARDED_BY(publishing_);
  bool follows_ GSV_GUARDED_BY(publishing_) = false;    // whether Follow() was called
  bool has_world_ GSV_GUARDED_BY(publishing_) = false;  // whether bridge_ publishes a simulation
  std::thread watcher_ GSV_GUARDED_BY(publishing_);

  base::Mutex mutex_;
  base::ConditionVariable changed_;  // wakes watcher_
  bool is_stopping_ GSV_GUARDED_BY(mutex_) = false;
};

}  // namespace gsv::app
