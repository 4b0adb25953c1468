// ROS 2 of a command: its options, the plug-in with the DDS library, and the simulation that is published.
//
// Without --ros2 nothing of it is loaded.
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
  std::string range, distro, cmd_vel;  // empty: not given
  std::vector<std::string> namespaces;
};

// Adds --ros2, --ros2-range, --ros2-namespace, --ros2-cmd-vel and --ros2-distro. `arguments` outlives the
// parsing.
void AddRos2Options(CLI::App& command, Ros2Arguments& arguments);
// The same for `gsv replay`: --ros2, --ros2-range and --ros2-distro.
void AddRos2ReplayOptions(CLI::App& command, Ros2Arguments& arguments);
// The options, with a scenario's settings where the user gave none.
Ros2Arguments WithSettings(Ros2Arguments arguments,
                           const std::optional<scenario::Ros2Settings>& settings);
// Nothing without --ros2; fails when another of the options is given without it.
base::Result<std::optional<ros2::Options>> Understand(const Ros2Arguments& arguments);

// Loads the plug-in that holds the DDS library.
base::Result<std::unique_ptr<ros2::dds::Participant>> MakeParticipant(
    const ros2::dds::ParticipantOptions& options);

// The domain and its range: "domain 0, this machine only".
std::string DescribeReach(const ros2::dds::ParticipantOptions& options);

// A recording that is published while it is replayed.
class Ros2Replay {
 public:
  // Logs a warning if other machines can reach it.
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

// Publishes one simulation at a time: ROS 2 has one clock in a domain.
class Ros2Access final : public Ros2Publisher {
 public:
  using SimulationPointer = std::shared_ptr<simulation::Simulation>;
  using List = std::function<std::vector<SimulationPointer>()>;

  // `options` are those of the command line; empty: it has none, and a simulation is published only if its scenario
  // asks for it. Until then no thread or socket of DDS exists. `factory` and `library` outlive this: SpawnEntity adds
  // models by them. `list` returns the simulations of this process.
  static base::Result<std::unique_ptr<Ros2Access>> Start(std::optional<ros2::Options> options,
                                                         gateway::SimulationFactory& factory,
                                                         formats::ModelLibrary& library, List list);
  ~Ros2Access() override;

  // Whether the command line has --ros2. Only then may the members until Follow() be called.
  bool is_on() const { return options_.has_value(); }
  std::string Description() const { return DescribeReach(reach_); }
  // Why others can reach it; empty: they cannot.
  std::string Exposure() const;
  // Publishes the simulation of `gsv run`.
  void Publish(const SimulationPointer& simulation);
  // Publishes the first of the simulations in the list, and the next when that is gone.
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
  base::Status Join() GSV_REQUIRES(publishing_);
  void Show(const SimulationPointer& simulation, ros2::Options options) GSV_REQUIRES(publishing_);
  // The simulation that is published now; null: none.
  SimulationPointer Published() GSV_REQUIRES(publishing_);
  void Watch();

  const std::optional<ros2::Options> options_;
  gateway::SimulationFactory& factory_;
  formats::ModelLibrary& library_;
  const List list_;
  ros2::dds::ParticipantOptions reach_;

  base::Mutex publishing_;  // held while a simulation is published, or no longer
  std::unique_ptr<ros2::dds::Participant> participant_ GSV_GUARDED_BY(publishing_);
  std::unique_ptr<Ros2Spawner> spawner_ GSV_GUARDED_BY(publishing_);
  std::weak_ptr<simulation::Simulation> published_ GSV_GUARDED_BY(publishing_);
  std::unique_ptr<ros2::Bridge> bridge_ GSV_GUARDED_BY(publishing_);
  bool follows_ GSV_GUARDED_BY(publishing_) = false;
  std::thread watcher_ GSV_GUARDED_BY(publishing_);

  base::Mutex mutex_;
  base::ConditionVariable changed_;
  bool is_stopping_ GSV_GUARDED_BY(mutex_) = false;
};

}  // namespace gsv::app
