#include "gsv/sensing/devices/sonar.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "gsv/base/mutex.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/devices/sound_cone.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;

struct SonarSettings {
  double min = 0, max = 5;
  double field_of_view = 0.26;
  std::optional<SoundSettings> sound;  // set if the beam is a cone
  NoiseModel noise;
};

SonarSettings ReadSonarSettings(ParameterReader& reader) {
  SonarSettings settings;
  settings.min = reader.Number("min", settings.min, 0, 1e4);
  settings.max = reader.Number("max", settings.max, 1e-3, 1e4);
  const double radius = reader.Number("radius", 0, 0, 1e4);
  if (radius > 0) settings.field_of_view = 2 * std::atan(radius / settings.max);
  settings.field_of_view =
      reader.Number("field_of_view", settings.field_of_view, 0, std::numbers::pi);
  if (settings.min > settings.max) {
    reader.Refuse(fmt::format("min ({}) is larger than max ({})", settings.min, settings.max));
  }
  settings.noise = ReadNoise(reader, "noise", 1e3);
  const std::string beam = reader.Text("beam", "ray");
  if (beam == "cone") {
    settings.sound = ReadSound(reader);
  } else if (beam != "ray") {
    reader.Refuse(fmt::format("beam is \"{}\"; it must be ray or cone", beam));
  }
  return settings;
}

class Sonar final : public SensorOf<readings::Sonar, messages::sensor_msgs::Range> {
 public:
  Sonar(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description), settings_(ReadSonarSettings(reader)) {
    if (settings_.sound && reader.status()) cone_.emplace(*settings_.sound);
    if (!settings_.sound && settings_.noise.is_none()) beam_ = {settings_.min, settings_.max};
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const geometry::Pose world_from_sonar = sampling.WorldFromSensor(description());
    double echo = Echo(sampling, world_from_sonar);  // infinite if there is no echo
    if (!settings_.noise.is_none() && std::isfinite(echo)) {
      echo = NoisyReading(sampling, description()).Read(settings_.noise, 0, echo);
    }
    base::Result<Reading> reading = sampling.Stamped();
    Fill(Values{Beam{settings_.min, settings_.max}.ValueOf(echo)}, *reading);
    return reading;
  }

  bool CastsRays() const override { return true; }
  const Beam* beam() const override { return beam_ ? &*beam_ : nullptr; }

 private:
  double Echo(const Sampling& sampling, const geometry::Pose& world_from_sonar) const {
    if (cone_) {
      return cone_->NearestEcho(sampling, world_from_sonar, settings_.max, Others(sampling));
    }
    return sampling.Range({world_from_sonar.position,
                           world_from_sonar.orientation * Vector3{1, 0, 0}, settings_.max});
  }

  // Returns the sonars of the robot's model that fire at the same time.
  std::vector<SoundCone::Sender> Others(const Sampling& sampling) const {
    std::vector<SoundCone::Sender> others;
    if (settings_.sound->firing_slot == 0) return others;
    const std::shared_ptr<const model::Model>& model = sampling.robot().model;
    const base::MutexLock lock(mutex_);
    if (others_of_ != model) FindOthers(model);
    for (const auto& [place, sound] : others_) {
      others.push_back({sampling.WorldFromSensor(model->sensors[place]), sound});
    }
    return others;
  }

  void FindOthers(const std::shared_ptr<const model::Model>& model) const GSV_REQUIRES(mutex_) {
    others_.clear();
    for (std::size_t i = 0; i < model->sensors.size(); ++i) {
      const model::SensorDescription& other = model->sensors[i];
      if (other.type != readings::Sonar::kType || other.name == description().name) continue;
      const auto whole = WithPreset(readings::Sonar::kType, other);
      if (!whole) continue;
      ParameterReader reader(*whole);
      const SoundSettings sound = ReadSound(reader);
      if (sound.firing_slot == settings_.sound->firing_slot) others_.emplace_back(i, sound);
    }
    others_of_ = model;
  }

  Message ToMessage(const Values& sonar, const Reading&, const std::string&) const override {
    Message message;
    message.radiation_type = Message::kUltrasound;
    message.field_of_view = static_cast<float>(settings_.field_of_view);
    message.min_range = static_cast<float>(settings_.min);
    message.max_range = static_cast<float>(settings_.max);
    message.range = static_cast<float>(sonar.range);
    return message;
  }

  std::vector<Segment> BeamsOf(const Values& sonar) const override {
    return {{{}, {sonar.range, 0, 0}}};
  }

  const SonarSettings settings_;
  std::optional<SoundCone> cone_;
  std::optional<Beam> beam_;  // set if a reading contains nothing but the value of this beam
  mutable base::Mutex mutex_;
  // Cache: the other sonars of the model others_of_ that fire at the same time, each with its index
  // in the model's sensors.
  mutable std::shared_ptr<const model::Model> others_of_ GSV_GUARDED_BY(mutex_);
  mutable std::vector<std::pair<std::size_t, SoundSettings>> others_ GSV_GUARDED_BY(mutex_);
};

}  // namespace

SensorType SonarType() {
  return MakeSensorType<Sonar>(readings::Sonar::kType, {}, Overlay::kLines);
}

}  // namespace gsv::sensing
