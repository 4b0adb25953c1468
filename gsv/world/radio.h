// Radio messages between robots.
//
// Sharing  messages and setups are immutable.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gsv/base/sim_time.h"
#include "gsv/geometry/pose.h"

namespace gsv::world {

// The parameters of a radio (docs/sensors.md).
struct RadioSetup {
  std::string network;              // only radios of one network receive from each other
  double frequency = 2.442e9;       // Hz
  double power = 14.5, gain = 2.5;  // dBm, dBi
  double sensitivity = -90;         // dBm: the weakest signal that the radio receives
  double range = 0;                 // m; 0: as far as power and sensitivity reach
  double path_loss_exponent = 2;    // 2: free space
  double wall_loss = 10;            // dB for each wall that its signals pass through
  std::size_t inbox = 16;           // number of received messages that it keeps
  std::size_t max_size = 1024;      // maximum size of a sent message in bytes
};
using RadioSetupPtr = std::shared_ptr<const RadioSetup>;

struct RadioMessage {
  std::string sender;    // robot
  std::string radio;     // its sensor
  std::string receiver;  // name of the receiving robot; empty: all
  base::SimTime sent{0};
  std::string content;       // bytes
  std::uint64_t digest = 0;  // digest of all members above, made by Sealed()
};
using RadioMessagePtr = std::shared_ptr<const RadioMessage>;

RadioMessagePtr Sealed(RadioMessage message);

struct Antenna {
  RadioSetupPtr setup;
  geometry::Vector3 position;  // world
  int body = -1;               // index of the carrier; -1: it is not in the world
};

// A sent message.
struct Transmission {
  RadioMessagePtr message;
  Antenna from;
  std::vector<std::string> heard_by;  // names of the robots that received it
};

}  // namespace gsv::world
