// The messages that a radio has received since it was switched on.
//
// Determinism  The received messages and their order depend on the messages sent since the last step
//              and on the poses of the robots, not on the order in which behaviours ran. The random
//              numbers of fading and loss are keyed by (seed, robot, radio, message, step).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "gsv/sensing/radio_link.h"
#include "gsv/world/device_state.h"
#include "gsv/world/device_step.h"

namespace gsv::sensing {

struct HeardMessage {
  world::RadioMessagePtr message;
  std::uint64_t number = 0;  // counts what this radio has heard, from 1
  double strength = 0;       // dBm
};

// Errors of the radio channel, at the receiver. All 0: none.
struct RadioErrors {
  double fading = 0;            // dB: deviation of each message's strength
  double loss_probability = 0;  // of a message that is strong enough
  double capture_ratio = 0;     // dB above all else that is sent in the same step; 0: radios do not
                                // disturb each other
  bool is_none() const { return fading == 0 && loss_probability == 0 && capture_ratio == 0; }
};

class RadioState final : public world::DeviceState {
 public:
  RadioState(world::DeviceMount mount, world::RadioSetupPtr setup, const RadioErrors& errors = {})
      : DeviceState(std::move(mount)), setup_(std::move(setup)), errors_(errors) {}

  std::uint64_t heard() const { return heard_; }                     // since it was switched on
  const std::vector<HeardMessage>& inbox() const { return inbox_; }  // the last, oldest first
  const world::RadioSetup& setup() const { return *setup_; }

  void AddToHash(base::Hash& hash) const override;
  // Hears what this step's transmissions bring to its antenna, and enters itself there.
  world::DeviceStatePtr BeforeStep(world::DeviceStep& step) const override;

  // Puts a message into the inbox; the oldest goes where there is no room.
  void Hear(const world::RadioMessagePtr& message, double strength);

 private:
  // The strength (dBm) at which each transmission arrives, as it fades; nothing of those that do not
  // arrive. Own ones do not.
  std::vector<std::optional<double>> Arriving(const world::DeviceStep& step,
                                              const world::Antenna& here) const;
  bool IsLost(const world::DeviceStep& step, std::size_t place,
              const std::vector<std::optional<double>>& arriving) const;
  std::uint64_t StreamOf(const world::RadioMessage& message) const;

  const world::RadioSetupPtr setup_;
  const RadioErrors errors_;
  std::uint64_t heard_ = 0;
  std::vector<HeardMessage> inbox_;
};

// The antenna of a radio; its body is -1 if the robot is not in the world.
world::Antenna AntennaOf(const world::Snapshot& now, const world::DeviceMount& mount,
                         world::RadioSetupPtr setup);

}  // namespace gsv::sensing
