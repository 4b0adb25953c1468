// What robots have said and heard by radio. It is part of the state: a behaviour can read it.
//
// Sharing  messages, setups and what a radio has heard are immutable; a state that nobody adds to
//          is copied as one pointer.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/hash.h"
#include "gsv/base/sim_time.h"
#include "gsv/geometry/pose.h"

namespace gsv::world {

// What a radio is able to; docs/sensors.md names the parameters.
struct RadioSetup {
  int link = 0;  // of its robot's model
  geometry::Pose link_from_antenna;
  std::string network;              // only radios of one network hear each other
  double frequency = 2.442e9;       // Hz
  double power = 14.5, gain = 2.5;  // dBm, dBi
  double sensitivity = -90;         // dBm: the weakest that it hears
  double range = 0;                 // m; 0: as far as power and sensitivity reach
  double path_loss_exponent = 2;    // 2: free space
  double wall_loss = 10;            // dB for each wall, of what it sends
  std::size_t inbox = 16;           // messages that it keeps
  std::size_t max_size = 1024;      // bytes of a message that it sends
};
using RadioSetupPtr = std::shared_ptr<const RadioSetup>;

struct RadioMessage {
  std::string sender;    // robot
  std::string radio;     // its sensor
  std::string receiver;  // robot; empty: all
  base::SimTime sent{0};
  std::string content;       // bytes
  std::uint64_t digest = 0;  // of all the above, made by Sealed()
};
using RadioMessagePtr = std::shared_ptr<const RadioMessage>;

RadioMessagePtr Sealed(RadioMessage message);

struct HeardMessage {
  RadioMessagePtr message;
  std::uint64_t number = 0;  // counts what this radio has heard, from 1
  double strength = 0;       // dBm
};

// A radio that is switched on.
struct RadioState {
  std::string robot, sensor;
  RadioSetupPtr setup;
  std::uint64_t heard = 0;          // since it was switched on
  std::vector<HeardMessage> inbox;  // the last of them, the oldest first
};
using RadioStatePtr = std::shared_ptr<const RadioState>;

using Radios = std::vector<RadioStatePtr>;  // by robot, then sensor

// Null if that radio is not switched on. `radios` may be null.
const RadioState* FindRadio(const Radios* radios, const std::string& robot,
                            const std::string& sensor);

// A message that went out, and who has heard it, in the order of their names.
struct Transmission {
  RadioMessagePtr message;
  std::vector<std::string> heard_by;
};

void AddToHash(const Radios& radios, base::Hash& hash);

}  // namespace gsv::world
