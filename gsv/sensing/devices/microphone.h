// A microphone: how loud it is, and what is loudest.
//
// Model       Each speaker is a point that sounds all around: its level falls by 20 dB for ten
//             times the distance (inverse-square law; nearer than 0.1 m it grows no more). Sounds
//             and the noise of the place add up as powers. Walls do not damp it, there is no echo,
//             and sound takes no time.
// Reading     level (dB re 20 µPa), frequency (Hz) of the loudest sound; 0 when none is louder than
//             the noise of the place. Label: ROBOT/SPEAKER of that, or empty.
// Parameters  ambient (30 dB: the noise of the place), noise (dB, of the level).
// Message     gsv_msgs/Microphone
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType MicrophoneType();

}  // namespace gsv::sensing
