// An actuator type outside of the source tree: a horn, which honks for a time. Microphones hear it.
//
//   cmake -S examples/horn -B /tmp/horn -D GSV_SOURCE_DIR=$PWD -D GSV_BUILD_DIR=$PWD/build/release
//   cmake --build /tmp/horn
//   gsv run WORLD --robot MODEL --sensor-plugin /tmp/horn/gsv-sensor-horn.so
//
// Command     duration of the honk (s, at most 60); 0: silence.
// Reading     remaining duration of the honk (s); 0 while it is silent.
// Parameters  loudness (105 dB re 20 µPa, 1 m away), frequency (420 Hz)
// Message     gsv_msgs/Speaker
#include "gsv/messages/gsv_msgs.h"
#include "gsv/sensing/actuator.h"
#include "gsv/sensing/module.h"
#include "gsv/sensing/sensor_type.h"

namespace {

using namespace gsv;

world::Sound ReadHorn(sensing::ParameterReader& reader) {
  world::Sound sound;
  sound.name = "horn";
  sound.frequency = reader.Number("frequency", 420, 20, 20'000);
  sound.volume = 1;
  sound.loudness = reader.Number("loudness", 105, 0, 200);
  return sound;
}

// The sound of a horn, which follows its command.
class HornState final : public world::ActuatorState {
 public:
  HornState(world::DeviceMount mount, world::FollowedCommand followed, world::Sound sound)
      : ActuatorState(std::move(mount), std::move(followed)), sound_(std::move(sound)) {}

  std::optional<world::Sound> SoundAt(base::SimTime now) const override {
    world::Sound sound = sound_;
    sound.elapsed = base::ToSeconds(now - since());
    sound.left = values()[0] - sound.elapsed;
    return sound.left > 0 ? std::optional(sound) : std::nullopt;
  }

 private:
  const world::Sound sound_;
};

// The layout of a horn's readings.
struct Honk {
  double left = 0;
  static constexpr auto kFields = std::make_tuple(readings::Value("left", "s", &Honk::left));
};

class Horn final : public sensing::SensorOf<Honk, messages::gsv_msgs::Speaker, sensing::Actuator> {
 public:
  Horn(const model::SensorDescription& description, sensing::ParameterReader& reader)
      : SensorOf(description), sound_(ReadHorn(reader)) {}

  base::Status Check(const world::DeviceCommand& command) const override {
    if (auto ok = CheckShape(command, 1); !ok) return ok;
    return CheckRange("duration", command.values[0], 0, 60);
  }

  base::Result<sensing::Reading> Sample(const sensing::Sampling& sampling) const override {
    const world::DeviceState* const state = StateIn(sampling);
    const auto sound =
        state != nullptr ? state->SoundAt(sampling.snapshot()->state.time) : std::nullopt;
    sensing::Reading reading = sampling.Stamped();
    Fill(Honk{sound ? sound->left : 0}, reading);
    return reading;
  }

 private:
  Message ToMessage(const Values& honk, const sensing::Reading&,
                    const std::string&) const override {
    Message message;
    if (honk.left == 0) return message;
    message.sound = sound_.name;
    message.frequency_hz = sound_.frequency;
    message.volume = sound_.volume;
    message.left_s = honk.left;
    message.loudness_db = sound_.loudness;
    return message;
  }

  world::DeviceStatePtr Follow(world::DeviceMount mount, world::FollowedCommand followed,
                               const world::DeviceState*) const override {
    return std::make_shared<const HornState>(std::move(mount), std::move(followed), sound_);
  }

  const world::Sound sound_;
};

base::Status Add(sensing::SensorRegistry& registry) {
  return registry.Add(sensing::MakeSensorType<Horn>("horn"));
}

}  // namespace

GSV_SENSOR_MODULE(Add)
