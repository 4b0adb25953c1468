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

world::SpeakerSetup ReadSpeaker(ParameterReader& reader) {
  world::SpeakerSetup speaker;
  speaker.loudness = reader.Number("loudness", speaker.loudness, 0, 200);
  return speaker;
}

class Speaker final : public Actuator {
 public:
  Speaker(const model::SensorDescription& description, ParameterReader& reader)
      : Actuator(description, ReadSpeaker(reader)) {}

  base::Status Check(const world::ActuatorOrder& order) const override {
    if (auto ok = CheckShape(order, 3); !ok) return ok;
    if (auto ok = CheckRange("frequency", order.values[0], 20, 20'000); !ok) return ok;
    if (auto ok = CheckRange("duration", order.values[1], 0, 3600); !ok) return ok;
    if (auto ok = CheckRange("volume", order.values[2], 0, 1); !ok) return ok;
    if (std::find(kSounds.begin(), kSounds.end(), order.word) == kSounds.end()) {
      return Refuse(fmt::format("there is no sound \"{}\"; there are {}", order.word.substr(0, 64),
                                fmt::join(kSounds, ", ")));
    }
    return {};
  }

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    const world::ActuatorState* const state = StateIn(sampling);
    const auto sound =
        state != nullptr ? world::SoundOf(*state, sampling.snapshot()->state.time) : std::nullopt;
    const world::Sound now = sound.value_or(world::Sound());
    Reading reading = sampling.Stamped();
    reading.values = {now.frequency, now.volume, now.elapsed, now.left};
    reading.labels = std::make_shared<const std::vector<std::string>>(1, now.name);
    return reading;
  }

  static messages::gsv_msgs::Speaker ToMessage(const model::SensorDescription& description,
                                               const Reading& reading, const std::string&) {
    messages::gsv_msgs::Speaker message;
    if (reading.values.size() != 4) return message;
    ParameterReader reader(description);
    message.sound = reading.labels->front();
    message.frequency_hz = reading.values[0];
    message.volume = reading.values[1];
    message.elapsed_s = reading.values[2];
    message.left_s = reading.values[3];
    message.loudness_db = ReadSpeaker(reader).loudness;
    return message;
  }
};

}  // namespace

SensorType SpeakerType() {
  return MakeSensorType<Speaker, messages::gsv_msgs::Speaker>("speaker", {"buzzer"});
}

}  // namespace gsv::sensing
