#include "gsv/simulation/mounted_sensor.h"

#include <algorithm>
#include <cmath>

namespace gsv::simulation {
namespace {

base::SimTime PeriodOf(double update_rate) {
  return update_rate > 0 ? base::FromSeconds(1.0 / update_rate) : base::SimTime(0);
}

}  // namespace

base::Result<SensorDesignPtr> MakeSensorDesign(model::SensorDescription description,
                                               const sensing::SensorRegistry& types,
                                               const std::string& where) {
  const sensing::SensorType* type = types.Find(description.type);
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
  auto design = std::make_shared<SensorDesign>();
  auto sensor = type->create(description);
  if (!sensor) return base::Fail(sensor.error());
  design->sensor = *std::move(sensor);
  design->period = PeriodOf(description.update_rate);
  design->description = std::move(description);
  return design;
}

std::shared_ptr<const SensorDesigns::List> SensorDesigns::Of(
    const std::shared_ptr<const model::Model>& model) {
  const std::lock_guard lock(mutex_);
  std::shared_ptr<const List>& known = known_[model];
  if (known != nullptr) return known;
  List designs;
  for (const model::SensorDescription& description : model->sensors) {
    auto design = MakeSensorDesign(description, *types_, model->name + "/" + description.name);
    if (!design) {
      auto refused = std::make_shared<SensorDesign>();
      refused->description = description;
      refused->refusal = design.error();
      design = std::move(refused);
    }
    designs.push_back(*std::move(design));
  }
  std::stable_sort(designs.begin(), designs.end(), [](const auto& a, const auto& b) {
    return a->description.name < b->description.name;
  });
  known = std::make_shared<const List>(std::move(designs));
  return known;
}

base::Result<sensing::Reading> MountedSensor::Read(const sensing::Sampling& sampling) {
  if (design_->sensor == nullptr) return base::Fail(design_->refusal);
  const world::Snapshot& snapshot = *sampling.snapshot();
  const std::lock_guard lock(mutex_);
  if (sampled_step_ == snapshot.state.step && sampled_layout_ == snapshot.layout->version) {
    return newest_;
  }
  auto reading = design_->sensor->Sample(sampling);
  if (!reading) return reading;
  sampled_step_ = snapshot.state.step;
  sampled_layout_ = snapshot.layout->version;
  newest_ = *reading;
  return reading;
}

void MountedSensor::Forget() {
  const std::lock_guard lock(mutex_);
  sampled_step_ = -1;
  newest_ = {};
  readings_ = 0;
}

}  // namespace gsv::simulation
