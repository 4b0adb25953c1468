// What a radio has heard since it was switched on.
//
// Determinism  what is heard, and in which order, depends on who sent what since the last step and
//              where the robots stand, and not on the order in which behaviours ran.
#pragma once

#include <cstdint>
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

class RadioState final : public world::DeviceState {
 public:
  RadioState(world::DeviceMount mount, world::RadioSetupPtr setup)
      : DeviceState(std::move(mount)), setup_(std::move(setup)) {}

  std::uint64_t heard() const { return heard_; }                     // since it was switched on
  const std::vector<HeardMessage>& inbox() const { return inbox_; }  // the last, oldest first
  const world::RadioSetup& setup() const { return *setup_; }

  void AddToHash(base::Hash& hash) const override;
  // Hears what this step's transmissions bring to its antenna, and enters itself there.
  world::DeviceStatePtr BeforeStep(world::DeviceStep& step) const override;

  // Puts a message into the inbox; the oldest goes where there is no room.
  void Hear(const world::RadioMessagePtr& message, double strength);

 private:
  const world::RadioSetupPtr setup_;
  std::uint64_t heard_ = 0;
  std::vector<HeardMessage> inbox_;
};

// The antenna of a radio; its body is -1 if the robot does not stand in the world.
world::Antenna AntennaOf(const world::Snapshot& now, const world::DeviceMount& mount,
                         world::RadioSetupPtr setup);

}  // namespace gsv::sensing
