#include "gsv/recording/topics/simulation_feed.h"

#include "gsv/world/station.h"

namespace gsv::recording {
namespace {

// The lists of sensors are made when the layout changes. Mounting a sensor does not change the
// layout, so the count of mounted sensors is compared at this interval.
constexpr base::SimTime kSensorPeriod = std::chrono::seconds(1);
constexpr std::size_t kMaxEvents = 10'000;

}  // namespace

SensorLists SensorsOf(const simulation::Simulation& simulation, const world::Layout& layout) {
  SensorLists lists;
  for (const world::Body& body : layout.bodies) {
    if (world::HasAgent(body)) lists.emplace(body.name, simulation.sensors(body.name));
  }
  return lists;
}

SimulationFeed::SimulationFeed(const simulation::Simulation& simulation, FeedOptions options)
    : simulation_(simulation),
      options_(options),
      status_instants_(options.status_period),
      sensor_instants_(kSensorPeriod) {}

Observation SimulationFeed::Observe(const std::shared_ptr<const world::Snapshot>& snapshot) {
  Observation observation{snapshot, nullptr, std::nullopt};
  const base::SimTime time = snapshot->state.time;
  if (status_instants_.AdvanceTo(time)) {
    observation.status = simulation_.status();
    observation.expectations = simulation_.expectations();
  }
  const bool is_due = sensor_instants_.AdvanceTo(time);
  if (layout_ != snapshot->layout || (is_due && sensor_changes_ != simulation_.sensor_changes())) {
    sensor_changes_ = simulation_.sensor_changes();
    observation.sensors = std::make_shared<SensorLists>(SensorsOf(simulation_, *snapshot->layout));
    layout_ = snapshot->layout;
  }
  return observation;
}

void SimulationFeed::OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) {
  {
    base::MutexLock lock(mutex_);
    const auto has_room = [this]() GSV_REQUIRES(mutex_) {
      return closed_ || snapshots_ < options_.capacity;
    };
    if (options_.when_full == WhenFull::kWait) room_.wait(lock, has_room);
    if (closed_) return;
    if (!has_room()) {
      ++dropped_;
      return;
    }
  }
  Observation observation = Observe(snapshot);
  {
    const base::MutexLock lock(mutex_);
    if (closed_) return;
    queue_.emplace_back(std::move(observation));
    ++snapshots_;
  }
  news_.notify_one();
}

void SimulationFeed::OnEvent(const simulation::Event& event) {
  // The event "reset" is not recorded, because its time is in the next run.
  const bool is_reset = event.kind == "reset";
  {
    const base::MutexLock lock(mutex_);
    if (closed_) return;
    was_reset_ = is_reset;
    closed_ = is_reset;
    if (!is_reset && queue_.size() - snapshots_ < kMaxEvents) queue_.emplace_back(event);
  }
  news_.notify_one();
  if (is_reset) room_.notify_all();
}

std::optional<Occurrence> SimulationFeed::Next(std::chrono::milliseconds timeout) {
  base::MutexLock lock(mutex_);
  news_.wait_for(lock, timeout,
                 [this]() GSV_REQUIRES(mutex_) { return closed_ || !queue_.empty(); });
  if (queue_.empty()) return std::nullopt;
  Occurrence next = std::move(queue_.front());
  queue_.pop_front();
  if (std::holds_alternative<Observation>(next)) --snapshots_;
  lock.unlock();
  room_.notify_one();
  return next;
}

void SimulationFeed::CloseAtLatest() {
  const simulation::SimulationStatus status = simulation_.status();
  {
    const base::MutexLock lock(mutex_);
    if (!closed_) {
      // The status is read before the snapshot. If the simulation is running, the snapshot may be
      // newer.
      queue_.emplace_back(
          Observation{simulation_.snapshot(), nullptr, status, simulation_.expectations()});
      ++snapshots_;
    }
    closed_ = true;
  }
  Close();
}

void SimulationFeed::Close() {
  {
    const base::MutexLock lock(mutex_);
    closed_ = true;
  }
  news_.notify_all();
  room_.notify_all();
}

bool SimulationFeed::is_over() const {
  const base::MutexLock lock(mutex_);
  return closed_ && queue_.empty();
}

bool SimulationFeed::was_reset() const {
  const base::MutexLock lock(mutex_);
  return was_reset_;
}

std::uint64_t SimulationFeed::dropped() const {
  const base::MutexLock lock(mutex_);
  return dropped_;
}

}  // namespace gsv::recording
