#include "gsv/simulation/robots/mounted_sensor.h"

#include <cmath>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "gsv/base/sorting.h"
#include "gsv/sensing/presets.h"

namespace gsv::simulation {
namespace {

// The maximum number of samples whose latency has not passed. Each of them keeps a snapshot of the
// whole world.
constexpr double kMaxUnderWay = 100;

// Reads the parameter `latency` (s, default 0), which sensors of all types have.
base::Result<Cadence> CadenceOf(const model::SensorDescription& description,
                                const std::string& where) {
  const auto refuse = [&](std::string sentence) {
    return base::Fail(base::ErrorCode::kInvalidArgument, std::move(sentence), where);
  };
  const double rate = description.update_rate;
  if (!std::isfinite(rate) || (rate != 0 && (rate < 1e-6 || rate > 1e6))) {
    return refuse(
        fmt::format("the update rate is {} Hz; it must be 0 or lie between 1e-6 and 1e6 Hz", rate));
  }
  const double latency = model::NumberOr(description.parameters, "latency", 0);
  if (!(latency >= 0 && latency <= 10)) {
    return refuse(fmt::format("the latency is {} s; it must lie between 0 and 10 s", latency));
  }
  if (latency > 0 && rate == 0) {
    return refuse("a sensor with a latency needs an update rate; set <update_rate>");
  }
  if (latency * rate > kMaxUnderWay) {
    return refuse(
        fmt::format("the latency is {} s; it must not exceed 100 update periods", latency));
  }
  if (rate == 0) return Cadence{};
  return Cadence{base::FromSeconds(1 / rate), base::FromSeconds(latency)};
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
  const auto cadence = CadenceOf(description, where);
  if (!cadence) return base::Fail(cadence.error());
  description.type = type->name;
  // Readers of the description, such as Sonar::max_range(), need the parameters of the preset.
  auto whole = sensing::WithPreset(type->name, description);
  if (!whole) return base::Fail(whole.error());
  description = *std::move(whole);
  auto design = std::make_shared<SensorDesign>();
  auto sensor = type->create(description);
  if (!sensor) return base::Fail(sensor.error());
  design->sensor = *std::move(sensor);
  design->cadence = *cadence;
  design->description = std::move(description);
  return design;
}

std::shared_ptr<const SensorDesigns::List> SensorDesigns::Of(
    const std::shared_ptr<const model::Model>& model) {
  const base::MutexLock lock(mutex_);
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
  base::Sort(designs, [](const auto& a, const auto& b) {
    return a->description.name < b->description.name;
  });
  known = std::make_shared<const List>(std::move(designs));
  return known;
}

base::Result<sensing::Reading> MountedSensor::Read(const sensing::Sampling& sampling) {
  if (design_->sensor == nullptr) return base::Fail(design_->refusal);
  const base::MutexLock lock(mutex_);
  if (!has_failed_) return SampleOnce(sampling);
  if (silent_since_ == nullptr) {
    return base::Fail(base::ErrorCode::kUnavailable, "the sensor has failed", name());
  }
  const int body = silent_since_->layout->Find(sampling.robot().name);
  if (body < 0)
    return base::Fail(base::ErrorCode::kEnded, "the robot does not exist any more", name());
  return SampleOnce(sampling.At(silent_since_, body));
}

base::Result<sensing::Reading> MountedSensor::Watch(const sensing::Sampling& sampling) {
  {
    const base::MutexLock lock(mutex_);
    ForbidSweeps();
  }
  return Read(sampling);
}

void MountedSensor::Join(std::shared_ptr<Sweeps> sweeps) {
  const base::MutexLock lock(mutex_);
  if (sweeps_ != nullptr) readings_ += sweeps_->count - sweeps_before_;
  if (has_failed_) sweeps->is_allowed = false;
  sweeps_before_ = sweeps->count;
  sweeps_ = std::move(sweeps);
}

void MountedSensor::ForbidSweeps() {
  if (sweeps_ != nullptr) sweeps_->is_allowed.store(false, std::memory_order_relaxed);
}

std::uint64_t MountedSensor::readings() const {
  const base::MutexLock lock(mutex_);
  const std::uint64_t sweeps = sweeps_ != nullptr ? sweeps_->count - sweeps_before_ : 0;
  return readings_.load(std::memory_order_relaxed) + sweeps;
}

base::Result<sensing::Reading> MountedSensor::SampleOnce(const sensing::Sampling& sampling) {
  const world::Snapshot& snapshot = *sampling.snapshot();
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

void MountedSensor::Fail(std::shared_ptr<const world::Snapshot> snapshot) {
  const base::MutexLock lock(mutex_);
  has_failed_ = true;
  ForbidSweeps();
  silent_since_ = std::move(snapshot);
}

void MountedSensor::Forget() {
  const base::MutexLock lock(mutex_);
  ForbidSweeps();  // the behaviour will be initialised again, and will open its sensors again
  sweeps_ = nullptr;
  has_failed_ = false;
  silent_since_ = nullptr;
  sampled_step_ = -1;
  newest_ = {};
  readings_ = 0;
}

}  // namespace gsv::simulation
