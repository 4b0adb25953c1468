// The messages that a radio has received since it was switched on.
//
// Determinism  The received messages and their order depend on the messages sent since the last
//              step and on the robots' poses. The order in which behaviours ran has no effect. The
//              random numbers of fading and loss are keyed by (seed, robot, radio, message, step).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gsv/sensing/radio_link.h"
#include "gsv/world/device_state.h"
#include "gsv/world/device_step.h"

namespace gsv::sensing {

// A received message.
struct HeardMessage {
  world::RadioMessagePtr message;  // never null
  std::uint64_t number = 0;        // counts the received messages, from 1
  double strength = 0;             // dBm
};

// Errors of the radio channel at the receiver. A value of 0 switches an error off.
struct RadioErrors {
  double fading = 0;            // deviation of each message's strength, dB
  double loss_probability = 0;  // probability that a message is lost although it is strong enough
  // By how much a message must be stronger than the sum of all other robots' messages in the same
  // step, dB; 0: radios do not disturb each other.
  double capture_ratio = 0;
  bool is_none() const { return fading == 0 && loss_probability == 0 && capture_ratio == 0; }
};

// The state of a radio that is switched on.
class RadioState final : public world::DeviceState {
 public:
  RadioState(world::DeviceMount mount, world::RadioSetupPtr setup, const RadioErrors& errors = {})
      : DeviceState(std::move(mount)), setup_(std::move(setup)), errors_(errors) {}

  // The number of messages received since the radio was switched on.
  std::uint64_t heard() const { return heard_; }
  // The latest messages, the oldest first.
  const std::vector<HeardMessage>& inbox() const { return inbox_; }
  const world::RadioSetup& setup() const { return *setup_; }

  void AddToHash(base::Hash& hash) const override;
  // Receives the transmissions of this step at the radio's antenna, and adds the radio to their
  // receivers.
  world::DeviceStatePtr BeforeStep(world::DeviceStep& step) const override;

  // Puts a message into the inbox. If the inbox is full, its oldest message is removed.
  void Hear(const world::RadioMessagePtr& message, double strength);

 private:
  // The strength (dBm) at which each transmission arrives, including fading; nullopt if it does not
  // arrive. The radio's own transmissions do not arrive.
  std::vector<std::optional<double>> Arriving(const world::DeviceStep& step,
                                              const world::Antenna& here) const;
  // Whether a message is lost by chance or because other messages are too strong. `place` is the
  // message's index in step.transmissions.
  bool IsLost(const world::DeviceStep& step, std::size_t place,
              const std::vector<std::optional<double>>& arriving) const;
  // Returns the number of the random stream for a message.
  std::uint64_t StreamOf(const world::RadioMessage& message) const;

  const world::RadioSetupPtr setup_;
  const RadioErrors errors_;         // errors of the channel, at this receiver
  std::uint64_t heard_ = 0;          // see heard()
  std::vector<HeardMessage> inbox_;  // see inbox()
};

// The antenna of a radio; its body is -1 if the robot is not in the world.
world::Antenna AntennaOf(const world::Snapshot& now, const world::DeviceMount& mount,
                         world::RadioSetupPtr setup);

}  // namespace gsv::sensing
