// A speaker: plays a sound for a given time.
//
// Command     frequency (20 to 20,000 Hz), duration (0 to 3600 s), volume in [0, 1]. The word names
//             the sound: tone, buzz, chirp or noise. A duration of 0 is silence.
// Reading     frequency (Hz), volume, elapsed time (s), remaining time (s); zeros while it is
//             silent. Label: the sound's name, empty while it is silent.
// Parameters  loudness (85 dB re 20 µPa, 1 m away at full volume)
// Message     gsv_msgs/Speaker
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType SpeakerType();

}  // namespace gsv::sensing
