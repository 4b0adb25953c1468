#include "gsv/simulation/robots/sensor_rack.h"

#include "gsv/simulation/limits.h"

#include <algorithm>

namespace gsv::simulation {
SensorRack::SensorRack(std::string robot, const std::shared_ptr<const model::Model>& model,
                       SensorDesigns& designs)
    : robot_(std::move(robot)), designs_(designs) {
  const auto of_model = designs.Of(model);
  slots_.reserve(of_model->size());
  for (const SensorDesignPtr& design : *of_model) {
    slots_.push_back({std::make_shared<MountedSensor>(design)});
  }
}

std::size_t SensorRack::PlaceOf(const std::string& name) const {
  const auto place = std::lower_bound(
      slots_.begin(), slots_.end(), name,
      [](const Slot& slot, const std::string& wanted) { return slot.sensor->name() < wanted; });
  return static_cast<std::size_t>(place - slots_.begin());
}

const SensorRack::Slot* SensorRack::FindSlot(const std::string& name) const {
  const std::size_t place = PlaceOf(name);
  const bool is_there = place < slots_.size() && slots_[place].sensor->name() == name;
  return is_there ? &slots_[place] : nullptr;
}

base::Error SensorRack::NoSuchSensor(const std::string& name) const {
  return {base::ErrorCode::kNotFound, "the robot has no sensor \"" + name + "\"", robot_};
}

std::vector<model::SensorDescription> SensorRack::Descriptions() const {
  const base::MutexLock lock(mutex_);
  std::vector<model::SensorDescription> descriptions;
  for (const Slot& slot : slots_) descriptions.push_back(slot.sensor->design().description);
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
                      "link " + std::to_string(description.link) + " does not exist", where);
  }
  if (!geometry::IsFinite(description.link_from_sensor)) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "the mounting pose is not finite", where);
  }
  const auto design = MakeSensorDesign(std::move(description), designs_.types(), where);
  if (!design) return base::Fail(design.error());
  const base::MutexLock lock(mutex_);
  if (const std::size_t most = ProcessLimits().sensors_of_a_robot; slots_.size() >= most) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "a robot carries at most " + std::to_string(most) +
                          " sensors here; close one first, or raise --limit sensors_of_a_robot",
                      where);
  }
  if (FindSlot(name) != nullptr) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "there is already a sensor of this name",
                      where);
  }
  slots_.insert(slots_.begin() + static_cast<std::ptrdiff_t>(PlaceOf(name)),
                {std::make_shared<MountedSensor>(*design), true, true});
  designs_.CountChange();
  return {};
}

base::Status SensorRack::Open(const std::string& name) {
  const base::MutexLock lock(mutex_);
  if (FindSlot(name) == nullptr) return base::Fail(NoSuchSensor(name));
  Slot& slot = slots_[PlaceOf(name)];
  if (slot.sensor->design().sensor == nullptr) return base::Fail(slot.sensor->design().refusal);
  slot.is_open = true;
  return {};
}

base::Status SensorRack::Close(const std::string& name) {
  const base::MutexLock lock(mutex_);
  if (FindSlot(name) == nullptr) return base::Fail(NoSuchSensor(name));
  const auto slot = slots_.begin() + static_cast<std::ptrdiff_t>(PlaceOf(name));
  slot->is_open = false;
  if (!slot->is_created) return {};
  closed_readings_[slot->sensor->design().description.type] += slot->sensor->readings();
  slots_.erase(slot);
  designs_.CountChange();
  return {};
}

void SensorRack::Reset() {
  const base::MutexLock lock(mutex_);
  if (std::erase_if(slots_, [](const Slot& slot) { return slot.is_created; }) > 0) {
    designs_.CountChange();
  }
  for (Slot& slot : slots_) {
    slot.is_open = false;
    slot.sensor->Forget();
  }
  closed_readings_.clear();
}

base::Result<MountedSensorPtr> SensorRack::Find(const std::string& name) const {
  const base::MutexLock lock(mutex_);
  const Slot* slot = FindSlot(name);
  if (slot == nullptr) return base::Fail(NoSuchSensor(name));
  return slot->sensor;
}

std::vector<MountedSensorPtr> SensorRack::OpenSensors() const {
  const base::MutexLock lock(mutex_);
  std::vector<MountedSensorPtr> sensors;
  for (const Slot& slot : slots_) {
    if (slot.is_open) sensors.push_back(slot.sensor);
  }
  return sensors;
}

std::map<std::string, std::uint64_t> SensorRack::readings_by_type() const {
  const base::MutexLock lock(mutex_);
  std::map<std::string, std::uint64_t> readings = closed_readings_;
  for (const Slot& slot : slots_) {
    if (const std::uint64_t count = slot.sensor->readings(); count > 0) {
      readings[slot.sensor->design().description.type] += count;
    }
  }
  return readings;
}

}  // namespace gsv::simulation
