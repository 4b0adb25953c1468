// The actuators of a robot beside its base and its joints, as its behaviour uses them. They are
// opened and created as sensors are (robot.Open<Lamp>("lamp")), and read: what they do.
//
// Units    metres, seconds, Hz; what has no unit lies in [0, 1].
// Errors   what is refused is said and nothing happens; after the end of the run, too. Readings are
//          then zero.
// Time     a command acts from the instant at which it is given until the next.
// Threads  those of the robot.
#pragma once

#include <string>
#include <vector>

#include "sdk/behaviour/sensors.h"

namespace gsv {

using readings::Colour;

// A lamp, or an LED.
class Lamp : public Sensor {
 public:
  static constexpr const char* kType = readings::Lamp::kType;
  using Sensor::Sensor;

  using Glow = readings::Lamp;

  base::Status Shine(const Colour& colour, double brightness = 1) {
    return port().Act({brightness, colour.red, colour.green, colour.blue}, {});
  }
  base::Status SwitchOff() { return Shine({}, 0); }
  Glow Look() { return MeasureAs<Glow>(); }
};

class Gripper : public Sensor {
 public:
  static constexpr const char* kType = readings::Gripper::kType;
  using Sensor::Sensor;

  using Jaws = readings::Gripper;

  // Closes, on what is loose and between the jaws: that is held until they open.
  base::Status Grip() { return port().Act({0}, {}); }
  base::Status LetGo() { return port().Act({1}, {}); }
  Jaws Feel() { return MeasureAs<Jaws>(); }
};

class Speaker : public Sensor {
 public:
  static constexpr const char* kType = readings::Speaker::kType;
  using Sensor::Sensor;

  using Sound = readings::Speaker;

  // "tone", "buzz", "chirp" or "noise".
  base::Status Play(const std::string& sound, double frequency, double duration,
                    double volume = 1) {
    return port().Act({frequency, duration, volume}, sound);
  }
  base::Status Beep(double frequency = 880, double duration = 0.2) {
    return Play("tone", frequency, duration);
  }
  base::Status Silence() { return Play("tone", 20, 0, 0); }
  Sound Playing() { return MeasureAs<Sound>(); }
};

class Microphone : public Sensor {
 public:
  static constexpr const char* kType = readings::Microphone::kType;
  using Sensor::Sensor;

  using Hearing = readings::Microphone;
  Hearing Listen() { return MeasureAs<Hearing>(); }
};

}  // namespace gsv
