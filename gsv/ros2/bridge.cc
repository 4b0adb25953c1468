#include "gsv/ros2/bridge.h"

#include <pthread.h>

#include <algorithm>
#include <atomic>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "gsv/base/log.h"
#include "gsv/base/mutex.h"
#include "gsv/base/spelling.h"
#include "gsv/messages/diagnostic_msgs.h"
#include "gsv/messages/rcl_interfaces.h"
#include "gsv/messages/rosgraph_msgs.h"
#include "gsv/messages/time.h"
#include "gsv/presentation/run_messages.h"
#include "gsv/ros2/feed.h"
#include "gsv/ros2/graph.h"
#include "gsv/ros2/message_source.h"
#include "gsv/ros2/names.h"
#include "gsv/ros2/robot_descriptions.h"
#include "gsv/ros2/robot_topics.h"
#include "gsv/ros2/services/simulation_services.h"
#include "gsv/ros2/slow_lane.h"
#include "gsv/world/station.h"

namespace gsv::ros2 {
namespace {

using messages::rosgraph_msgs::Clock;
using messages::tf2_msgs::TFMessage;
using simulation::Simulation;

constexpr base::SimTime kTransformPeriod = std::chrono::milliseconds(20);
// The period, in wall-clock time, of diagnostics and of RobotTopics::CheckPublishers().
constexpr std::chrono::milliseconds kRefreshPeriod{1000};
// The period of checks for changes of robots and sensors. Some of these changes cause no event.
constexpr std::chrono::milliseconds kFollowPeriod{3000};
constexpr std::chrono::milliseconds kTimeout{250};

using WallClock = std::chrono::steady_clock;

class SimulationBridge final : public Bridge {
 public:
  SimulationBridge(dds::Participant& participant, Options options,
                   const std::shared_ptr<Simulation>& simulation, SimulationServices* services);
  ~SimulationBridge() override;

 private:
  void Run();
  void Refresh(Simulation& simulation);
  void Follow(Simulation& simulation);
  bool FollowRobots(Simulation& simulation, const world::Snapshot& snapshot);
  std::string NamespaceOf(const std::string& body) const;
  base::Status SetNamespace(const std::string& robot, const std::string& name_space);
  void CheckNamespaces(Simulation& simulation);
  void SendStaticFrames(const world::Snapshot& snapshot);
  void SendGraph();
  void FollowReaders();
  void Publish(const SnapshotPointer& snapshot);
  void Repeat();
  template <typename Visit>
  void VisitSources(const Visit& visit);

  dds::Participant& participant_;
  const Options options_;
  const std::weak_ptr<Simulation> simulation_;
  const bool is_lockstep_;
  const std::uint64_t seed_;
  const std::shared_ptr<Feed> feed_;
  std::atomic<bool> is_stopping_{false};
  std::atomic<bool> has_matched_{true};
  std::atomic<bool> repeats_clock_{false};
  mutable base::Mutex namespaces_mutex_;
  // namespaces by robot
  std::map<std::string, std::string> namespaces_ GSV_GUARDED_BY(namespaces_mutex_);

  // The publisher thread uses the following members without a lock.
  std::shared_ptr<const sensing::SensorRegistry> types_;
  sensing::SensorSet sensors_;
  sensing::RaySceneCache rays_;
  Graph graph_;
  Node node_;
  std::vector<std::unique_ptr<Source>> sources_;  // topics of the whole simulation
  RobotDescriptions descriptions_;
  dds::Writer* static_frames_ = nullptr;
  dds::Writer* log_ = nullptr;
  dds::Writer* diagnostics_ = nullptr;
  // topics of each robot, by the name of its body
  std::map<std::string, std::unique_ptr<RobotTopics>> robots_;
  SlowLane slow_;  // declared after sources_ and robots_, because it uses them
  bool has_checked_namespaces_ = false;
  std::unique_ptr<SimulationServices> own_services_;  // null if the caller has given services
  SimulationServices& services_;
  std::thread thread_;
};

void AppendServices(const SimulationServices& services, NodeInfo& node) {
  node.readers.insert(node.readers.end(), services.readers().begin(), services.readers().end());
  node.writers.insert(node.writers.end(), services.writers().begin(), services.writers().end());
}

SimulationBridge::SimulationBridge(dds::Participant& participant, Options options,
                                   const std::shared_ptr<Simulation>& simulation,
                                   SimulationServices* services)
    : participant_(participant),
      options_(std::move(options)),
      simulation_(simulation),
      is_lockstep_(simulation->specification().mode == simulation::Mode::kLockstep),
      seed_(simulation->specification().seed),
      feed_(std::make_shared<Feed>(is_lockstep_)),
      namespaces_(options_.namespaces),
      types_(std::make_shared<sensing::SensorRegistry>(simulation->sensor_types())),
      sensors_(*types_),
      graph_(participant, options_.distro),
      node_(participant, options_.distro, "/", "gsv",
            [this] {
              has_matched_ = true;
              feed_->Wake();
            }),
      own_services_(services == nullptr
                        ? std::make_unique<SimulationServices>(
                              participant, options_.distro != Distro::kHumble, nullptr)
                        : nullptr),
      services_(services == nullptr ? *own_services_ : *services) {
  static_frames_ = node_.Advertise("/tf_static", "tf2_msgs/msg/TFMessage", kLatchedQos);
  log_ = node_.Advertise("/rosout", "rcl_interfaces/msg/Log", kLogQos);
  diagnostics_ =
      node_.Advertise("/diagnostics", "diagnostic_msgs/msg/DiagnosticArray", kDefaultQos);
  sources_.push_back(std::make_unique<MessageSource<Clock>>(
      kClockPeriod, node_.Advertise("/clock", "rosgraph_msgs/msg/Clock", kClockQos),
      [](const world::Snapshot& snapshot) {
        return Clock{messages::ToMessage(snapshot.state.time)};
      }));
  sources_.push_back(std::make_unique<MessageSource<TFMessage>>(
      kTransformPeriod, node_.Advertise("/tf", "tf2_msgs/msg/TFMessage", kTransformQos),
      [this](const world::Snapshot& snapshot) {
        TFMessage message;
        for (const auto& [body, robot] : robots_) robot->AppendMovingFrames(snapshot, message);
        return message;
      }));
  services_.Serve(simulation, [this](const std::string& robot, const std::string& name_space) {
    return SetNamespace(robot, name_space);
  });
  Follow(*simulation);
  Refresh(*simulation);
  simulation->AddObserver(feed_);
  thread_ = std::thread([this] { Run(); });
  if (options_.steps == nullptr) return;
  options_.steps->SetRepeat([this] {
    repeats_clock_ = true;
    feed_->Wake();
  });
}

SimulationBridge::~SimulationBridge() {
  if (options_.steps != nullptr) options_.steps->SetRepeat({});
  is_stopping_ = true;
  feed_->Close();
  thread_.join();
  services_.Serve(nullptr, {});
  if (const auto simulation = simulation_.lock()) simulation->RemoveObserver(feed_);
  slow_.Drain();
  if (feed_->dropped() > 0) {
    spdlog::info("ROS 2: {} snapshots were skipped because publishing did not keep up",
                 feed_->dropped());
  }
  if (slow_.skipped() > 0) {
    spdlog::info(
        "ROS 2: images of {} instants were skipped, because rendering them did not keep up. Use "
        "fewer or smaller "
        "cameras, or a lower rate",
        slow_.skipped());
  }
}

void SimulationBridge::Run() {
  pthread_setname_np(pthread_self(), "ros2");
  auto refreshed = WallClock::now();
  auto followed = refreshed;
  std::shared_ptr<const world::Layout> layout;
  while (!is_stopping_) {
    const Feed::News news = feed_->Next(kTimeout);
    for (const simulation::Event& event : news.events) {
      Send(presentation::LogMessage(event), log_);
    }
    const bool is_new = news.snapshot != nullptr && news.snapshot->layout != layout;
    if (is_new) layout = news.snapshot->layout;
    const auto now = WallClock::now();
    const bool follows = is_new || !news.events.empty() || now - followed >= kFollowPeriod;
    if (follows || now - refreshed >= kRefreshPeriod) {
      const std::shared_ptr<Simulation> simulation = simulation_.lock();
      if (simulation == nullptr) return;
      if (follows) {
        Follow(*simulation);
        followed = now;
      }
      Refresh(*simulation);
      refreshed = now;
    }
    if (has_matched_.exchange(false)) FollowReaders();
    if (news.snapshot != nullptr) Publish(news.snapshot);
    if (repeats_clock_.exchange(false)) Repeat();
  }
}

void SimulationBridge::Follow(Simulation& simulation) {
  const std::shared_ptr<const world::Snapshot> snapshot = simulation.snapshot();
  if (FollowRobots(simulation, *snapshot)) {
    SendStaticFrames(*snapshot);
    has_matched_ = true;
  }
  CheckNamespaces(simulation);
  SendGraph();
}

void SimulationBridge::Refresh(Simulation& simulation) {
  const std::vector<dds::Endpoint> endpoints = participant_.endpoints();
  for (const auto& [body, robot] : robots_) robot->CheckPublishers(endpoints);
  if (diagnostics_ != nullptr && diagnostics_->has_readers()) {
    Send(presentation::DiagnosticsMessage(simulation.status()), diagnostics_);
  }
}

// Adds and removes the topics of robots. Returns whether robots were added, removed or changed.
bool SimulationBridge::FollowRobots(Simulation& simulation, const world::Snapshot& snapshot) {
  std::set<std::string> with_behaviour;
  for (const simulation::RobotStatus& robot : simulation.status().robots) {
    const bool has_own = !robot.behaviour.empty() && robot.behaviour != kRos2Behaviour;
    if (has_own || robot.is_avatar || robot.is_station) {
      with_behaviour.insert(robot.name);
    }
  }
  const RobotTopics::Context context{participant_, options_, simulation, sensors_, [this] {
                                       has_matched_ = true;
                                       feed_->Wake();
                                     }};
  bool has_changed = false;
  std::set<std::string> here;
  for (const world::Body& body : snapshot.layout->bodies) {
    if (!world::HasAgent(body) || body.is_avatar()) continue;
    here.insert(body.name);
    const bool takes_commands = !with_behaviour.contains(body.name);
    std::unique_ptr<RobotTopics>& robot = robots_[body.name];
    if (robot != nullptr && robot->node().name_space == NamespaceOf(body.name) &&
        robot->Fits(body, simulation.sensors(body.name), takes_commands)) {
      continue;
    }
    slow_.Drain();
    // Destroys the old topics first, because the new topics may have the same names.
    robot = nullptr;
    robot = std::make_unique<RobotTopics>(context, body, NamespaceOf(body.name), takes_commands);
    has_changed = true;
  }
  const auto is_gone = [&](const auto& entry) { return !here.contains(entry.first); };
  if (std::none_of(robots_.begin(), robots_.end(), is_gone)) return has_changed;
  slow_.Drain();
  std::erase_if(robots_, is_gone);
  return true;
}

std::string SimulationBridge::NamespaceOf(const std::string& body) const {
  const base::MutexLock lock(namespaces_mutex_);
  const auto chosen = namespaces_.find(body);
  return chosen != namespaces_.end() ? chosen->second : "/" + RosName(body);
}

base::Status SimulationBridge::SetNamespace(const std::string& robot,
                                            const std::string& name_space) {
  if (name_space.empty()) {
    const base::MutexLock lock(namespaces_mutex_);
    namespaces_.erase(robot);  // an earlier robot of this name may have had one
    const auto chosen = options_.namespaces.find(robot);
    if (chosen != options_.namespaces.end()) namespaces_.insert(*chosen);
    return {};
  }
  const std::string whole = name_space.starts_with('/') ? name_space : "/" + name_space;
  if (!IsNamespace(whole)) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "it is not a valid ROS 2 namespace",
                      name_space.substr(0, 100));
  }
  const base::MutexLock lock(namespaces_mutex_);
  namespaces_[robot] = whole;
  return {};
}

// Logs once, after the start, which names in Options::namespaces belong to no robot.
void SimulationBridge::CheckNamespaces(Simulation& simulation) {
  if (has_checked_namespaces_ || simulation.status().phase == simulation::Phase::kCreated) return;
  has_checked_namespaces_ = true;
  std::vector<std::string> names;
  for (const auto& [body, robot] : robots_) names.push_back(body);
  for (const auto& [robot, name_space] : options_.namespaces) {
    if (robots_.contains(robot)) continue;
    spdlog::warn("--ros2-namespace {}={}: there is no robot of that name{}", robot, name_space,
                 base::DidYouMean(robot, names));
  }
}

void SimulationBridge::SendStaticFrames(const world::Snapshot& snapshot) {
  TFMessage message;
  for (const auto& [body, robot] : robots_) robot->AppendStaticFrames(snapshot, message);
  Send(message, static_frames_);
}

void SimulationBridge::SendGraph() {
  std::vector<NodeInfo> nodes{node_.info()};
  AppendServices(services_, nodes.front());
  for (const auto& [body, robot] : robots_) nodes.push_back(robot->node());
  graph_.Publish(nodes);
}

template <typename Visit>
void SimulationBridge::VisitSources(const Visit& visit) {
  for (const auto& source : sources_) visit(*source);
  for (const auto& [body, robot] : robots_) {
    for (const auto& source : robot->sources()) visit(*source);
  }
}

// Snapshots are taken only if a topic with readers needs them.
void SimulationBridge::FollowReaders() {
  for (const auto& [body, robot] : robots_) robot->SendDescription(descriptions_);
  std::set<base::SimTime> periods;
  VisitSources([&](Source& source) {
    if (source.is_wanted()) periods.insert(source.period());
  });
  feed_->SetPeriods(periods);
}

void SimulationBridge::Publish(const SnapshotPointer& snapshot) {
  const Moment moment{snapshot, seed_, rays_};
  std::vector<Source*> slow;
  VisitSources([&](Source& source) {
    if (!source.AdvanceTo(snapshot->state.time) || !source.is_wanted()) return;
    if (source.takes_long()) {
      slow.push_back(&source);
    } else {
      source.Publish(moment);
    }
  });
  if (!slow.empty()) slow_.Offer(std::move(slow), moment, is_lockstep_);
}

// Called while a step waits for a node: sends /clock again. Before the first step, sends all
// topics, because there was no step yet that could have published them.
void SimulationBridge::Repeat() {
  const std::shared_ptr<Simulation> simulation = simulation_.lock();
  if (simulation == nullptr) return;
  const SnapshotPointer snapshot = simulation->snapshot();
  const Moment moment{snapshot, seed_, rays_};
  const bool is_first = snapshot->state.step == 0;
  std::vector<Source*> slow;
  VisitSources([&](Source& source) {
    if (!source.is_wanted() || (!is_first && &source != sources_.front().get())) return;
    if (source.takes_long()) {
      slow.push_back(&source);
    } else {
      source.Publish(moment);
    }
  });
  if (!slow.empty()) slow_.Offer(std::move(slow), moment, true);
}

class ServicesAlone final : public Bridge {
 public:
  ServicesAlone(dds::Participant& participant, Distro distro, SimulationServices& services)
      : graph_(participant, distro) {
    services.Serve(nullptr, {});
    NodeInfo node{"/", "gsv", {}, {}};
    AppendServices(services, node);
    graph_.Publish({node});
  }

 private:
  Graph graph_;
};

}  // namespace

std::unique_ptr<Bridge> Bridge::StartWithoutWorld(dds::Participant& participant, Distro distro,
                                                  SimulationServices& services) {
  return std::make_unique<ServicesAlone>(participant, distro, services);
}

std::unique_ptr<Bridge> Bridge::Start(dds::Participant& participant, Options options,
                                      const std::shared_ptr<Simulation>& simulation,
                                      SimulationServices* services) {
  return std::make_unique<SimulationBridge>(participant, std::move(options), simulation, services);
}

}  // namespace gsv::ros2
