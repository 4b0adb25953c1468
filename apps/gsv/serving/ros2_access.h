// ROS 2 of a command: its options, the plug-in with the DDS library, and the simulation that is published.
//
// Without --ros2 nothing of it is loaded.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "apps/gsv/serving/ros2_spawner.h"
#include "gsv/base/mutex.h"
#include "gsv/ros2/bridge.h"
#include "gsv/ros2/dds/participant.h"
#include "gsv/ros2/options.h"

namespace CLI {
class App;
}

namespace gsv::app {

// ROS 2 nodes drive a robot of this behaviour, as they drive one without a behaviour.
inline constexpr const char* kRos2Behaviour = "ros2";

// The options as the user gave them.
struct Ros2Arguments {
  bool is_on = false;
  std::string range, distro, cmd_vel;  // empty: not given
  std::vector<std::string> namespaces;
};

// Adds --ros2, --ros2-range, --ros2-namespace, --ros2-cmd-vel and --ros2-distro. `arguments` outlives the
// parsing.
void AddRos2Options(CLI::App& command, Ros2Arguments& arguments);
// Nothing without --ros2; fails when another of the options is given without it.
base::Result<std::optional<ros2::Options>> Understand(const Ros2Arguments& arguments);

// Loads the plug-in that holds the DDS library.
base::Result<std::unique_ptr<ros2::dds::Participant>> MakeParticipant(
    const ros2::dds::ParticipantOptions& options);

// The domain and its range: "domain 0, this machine only".
std::string DescribeReach(const ros2::dds::ParticipantOptions& options);

class Ros2Access {
 public:
  using SimulationPointer = std::shared_ptr<simulation::Simulation>;

  // `factory` and `library` outlive this: SpawnEntity adds models by them.
  static base::Result<std::unique_ptr<Ros2Access>> Start(ros2::Options options,
                                                         gateway::SimulationFactory& factory,
                                                         formats::ModelLibrary& library);
  ~Ros2Access();

  std::string Description() const { return DescribeReach(reach_); }
  // Why others can reach it; empty: they cannot.
  std::string Exposure() const;

  void Publish(const SimulationPointer& simulation);
  // Publishes the first of the simulations that `list` returns, and the next when that is gone: ROS 2 has
  // one clock.
  void Follow(std::function<std::vector<SimulationPointer>()> list);

 private:
  Ros2Access() = default;
  void Watch();

  ros2::Options options_;
  ros2::dds::ParticipantOptions reach_;
  std::unique_ptr<ros2::dds::Participant> participant_;
  std::unique_ptr<Ros2Spawner> spawner_;
  std::weak_ptr<simulation::Simulation> published_;
  std::unique_ptr<ros2::Bridge> bridge_;

  std::function<std::vector<SimulationPointer>()> list_;
  base::Mutex mutex_;
  base::ConditionVariable changed_;
  bool is_stopping_ GSV_GUARDED_BY(mutex_) = false;
  std::thread watcher_;
};

}  // namespace gsv::app
