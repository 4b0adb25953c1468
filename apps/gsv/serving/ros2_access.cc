#include "apps/gsv/serving/ros2_access.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include "apps/gsv/machine/installation.h"
#include "gsv/base/log.h"
#include "gsv/ros2/dds/module.h"

namespace gsv::app {
namespace {

// The period at which the list of simulations is checked.
constexpr std::chrono::milliseconds kWatchPeriod{200};
constexpr const char* kRos2Group = "ROS 2";

tl::unexpected<base::Error> RefuseRos2(const base::Error& error, const char* option) {
  return base::Fail(error.code, error.message, option);
}

void AddRange(CLI::App& command, Ros2Arguments& arguments) {
  command
      .add_option("--ros2-range", arguments.range,
                  "range of discovery (default: localhost)\n"
                  "Without this option, ROS_AUTOMATIC_DISCOVERY_RANGE applies if it is set.")
      ->type_name("localhost|subnet")
      ->group(kRos2Group);
}

void AddDistro(CLI::App& command, Ros2Arguments& arguments) {
  command
      .add_option("--ros2-distro", arguments.distro,
                  "distribution of the other nodes (default: jazzy)")
      ->type_name("humble|jazzy|kilted|lyrical")
      ->group(kRos2Group);
}

}  // namespace

void AddRos2ReplayOptions(CLI::App& command, Ros2Arguments& arguments) {
  AddRange(command, arguments);
  AddDistro(command, arguments);
  command
      .add_flag("--ros2", arguments.is_on,
                "publish the recording as ROS 2 topics while it is replayed\n"
                "ROS_DOMAIN_ID and the other variables of ROS 2 apply.")
      ->group(kRos2Group);
}

void AddRos2Options(CLI::App& command, Ros2Arguments& arguments) {
  command
      .add_flag("--ros2", arguments.is_on,
                "publish robots as ROS 2 topics, and take commands\n"
                "ROS_DOMAIN_ID and the other variables of ROS 2 apply.")
      ->group(kRos2Group);
  AddRange(command, arguments);
  command
      .add_option("--ros2-namespace", arguments.namespaces,
                  "namespace of a robot's topics (default: /ROBOT)\n"
                  "pebble=/ means no namespace.")
      ->type_name("ROBOT=NAMESPACE")
      ->group(kRos2Group);
  command
      .add_option("--ros2-cmd-vel", arguments.cmd_vel,
                  "message type of cmd_vel (default: twist)\n"
                  "Nav2 of Kilted and later sends twist_stamped.")
      ->type_name("twist|twist_stamped")
      ->group(kRos2Group);
  AddDistro(command, arguments);
}

Ros2Arguments WithSettings(Ros2Arguments arguments,
                           const std::optional<scenario::Ros2Settings>& settings) {
  if (!settings) return arguments;
  arguments.is_on = true;
  if (arguments.range.empty()) arguments.range = settings->range;
  if (arguments.cmd_vel.empty()) arguments.cmd_vel = settings->cmd_vel;
  if (arguments.distro.empty()) arguments.distro = settings->distro;
  std::vector<std::string> namespaces;
  for (const auto& [robot, name_space] : settings->namespaces) {
    namespaces.push_back(robot + "=" + name_space);
  }
  // The later one of a robot counts.
  arguments.namespaces.insert(arguments.namespaces.begin(), namespaces.begin(), namespaces.end());
  return arguments;
}

base::Result<std::optional<ros2::Options>> Understand(const Ros2Arguments& arguments) {
  ros2::Options options;
  const std::pair<const char*, bool> given[]{{"--ros2-range", !arguments.range.empty()},
                                             {"--ros2-namespace", !arguments.namespaces.empty()},
                                             {"--ros2-cmd-vel", !arguments.cmd_vel.empty()},
                                             {"--ros2-distro", !arguments.distro.empty()}};
  for (const auto& [option, is_given] : given) {
    if (!is_given || arguments.is_on) continue;
    return base::Fail(base::ErrorCode::kInvalidArgument, "has an effect only with --ros2", option);
  }
  if (!arguments.is_on) return std::nullopt;
  if (!arguments.range.empty()) {
    const auto range = ros2::ParseRange(arguments.range);
    if (!range) return RefuseRos2(range.error(), "--ros2-range");
    options.range = *range;
  }
  if (!arguments.distro.empty()) {
    const auto distro = ros2::ParseDistro(arguments.distro);
    if (!distro) return RefuseRos2(distro.error(), "--ros2-distro");
    options.distro = *distro;
  }
  for (const std::string& text : arguments.namespaces) {
    const auto ok = ros2::ParseNamespace(text, options.namespaces);
    if (!ok) return RefuseRos2(ok.error(), "--ros2-namespace");
  }
  if (!arguments.cmd_vel.empty()) {
    options.is_cmd_vel_stamped = arguments.cmd_vel == "twist_stamped";
    if (!options.is_cmd_vel_stamped && arguments.cmd_vel != "twist") {
      return base::Fail(base::ErrorCode::kInvalidArgument,
                        "must be twist or twist_stamped, found '" + arguments.cmd_vel + "'",
                        "--ros2-cmd-vel");
    }
  }
  return options;
}

base::Result<std::unique_ptr<ros2::dds::Participant>> MakeParticipant(
    const ros2::dds::ParticipantOptions& options) {
  const auto module = ros2::dds::LoadModule({ProgramFolder() / "../lib/gsv"});
  if (!module) return base::Fail(module.error());
  return (*module)->make(options);
}

base::Result<std::unique_ptr<Ros2Replay>> Ros2Replay::Start(
    const ros2::Options& options, const std::string& path,
    std::function<ros2::RecordingBridge::Position()> position) {
  std::unique_ptr<Ros2Replay> replay(new Ros2Replay);
  auto reach = ros2::ParticipantFor(options, ros2::ProcessEnvironment);
  if (!reach) return base::Fail(reach.error());
  replay->reach_ = *std::move(reach);
  auto participant = MakeParticipant(replay->reach_);
  if (!participant) return base::Fail(participant.error());
  replay->participant_ = *std::move(participant);
  auto bridge = ros2::RecordingBridge::Start(*replay->participant_, options.distro, path,
                                             std::move(position));
  if (!bridge) return base::Fail(bridge.error());
  replay->bridge_ = *std::move(bridge);
  if (ros2::IsExposed(replay->reach_)) {
    spdlog::warn(
        "the recording is published to other machines. Use --ros2-range localhost to prevent that");
  }
  return replay;
}

base::Result<std::unique_ptr<Ros2Access>> Ros2Access::Start(ros2::Options options,
                                                            gateway::SimulationFactory& factory,
                                                            formats::ModelLibrary& library) {
  std::unique_ptr<Ros2Access> access(new Ros2Access);
  auto reach = ros2::ParticipantFor(options, ros2::ProcessEnvironment);
  if (!reach) return base::Fail(reach.error());
  reach->watches_endpoints = true;
  auto participant = MakeParticipant(*reach);
  if (!participant) return base::Fail(participant.error());
  access->spawner_ = std::make_unique<Ros2Spawner>(factory, library, !ros2::IsExposed(*reach));
  access->options_ = std::move(options);
  access->reach_ = *std::move(reach);
  access->participant_ = *std::move(participant);
  return access;
}

Ros2Access::~Ros2Access() {
  {
    const base::MutexLock lock(mutex_);
    is_stopping_ = true;
  }
  changed_.notify_all();
  if (watcher_.joinable()) watcher_.join();
}

std::string DescribeReach(const ros2::dds::ParticipantOptions& options) {
  const char* reach = "this machine only";
  if (options.range == ros2::dds::Range::kPeers) reach = "the machines in ROS_STATIC_PEERS";
  if (options.range == ros2::dds::Range::kSubnet) reach = "the whole subnet";
  return fmt::format("domain {}, {}", options.domain, reach);
}

std::string Ros2Access::Exposure() const {
  if (!ros2::IsExposed(reach_)) return {};
  return "ROS 2 is reachable from other machines: everyone there can read all topics, command "
         "robots without a behaviour, and control the simulation. Use --ros2-range localhost to "
         "prevent that";
}

void Ros2Access::Publish(const SimulationPointer& simulation) {
  published_ = simulation;
  bridge_ = ros2::Bridge::Start(*participant_, options_, simulation, spawner_.get());
}

void Ros2Access::Follow(std::function<std::vector<SimulationPointer>()> list) {
  list_ = std::move(list);
  watcher_ = std::thread([this] { Watch(); });
}

void Ros2Access::Watch() {
  base::MutexLock lock(mutex_);
  while (!is_stopping_) {
    lock.unlock();
    {
      const std::vector<SimulationPointer> all = list_();
      const SimulationPointer published = published_.lock();
      const bool is_there =
          published != nullptr && std::find(all.begin(), all.end(), published) != all.end();
      if (!is_there) bridge_.reset();
      if (!is_there && !all.empty()) Publish(all.front());
    }
    lock.lock();
    changed_.wait_for(lock, kWatchPeriod, [this]() GSV_REQUIRES(mutex_) { return is_stopping_; });
  }
}

}  // namespace gsv::app
