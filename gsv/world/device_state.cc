#include "gsv/world/device_state.h"

#include <algorithm>
#include <utility>

namespace gsv::world {
namespace {

using Key = std::pair<std::string_view, std::string_view>;

Key KeyOf(const DeviceState& state) { return {state.robot(), state.device()}; }

}  // namespace

std::size_t PlaceOf(const DeviceStates& devices, std::string_view robot, std::string_view device) {
  const auto place = std::lower_bound(
      devices.begin(), devices.end(), Key(robot, device),
      [](const DeviceStatePtr& state, const Key& key) { return KeyOf(*state) < key; });
  return static_cast<std::size_t>(place - devices.begin());
}

const DeviceState* FindDevice(const DeviceStates* devices, std::string_view robot,
                              std::string_view device) {
  if (devices == nullptr) return nullptr;
  const std::size_t place = PlaceOf(*devices, robot, device);
  const bool is_there = place < devices->size() && KeyOf(*(*devices)[place]) == Key(robot, device);
  return is_there ? (*devices)[place].get() : nullptr;
}

void AddToHash(const DeviceStates& devices, base::Hash& hash) {
  for (const bool follows : {false, true}) {
    for (const DeviceStatePtr& state : devices) {
      if ((state->followed() != nullptr) == follows) state->AddToHash(hash);
    }
  }
}

}  // namespace gsv::world
