// The sensor type "microphone": the sound level at the sensor, and the loudest source.
//
// Model       Each speaker is an omnidirectional point source. Its level falls by 20 dB for ten
//             times the distance (inverse-square law), and is constant nearer than 0.1 m. Sounds
//             and ambient noise add as powers. There are no walls, echoes or delays.
// Reading     level (dB re 20 µPa) of all sounds and the ambient noise, and frequency (Hz) of the
//             loudest sound. The frequency is 0 if no sound is louder than the ambient noise.
//             Label: the source of the loudest sound as ROBOT/SPEAKER, or empty.
// Parameters  (with their default values)
//   ambient (30 dB)         level of the ambient noise
//   noise (dB)              noise of the measured level, see noise.h
// Message     gsv_msgs/Microphone
#pragma once

#include "gsv/sensing/registry.h"

namespace gsv::sensing {

SensorType MicrophoneType();

}  // namespace gsv::sensing
