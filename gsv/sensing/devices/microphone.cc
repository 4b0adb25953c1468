#include "gsv/sensing/devices/microphone.h"

#include <algorithm>
#include <cmath>

#include "gsv/messages/gsv_msgs.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

constexpr double kMinSourceDistance = 0.1;  // m

double Power(double level) { return std::pow(10, level / 10); }

// The level in dB at `point`; nullopt if the robot of the source is not in the world.
std::optional<double> LevelAt(const geometry::Vector3& point, const world::DeviceMount& source,
                              const world::Sound& sound, const world::Snapshot& snapshot) {
  const int body = snapshot.layout->Find(source.robot);
  if (body < 0) return std::nullopt;
  const geometry::Pose world_from_source =
      world::LinkPose(snapshot, body, source.link) * source.link_from_device;
  const double distance = std::max(kMinSourceDistance, Norm(world_from_source.position - point));
  return sound.loudness + 20 * std::log10(sound.volume / distance);
}

class Microphone final : public SensorOf<readings::Microphone, messages::gsv_msgs::Microphone> {
 public:
  Microphone(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description),
        ambient_(reader.Number("ambient", 30, -100, 200)),
        noise_(ReadNoise(reader, "noise", 200)) {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const world::Snapshot& snapshot = *sampling.snapshot();
    const geometry::Vector3 here = sampling.WorldFromSensor(description()).position;
    double power = Power(ambient_), loudest = ambient_, frequency = 0;
    std::string source;
    static const world::DeviceStates kNone;
    const auto& devices = snapshot.state.devices;
    for (const world::DeviceStatePtr& each : devices != nullptr ? *devices : kNone) {
      const auto sound = each->SoundAt(snapshot.state.time);
      if (!sound) continue;
      const auto level = LevelAt(here, each->mount(), *sound, snapshot);
      if (!level) continue;
      power += Power(*level);
      if (*level <= loudest) continue;
      loudest = *level;
      frequency = sound->frequency;
      source = each->robot() + "/" + each->device();
    }
    const NoisyReading noisy(sampling, description());
    Reading reading = sampling.Stamped();
    Fill(Values{.level = noisy.Read(noise_, 0, 10 * std::log10(power)),
                .frequency = frequency,
                .source = source},
         reading);
    return reading;
  }

 private:
  Message ToMessage(const Values& heard, const Reading&, const std::string&) const override {
    Message message;
    message.level_db = heard.level;
    message.frequency_hz = heard.frequency;
    message.source = heard.source;
    return message;
  }

  const double ambient_;
  const NoiseModel noise_;
};

}  // namespace

SensorType MicrophoneType() { return MakeSensorType<Microphone>(readings::Microphone::kType); }

}  // namespace gsv::sensing
