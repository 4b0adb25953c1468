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

struct Colour {
  double red = 1, green = 1, blue = 1;
};

// A lamp, or an LED.
class Lamp : public Sensor {
 public:
  static constexpr const char* kType = "lamp";
  using Sensor::Sensor;

  struct Glow {
    double brightness = 0;  // 0: off
    Colour colour;
  };

  base::Status Shine(const Colour& colour, double brightness = 1) {
    return port().Act({brightness, colour.red, colour.green, colour.blue}, {});
  }
  base::Status SwitchOff() { return Shine({}, 0); }
  Glow Look();
};

class Gripper : public Sensor {
 public:
  static constexpr const char* kType = "gripper";
  using Sensor::Sensor;

  struct Jaws {
    double opening = 0;  // m
    bool told_to_open = false;
    std::string held;  // a body; empty: nothing
  };

  // Closes, on what is loose and between the jaws: that is held until they open.
  base::Status Grip() { return port().Act({0}, {}); }
  base::Status LetGo() { return port().Act({1}, {}); }
  Jaws Feel();
};

class Speaker : public Sensor {
 public:
  static constexpr const char* kType = "speaker";
  using Sensor::Sensor;

  struct Sound {
    std::string name;  // empty: it is silent
    double frequency = 0, volume = 0;
    double elapsed = 0, left = 0;  // s
  };

  // "tone", "buzz", "chirp" or "noise".
  base::Status Play(const std::string& sound, double frequency, double duration,
                    double volume = 1) {
    return port().Act({frequency, duration, volume}, sound);
  }
  base::Status Beep(double frequency = 880, double duration = 0.2) {
    return Play("tone", frequency, duration);
  }
  base::Status Silence() { return Play("tone", 20, 0, 0); }
  Sound Playing();
};

class Microphone : public Sensor {
 public:
  static constexpr const char* kType = "microphone";
  using Sensor::Sensor;

  struct Hearing {
    double level = 0;      // dB re 20 uPa, of all that sounds
    double frequency = 0;  // of the loudest; 0: none is louder than the noise of the place
    std::string source;    // ROBOT/SPEAKER of that
  };
  Hearing Listen();
};

}  // namespace gsv
