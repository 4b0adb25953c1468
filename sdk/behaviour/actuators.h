// The actuators of a robot besides its base and joints. Behaviours open and create them like
// sensors (robot.Open<Lamp>("lamp")). The readings of an actuator report its state.
//
// Units    metres, seconds, Hz; values without unit lie in [0, 1].
// Errors   a command that is refused returns an error and changes nothing. After the end of the
//          run, every command is refused, and readings are zero.
// Time     a command is applied from the instant at which it is given until the next command.
// Threads  as Robot.
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

  // The colour and brightness that the lamp has now.
  using Glow = readings::Lamp;

  // Sets the colour and the brightness.
  base::Status Set(const Colour& colour, double brightness = 1) {
    return port().CommandDevice({brightness, colour.red, colour.green, colour.blue}, {});
  }
  base::Status SwitchOff() { return Set({}, 0); }
  [[deprecated("use Set()")]] base::Status Shine(const Colour& colour, double brightness = 1) {
    return Set(colour, brightness);
  }
  // Returns the present colour and brightness.
  Glow Read();
  [[deprecated("use Read()")]] Glow Look() { return Read(); }
};

// Two fingers that grasp a body.
class Gripper : public Sensor {
 public:
  static constexpr const char* kType = readings::Gripper::kType;
  using Sensor::Sensor;

  using State = readings::Gripper;
  using Jaws [[deprecated("use State")]] = State;

  // Closes the fingers. A dynamic body between the fingers is attached to them until they open.
  base::Status Grasp() { return port().CommandDevice({0}, {}); }
  // Opens the fingers and detaches the body.
  base::Status Open() { return port().CommandDevice({1}, {}); }
  // Returns the present state of the fingers.
  State Read();
  [[deprecated("use Grasp()")]] base::Status Grip() { return Grasp(); }
  [[deprecated("use Open()")]] base::Status LetGo() { return Open(); }
  [[deprecated("use Read()")]] State Feel() { return Read(); }
};

// Plays sounds, which microphones hear.
class Speaker : public Sensor {
 public:
  static constexpr const char* kType = readings::Speaker::kType;
  using Sensor::Sensor;

  using Sound = readings::Speaker;

  // Plays a sound: "tone", "buzz", "chirp" or "noise". Frequency in Hz, duration in s, volume in
  // [0, 1].
  base::Status Play(const std::string& sound, double frequency, double duration,
                    double volume = 1) {
    return port().CommandDevice({frequency, duration, volume}, sound);
  }
  // Plays a tone. Frequency in Hz, duration in s.
  base::Status Beep(double frequency = 880, double duration = 0.2) {
    return Play("tone", frequency, duration);
  }
  // Ends the present sound.
  base::Status Silence() { return Play("tone", 20, 0, 0); }
  // Returns the sound that is being played.
  Sound Playing();
};

// Measures the sound level at its place, and the loudest sound.
class Microphone : public Sensor {
 public:
  static constexpr const char* kType = readings::Microphone::kType;
  using Sensor::Sensor;

  // The loudest sound, and the sound level.
  using Hearing = readings::Microphone;
  // Returns the loudest sound, and the sound level.
  Hearing Listen();
};

}  // namespace gsv
