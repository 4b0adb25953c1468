#include "gsv/gateway/live/robot_beams.h"

#include <atomic>
#include <utility>

#include "gsv/gateway/foxglove/channels.h"
#include "gsv/presentation/sensor_messages.h"
#include "gsv/presentation/topics.h"

namespace gsv::gateway {
namespace {

constexpr double kRobotBeamsRate = 15;  // Hz

}  // namespace

struct RobotBeams::Robot {
  std::string name;
  foxglove::ChannelId channel = 0;
  std::shared_ptr<const std::vector<Source>> sources;
  Pacing pacing{kRobotBeamsRate};
  std::weak_ptr<const world::Snapshot> published;
  std::atomic<bool> is_busy{false};
  presentation::BeamMarkers markers;  // used only by the job that reads the beams
};

std::set<std::string> RobotBeams::SubscribedRobots() const {
  std::set<std::string> robots;
  for (const auto& [name, robot] : robots_) {
    if (hub_->IsSubscribed(robot->channel)) robots.insert(name);
  }
  return robots;
}

void RobotBeams::Refresh(const Sources& sources) {
  std::vector<foxglove::ChannelId> gone;
  for (auto robot = robots_.begin(); robot != robots_.end();) {
    if (sources.contains(robot->first)) {
      ++robot;
      continue;
    }
    gone.push_back(robot->second->channel);
    robot = robots_.erase(robot);
  }
  if (!gone.empty()) hub_->Unadvertise(gone);
  for (const auto& [name, list] : sources) {
    std::shared_ptr<Robot>& robot = robots_[name];
    if (!robot) {
      robot = std::make_shared<Robot>();
      robot->name = name;
      const std::string topic = std::string(presentation::topics::kBeams.name) + "/" + name;
      robot->channel = hub_->Advertise(
          {ChannelFor(topic, messages::SchemaOf<messages::visualization_msgs::MarkerArray>())})[0];
    }
    robot->sources = std::make_shared<const std::vector<Source>>(list);
  }
}

void RobotBeams::Publish(const std::shared_ptr<simulation::Simulation>& simulation,
                         const std::shared_ptr<const world::Snapshot>& snapshot, WallTime now) {
  for (const auto& [name, robot] : robots_) Publish(simulation, snapshot, now, robot);
}

void RobotBeams::Publish(const std::shared_ptr<simulation::Simulation>& simulation,
                         const std::shared_ptr<const world::Snapshot>& snapshot, WallTime now,
                         const std::shared_ptr<Robot>& robot) {
  if (robot->is_busy || !hub_->IsSubscribed(robot->channel)) return;
  const bool is_due = robot->published.lock() != snapshot && robot->pacing.IsDue(now);
  if (!is_due && !hub_->HasNewSubscribers(robot->channel)) return;
  robot->is_busy = true;
  const auto take = [hub = hub_, robot, simulation, snapshot, sources = robot->sources] {
    const int body = snapshot->layout->Find(robot->name);
    for (const Source& source : *sources) {
      if (body < 0) break;
      const auto reading = simulation->Watch(robot->name, source.sensor);
      if (reading) robot->markers.Add(*snapshot, body, *source.type, *source.made, *reading);
    }
    const base::SimTime time = snapshot->state.time;
    hub->Publish(robot->channel, {base::NanosecondsOf(time), Encoded(robot->markers.Take(time))});
    robot->is_busy = false;
  };
  if (!workers_.Submit(take)) {
    robot->is_busy = false;  // the workers are busy; the next call tries again
    return;
  }
  robot->published = snapshot;
  robot->pacing.Done(now);
}

}  // namespace gsv::gateway
