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

base::Failure<base::Error> RefuseRos2(const base::Error& error, const char* option) {
  return base::Fail(error.code, error.message, option);
}

std::vector<std::string> ModuleFolders() { return {ProgramFolder() / "../lib/gsv"}; }

void AddRange(CLI::App& command, Ros2Arguments& arguments) {
  command
      .add_option("--ros2-range", arguments.range,
                  "range of discovery (default: localhost)\n"
                  "Without this option, ROS_LOCALHOST_ONLY, ROS_AUTOMATIC_DISCOVERY_RANGE and "
                  "ROS_STATIC_PEERS apply. With subnet, ROS_STATIC_PEERS applies too.")
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
                "publish robots as ROS 2 topics, and accept commands\n"
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
  // If a robot has several namespaces in the list, the last one applies. The namespaces of the
  // command line have precedence, so the namespaces of the scenario are inserted before them.
  arguments.namespaces.insert(arguments.namespaces.begin(), namespaces.begin(), namespaces.end());
  return arguments;
}

base::Result<std::optional<ros2::Options>> ParseArguments(const Ros2Arguments& arguments) {
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
  const auto module = ros2::dds::LoadModule(ModuleFolders());
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

base::Result<std::unique_ptr<Ros2Access>> Ros2Access::Start(std::optional<ros2::Options> options,
                                                            gateway::SimulationFactory& factory,
                                                            formats::ModelLibrary& library,
                                                            List list) {
  std::unique_ptr<Ros2Access> access(
      new Ros2Access(std::move(options), factory, library, std::move(list)));
  auto reach =
      ros2::ParticipantFor(access->options_.value_or(ros2::Options()), ros2::ProcessEnvironment);
  if (reach) {
    access->reach_ = *std::move(reach);
    access->reach_.watches_endpoints = true;
  }
  if (!access->is_on()) return access;
  if (!reach) return base::Fail(reach.error());
  const base::MutexLock lock(access->publishing_);
  if (auto ok = access->Join(); !ok) return base::Fail(ok.error());
  return access;
}

Ros2Access::~Ros2Access() {
  {
    const base::MutexLock lock(mutex_);
    is_stopping_ = true;
  }
  changed_.notify_all();
  std::thread watcher;
  {
    const base::MutexLock lock(publishing_);
    watcher = std::move(watcher_);
  }
  if (watcher.joinable()) watcher.join();
  ros2::SimulationServices* services = nullptr;
  {
    const base::MutexLock lock(publishing_);
    services = services_.get();
  }
  if (services != nullptr) services->Close();  // without the mutex, because handlers may lock it
}

std::string DescribeReach(const ros2::dds::ParticipantOptions& options) {
  const char* reach = "this machine only";
  if (options.range == ros2::dds::Range::kPeers) reach = "the machines in ROS_STATIC_PEERS";
  if (options.range == ros2::dds::Range::kSubnet) reach = "the whole subnet";
  return fmt::format("domain {}, {}{}", options.domain, reach,
                     options.enclave_folder.empty() ? "" : ", with the keys of an SROS2 enclave");
}

std::string Ros2Access::Exposure() const {
  if (!ros2::IsExposed(reach_) || !reach_.enclave_folder.empty()) return {};
  return "ROS 2 is reachable from other machines: everyone there can read all topics, command "
         "robots without a behaviour, and control the simulation. Use --ros2-range localhost to "
         "prevent that";
}

base::Status Ros2Access::Join() {
  if (participant_ != nullptr) return {};
  auto participant = MakeParticipant(reach_);
  if (!participant) return base::Fail(participant.error());
  spawner_ = std::make_unique<Ros2Spawner>(factory_, library_, !ros2::IsExposed(reach_));
  participant_ = *std::move(participant);
  return {};
}

void Ros2Access::Show(const SimulationPointer& simulation, ros2::Options options) {
  bridge_.reset();  // removes the topics of the previous simulation
  if (services_ == nullptr) {
    const ros2::Distro distro = options_.value_or(options).distro;
    services_ = std::make_unique<ros2::SimulationServices>(
        *participant_, distro != ros2::Distro::kHumble, spawner_.get());
  }
  published_ = simulation;
  has_world_ = simulation != nullptr;
  bridge_ = has_world_ ? ros2::Bridge::Start(*participant_, std::move(options), simulation,
                                             services_.get())
                       : ros2::Bridge::StartWithoutWorld(*participant_, options.distro, *services_);
}

Ros2Access::SimulationPointer Ros2Access::Published() {
  SimulationPointer published = published_.lock();
  if (published == nullptr) return nullptr;
  const std::vector<SimulationPointer> all = list_();
  return std::find(all.begin(), all.end(), published) != all.end() ? published : nullptr;
}

void Ros2Access::Publish(const SimulationPointer& simulation) {
  const base::MutexLock lock(publishing_);
  Show(simulation, *options_);
}

void Ros2Access::Follow() {
  const base::MutexLock lock(publishing_);
  follows_ = true;
  spawner_->AllowLoadingWorlds([this](const SimulationPointer& next) { return Replace(next); });
  watcher_ = std::thread([this] { Watch(); });
}

gateway::SimulationFactory::Ros2Support Ros2Access::Support() {
  gateway::SimulationFactory::Ros2Support support;
  const auto module = ros2::dds::FindModule(ModuleFolders());
  const auto reach =
      ros2::ParticipantFor(options_.value_or(ros2::Options()), ros2::ProcessEnvironment);
  if (!module || !reach) {
    support.reason = (module ? reach.error() : module.error()).Sentence();
    return support;
  }
  support.is_available = true;
  support.reach = DescribeReach(reach_);
  const base::MutexLock lock(publishing_);
  if (const auto published = Published()) support.published = published->specification().name;
  return support;
}

base::Result<ros2::Options> Ros2Access::OptionsOf(const scenario::Scenario& scenario) {
  if (const auto support = Support(); !support.is_available) {
    return base::Fail(base::ErrorCode::kUnavailable, support.reason);
  }
  // A scenario cannot change the discovery range of the server. Otherwise a user of the viewer
  // could make topics visible to other machines.
  const bool is_wide = ros2::IsExposed(reach_);
  const std::string& range = scenario.ros2->range;
  if (!range.empty() && (range == "subnet") != is_wide) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "this server publishes in " + DescribeReach(reach_) +
                          ". Start it with --ros2 --ros2-range " + range,
                      "range");
  }
  Ros2Arguments arguments = WithSettings({}, scenario.ros2);
  arguments.range.clear();
  auto options = ParseArguments(arguments);
  if (!options) return base::Fail(options.error().code, options.error().message);
  const bool is_stepped = (*options)->is_cmd_vel_stamped && scenario.lockstep.value_or(false);
  if (is_stepped) (*options)->steps = std::make_shared<ros2::NodeSteps>();
  return **std::move(options);
}

base::Status Ros2Access::Publish(const SimulationPointer& simulation, ros2::Options options) {
  const base::MutexLock lock(publishing_);
  const SimulationPointer published = Published();
  if (published != nullptr && published != simulation) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the simulation " + published->specification().name +
                          " is published, and a ROS 2 domain has only one clock. Remove it first");
  }
  if (auto ok = Join(); !ok) return ok;
  if (!is_on() && ros2::IsExposed(reach_)) spdlog::warn("{}", Exposure());
  Show(simulation, std::move(options));
  if (!watcher_.joinable()) watcher_ = std::thread([this] { Watch(); });
  return {};
}

void Ros2Access::Update() {
  if (has_world_ && Published() == nullptr) {
    bridge_.reset();
    has_world_ = false;
    if (!is_on()) {
      services_.reset();
      participant_.reset();
    }
  }
  if (!follows_ || has_world_) return;
  const std::vector<SimulationPointer> all = list_();
  if (!all.empty() || bridge_ == nullptr) {
    Show(all.empty() ? nullptr : all.front(), *options_);
  }
}

base::Status Ros2Access::Replace(const SimulationPointer& next) {
  SimulationPointer previous;
  {
    const base::MutexLock lock(publishing_);
    previous = Published();
    if (previous == nullptr && next == nullptr) {
      return base::Fail(base::ErrorCode::kNotFound, "no world is loaded");
    }
    if (previous == next) return {};  // the watcher thread has already published it
    if (next != nullptr) Show(next, *options_);
  }
  if (previous == nullptr) return {};
  const base::Status removed = factory_.Destroy(previous->specification().name);
  const base::MutexLock lock(publishing_);
  Update();
  return removed;
}

void Ros2Access::Watch() {
  base::MutexLock lock(mutex_);
  while (!is_stopping_) {
    lock.unlock();
    {
      const base::MutexLock publishing(publishing_);
      Update();
    }
    lock.lock();
    changed_.wait_for(lock, kWatchPeriod, [this]() GSV_REQUIRES(mutex_) { return is_stopping_; });
  }
}

}  // namespace gsv::app
