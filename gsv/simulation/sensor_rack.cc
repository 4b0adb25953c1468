#include "gsv/simulation/sensor_rack.h"

#include <cmath>

namespace gsv::simulation {
namespace {

constexpr std::size_t kMaxSensorsPerRobot = 1024;

base::SimTime PeriodOf(double update_rate) {
  return update_rate > 0 ? base::FromSeconds(1.0 / update_rate) : base::SimTime(0);
}

}  // namespace

struct SensorRack::Slot {
  model::SensorDescription description;
  std::unique_ptr<sensing::Sensor> sensor;  // null: cannot be made, see `refusal`
  base::Error refusal;
  base::SimTime period{0};
  bool created = false;  // by a caller, not by the model
  bool open = false;     // guarded by the rack's mutex

  std::mutex mutex;  // guards what follows
  std::shared_ptr<const world::Snapshot> sampled_at;
  sensing::Reading newest;
};

SensorRack::SensorRack(std::string robot, const model::Model& model,
                       std::shared_ptr<const sensing::SensorRegistry> types)
    : robot_(std::move(robot)), types_(std::move(types)) {
  for (const model::SensorDescription& description : model.sensors) {
    auto slot = MakeSlot(description);
    if (!slot) {
      auto refused = std::make_shared<Slot>();
      refused->description = description;
      refused->refusal = slot.error();
      slot = std::move(refused);
    }
    slots_.emplace(description.name, *std::move(slot));
  }
}

SensorRack::~SensorRack() = default;

base::Result<std::shared_ptr<SensorRack::Slot>> SensorRack::MakeSlot(
    model::SensorDescription description) const {
  const std::string where = robot_ + "/" + description.name;
  const sensing::SensorType* type = types_->Find(description.type);
  if (type == nullptr) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "there is no sensor type \"" + description.type + "\"", where);
  }
  if (!std::isfinite(description.update_rate) || description.update_rate < 0 ||
      description.update_rate > 1e6) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the update rate must lie between 0 and 1e6 Hz", where);
  }
  description.type = type->name;
  auto slot = std::make_shared<Slot>();
  auto sensor = type->create(description);
  if (!sensor) return base::Fail(sensor.error());
  slot->sensor = *std::move(sensor);
  slot->period = PeriodOf(description.update_rate);
  slot->description = std::move(description);
  return slot;
}

std::shared_ptr<SensorRack::Slot> SensorRack::Find(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto it = slots_.find(name);
  return it == slots_.end() ? nullptr : it->second;
}

std::vector<model::SensorDescription> SensorRack::Descriptions() const {
  const std::lock_guard lock(mutex_);
  std::vector<model::SensorDescription> descriptions;
  for (const auto& [name, slot] : slots_) descriptions.push_back(slot->description);
  return descriptions;
}

base::Status SensorRack::Create(model::SensorDescription description, int link_count) {
  const std::string name = description.name;
  const std::string where = robot_ + "/" + name;
  if (name.empty() || name.size() > 128 || name.find('/') != std::string::npos) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "a sensor's name has 1 to 128 characters and no \"/\"", where);
  }
  if (description.link < 0 || description.link >= link_count) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "link " + std::to_string(description.link) + " is not there", where);
  }
  if (!geometry::IsFinite(description.link_from_sensor)) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "the mounting pose is not finite", where);
  }
  auto slot = MakeSlot(std::move(description));
  if (!slot) return base::Fail(slot.error());
  (*slot)->created = true;
  (*slot)->open = true;
  const std::lock_guard lock(mutex_);
  if (slots_.size() >= kMaxSensorsPerRobot) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "a robot carries at most 1024 sensors",
                      where);
  }
  if (!slots_.emplace(name, *slot).second) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "a sensor of that name is there already",
                      where);
  }
  return {};
}

base::Status SensorRack::Open(const std::string& name) {
  const auto slot = Find(name);
  if (slot == nullptr) {
    return base::Fail(base::ErrorCode::kNotFound, "the robot has no sensor \"" + name + "\"",
                      robot_);
  }
  if (slot->sensor == nullptr) return base::Fail(slot->refusal);
  const std::lock_guard lock(mutex_);
  slot->open = true;
  return {};
}

base::Status SensorRack::Close(const std::string& name) {
  const std::lock_guard lock(mutex_);
  const auto it = slots_.find(name);
  if (it == slots_.end()) {
    return base::Fail(base::ErrorCode::kNotFound, "the robot has no sensor \"" + name + "\"",
                      robot_);
  }
  it->second->open = false;
  if (it->second->created) slots_.erase(it);
  return {};
}

void SensorRack::Reset() {
  const std::lock_guard lock(mutex_);
  for (auto it = slots_.begin(); it != slots_.end();) {
    Slot& slot = *it->second;
    slot.open = false;
    {
      const std::lock_guard slot_lock(slot.mutex);
      slot.sampled_at = nullptr;
    }
    it = slot.created ? slots_.erase(it) : std::next(it);
  }
  readings_by_type_.clear();
}

base::Result<sensing::Reading> SensorRack::Read(const std::string& name,
                                                const SamplingSource& source) {
  const auto slot = Find(name);
  if (slot == nullptr) {
    return base::Fail(base::ErrorCode::kNotFound, "the robot has no sensor \"" + name + "\"",
                      robot_);
  }
  if (slot->sensor == nullptr) return base::Fail(slot->refusal);
  auto snapshot = source.history.At(slot->period);
  const std::lock_guard lock(slot->mutex);
  if (slot->sampled_at == snapshot) return slot->newest;
  const int body = snapshot->layout->Find(robot_);
  if (body < 0) return base::Fail(base::ErrorCode::kEnded, "the robot is gone", robot_);
  auto reading = slot->sensor->Sample({snapshot, body, source.seed, source.rays});
  if (!reading) return reading;
  slot->sampled_at = std::move(snapshot);
  slot->newest = *reading;
  return reading;
}

std::vector<std::string> SensorRack::OpenSensors() const {
  const std::lock_guard lock(mutex_);
  std::vector<std::string> names;
  for (const auto& [name, slot] : slots_) {
    if (slot->open) names.push_back(name);
  }
  return names;
}

void SensorRack::CountReading(const std::string& name) {
  const std::lock_guard lock(mutex_);
  const auto it = slots_.find(name);
  if (it != slots_.end()) ++readings_by_type_[it->second->description.type];
}

std::map<std::string, std::uint64_t> SensorRack::readings_by_type() const {
  const std::lock_guard lock(mutex_);
  return readings_by_type_;
}

}  // namespace gsv::simulation
