#include "gsv/sensing/devices/speaker.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "gsv/messages/gsv_msgs.h"
#include "gsv/sensing/actuator.h"
#include "gsv/sensing/sensor_type.h"

namespace gsv::sensing {
namespace {

constexpr std::array<std::string_view, 4> kSounds = {"tone", "buzz", "chirp", "noise"};

double ReadLoudness(ParameterReader& reader) { return reader.Number("loudness", 85, 0, 200); }

// A command has the frequency (Hz), the duration (s) and the volume in [0, 1]. Its word names the
// sound.
class SpeakerState final : public world::ActuatorState {
 public:
  SpeakerState(world::DeviceMount mount, world::FollowedCommand followed, double loudness)
      : ActuatorState(std::move(mount), std::move(followed)), loudness_(loudness) {}

  std::optional<world::Sound> SoundAt(base::SimTime now) const override {
    const std::vector<double>& v = values();
    const double elapsed = base::ToSeconds(now - since());
    if (elapsed >= v[1] || v[2] <= 0) return std::nullopt;
    return world::Sound{word(), v[0], v[2], elapsed, v[1] - elapsed, loudness_};
  }

 private:
  const double loudness_;  // dB
};

class Speaker final : public SensorOf<readings::Speaker, messages::gsv_msgs::Speaker, Actuator> {
 public:
  Speaker(const model::SensorDescription& description, ParameterReader& reader)
      : SensorOf(description), loudness_(ReadLoudness(reader)) {}

  base::Status Check(const world::DeviceCommand& command) const override {
    if (auto ok = CheckShape(command, 3); !ok) return ok;
    if (auto ok = CheckRange("frequency", command.values[0], 20, 20'000); !ok) return ok;
    if (auto ok = CheckRange("duration", command.values[1], 0, 3600); !ok) return ok;
    if (auto ok = CheckRange("volume", command.values[2], 0, 1); !ok) return ok;
    if (std::find(kSounds.begin(), kSounds.end(), command.word) == kSounds.end()) {
      return Refuse(fmt::format("there is no sound \"{}\"; the sounds are {}",
                                command.word.substr(0, 64), fmt::join(kSounds, ", ")));
    }
    return {};
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const world::DeviceState* const state = StateIn(sampling);
    const auto sound =
        state != nullptr ? state->SoundAt(sampling.snapshot()->state.time) : std::nullopt;
    const world::Sound now = sound.value_or(world::Sound());
    Reading reading = sampling.Stamped();
    Fill(Values{.name = now.name,
                .frequency = now.frequency,
                .volume = now.volume,
                .elapsed = now.elapsed,
                .left = now.left},
         reading);
    return reading;
  }

 private:
  Message ToMessage(const Values& now, const Reading&, const std::string&) const override {
    Message message;
    message.sound = now.name;
    message.frequency_hz = now.frequency;
    message.volume = now.volume;
    message.elapsed_s = now.elapsed;
    message.left_s = now.left;
    message.loudness_db = loudness_;
    return message;
  }

  world::DeviceStatePtr Follow(world::DeviceMount mount, world::FollowedCommand followed,
                               const world::DeviceState*) const override {
    return std::make_shared<const SpeakerState>(std::move(mount), std::move(followed), loudness_);
  }

  const double loudness_;  // dB
};

}  // namespace

SensorType SpeakerType() { return MakeSensorType<Speaker>(readings::Speaker::kType, {"buzzer"}); }

}  // namespace gsv::sensing
