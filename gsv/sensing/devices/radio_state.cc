#include "gsv/sensing/devices/radio_state.h"

#include <memory>
#include <utility>

namespace gsv::sensing {

void RadioState::AddToHash(base::Hash& hash) const {
  hash.Add(std::string_view(robot()));
  hash.Add(std::string_view(device()));
  hash.Add(heard_);
  for (const HeardMessage& heard : inbox_) {
    hash.Add(heard.number);
    hash.Add(heard.strength);
    hash.Add(heard.message->digest);
  }
}

void RadioState::Hear(const world::RadioMessagePtr& message, double strength) {
  if (inbox_.size() >= setup_->inbox) {
    const auto surplus = static_cast<std::ptrdiff_t>(inbox_.size() - setup_->inbox + 1);
    inbox_.erase(inbox_.begin(), inbox_.begin() + surplus);
  }
  inbox_.push_back({message, ++heard_, strength});
}

world::DeviceStatePtr RadioState::BeforeStep(world::DeviceStep& step) const {
  if (step.transmissions.empty()) return nullptr;
  const world::Antenna here = AntennaOf(*step.now, mount(), setup_);
  if (here.body < 0) return nullptr;
  std::shared_ptr<RadioState> changed;  // null until it hears something
  for (world::Transmission& sent : step.transmissions) {
    const world::RadioMessage& message = *sent.message;
    if (sent.from.body < 0 || message.sender == robot()) continue;
    if (!message.receiver.empty() && message.receiver != robot()) continue;
    const auto strength = HeardAt(sent.from, here, step.rays);
    if (!strength) continue;
    if (changed == nullptr) changed = std::make_shared<RadioState>(*this);
    changed->Hear(sent.message, *strength);
    if (sent.heard_by.empty() || sent.heard_by.back() != robot()) sent.heard_by.push_back(robot());
  }
  return changed;
}

world::Antenna AntennaOf(const world::Snapshot& now, const world::DeviceMount& mount,
                         world::RadioSetupPtr setup) {
  const int body = now.layout->Find(mount.robot);
  if (body < 0) return {std::move(setup), {}, -1};
  const geometry::Pose world_from_antenna =
      world::LinkPose(now, body, mount.link) * mount.link_from_device;
  return {std::move(setup), world_from_antenna.position, body};
}

}  // namespace gsv::sensing
