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
  std::string network;              // a radio receives only from radios of the same network
  double frequency = 2.442e9;       // Hz
  double power = 14.5, gain = 2.5;  // dBm, dBi
  double sensitivity = -90;         // the weakest signal that the radio receives, dBm
  double range = 0;                 // m; 0 means no limit other than power and sensitivity
  double path_loss_exponent = 2;    // 2 in free space
  double wall_loss = 10;            // dB for each wall that a signal passes through
  std::size_t inbox = 16;           // maximum number of received messages that are kept
  std::size_t max_size = 1024;      // maximum size of a sent message in bytes
};
using RadioSetupPtr = std::shared_ptr<const RadioSetup>;

// A message with its sender, receiver and content.
struct RadioMessage {
  std::string sender;        // robot
  std::string radio;         // name of the sending sensor
  std::string receiver;      // name of the receiving robot; empty for all
  base::SimTime sent{0};     // simulated time of sending
  std::string content;       // bytes
  std::uint64_t digest = 0;  // hash of all members above, set by WithDigest()
};
using RadioMessagePtr = std::shared_ptr<const RadioMessage>;

// Sets the digest of a message.
RadioMessagePtr WithDigest(RadioMessage message);

// A radio and its position.
struct Antenna {
  RadioSetupPtr setup;
  geometry::Vector3 position;  // world
  // Index of the body that carries the radio; -1 if this body is not in the world.
  int body = -1;
};

// A message that was sent.
struct Transmission {
  RadioMessagePtr message;
  Antenna from;                       // antenna of the sender at the instant of sending
  std::vector<std::string> heard_by;  // names of the robots that received the message
};

}  // namespace gsv::world
