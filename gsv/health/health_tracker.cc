#include "gsv/health/health_tracker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gsv/sensing/ranges.h"

namespace gsv::health {
namespace {

constexpr base::SimTime kReadAgainAfter = std::chrono::seconds(5);
constexpr double kNear = 1;  // m: only a distance below this can be the reason for a stop
constexpr std::size_t kRobotsReadAtOnce = 500;

// Whether readings of the type contain only distances, such as "range" of a sonar and "ranges" of a
// lidar.
bool MeasuresRanges(const sensing::SensorType& type) {
  const auto& columns = type.layout.values;
  return columns.size() == 1 && columns[0].unit == "m" &&
         (columns[0].name == "range" || columns[0].name == "ranges");
}

bool NeedsLimit(State state) {
  return state == State::kStanding || state == State::kStuck || state == State::kContact;
}

}  // namespace

SensorAccess SensorsOf(simulation::Simulation& simulation) {
  return {[&simulation](const std::string& robot) { return simulation.sensors(robot); },
          [&simulation](const std::string& robot, const std::string& sensor) {
            return simulation.Watch(robot, sensor);
          },
          &simulation.sensor_types()};
}

std::optional<Limit> FindLimit(const std::string& robot, const SensorAccess& access) {
  std::optional<Limit> nearest;
  for (const model::SensorDescription& sensor : access.sensors(robot)) {
    const sensing::SensorType* type = access.types->Find(sensor.type);
    if (type == nullptr || !MeasuresRanges(*type)) continue;
    const auto reading = access.read(robot, sensor.name);
    if (!reading) continue;
    for (const double range : sensing::RangesOf(sensor, reading->values)) {
      if (!(range < kNear) || (nearest && range >= nearest->value)) continue;
      nearest = Limit{sensor.name, range};
    }
  }
  return nearest;
}

Report HealthTracker::Update(const simulation::SimulationStatus& status, base::SimTime stuck_after,
                             const SensorAccess& access) {
  Report report;
  report.time = status.time;
  report.step = status.step;
  report.stuck_after = stuck_after;
  std::size_t left = robots_read_;
  std::map<std::string, Known> known;
  for (const simulation::RobotStatus& robot : status.robots) {
    if (robot.is_station) continue;
    RobotHealth health = HealthOf(robot, status);
    ++report.counts[static_cast<std::size_t>(health.state)];
    if (NeedsLimit(health.state)) {
      const auto before = known_.find(robot.name);
      Known now{health.state, health.since, base::SimTime(-1), std::nullopt};
      if (before != known_.end() && before->second.state == now.state &&
          before->second.since == now.since) {
        now = std::move(before->second);
      }
      const bool is_old = now.read_at < base::SimTime(0) || status.time < now.read_at ||
                          status.time - now.read_at >= kReadAgainAfter;
      if (is_old && left > 0) {
        --left;
        now.limit = FindLimit(robot.name, access);
        now.read_at = status.time;
      }
      SetLimit(now.limit, health);
      known.emplace(robot.name, std::move(now));
    }
    report.robots.push_back(std::move(health));
  }
  known_ = std::move(known);
  return report;
}

Report HealthNow(simulation::Simulation& simulation) {
  return HealthTracker(kRobotsReadAtOnce)
      .Update(simulation.status(), simulation.specification().stuck_after, SensorsOf(simulation));
}

}  // namespace gsv::health
