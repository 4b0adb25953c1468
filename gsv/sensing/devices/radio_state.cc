#include "gsv/sensing/devices/radio_state.h"

#include <cmath>
#include <memory>
#include <utility>

#include "gsv/base/random.h"

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

std::uint64_t RadioState::StreamOf(const world::RadioMessage& message) const {
  return base::StableId(robot() + "/" + device()) ^ message.digest;
}

std::vector<std::optional<double>> RadioState::Arriving(const world::DeviceStep& step,
                                                        const world::Antenna& here) const {
  std::vector<std::optional<double>> arriving;
  for (const world::Transmission& sent : step.transmissions) {
    arriving.emplace_back();
    if (sent.from.body < 0 || sent.message->sender == robot()) continue;
    if (errors_.fading == 0) {
      arriving.back() = HeardAt(sent.from, here, step.rays);
      continue;
    }
    // Fading may amplify a message. So a message is also considered if it would be too weak without
    // fading.
    world::RadioSetup keen = *setup_;
    keen.sensitivity = -300;
    world::Antenna there = here;
    there.setup = std::make_shared<const world::RadioSetup>(std::move(keen));
    arriving.back() = HeardAt(sent.from, there, step.rays);
    if (!arriving.back()) continue;
    base::Noise noise(step.seed, StreamOf(*sent.message),
                      static_cast<std::uint64_t>(step.now->state.step));
    *arriving.back() += errors_.fading * noise.Gaussian();
    if (*arriving.back() < setup_->sensitivity) arriving.back().reset();
  }
  return arriving;
}

bool RadioState::IsLost(const world::DeviceStep& step, std::size_t place,
                        const std::vector<std::optional<double>>& arriving) const {
  const world::RadioMessage& message = *step.transmissions[place].message;
  if (errors_.loss_probability > 0) {
    base::Noise noise(step.seed, StreamOf(message) + 1,
                      static_cast<std::uint64_t>(step.now->state.step));
    if (noise.Uniform() < errors_.loss_probability) return true;
  }
  if (errors_.capture_ratio == 0) return false;
  double others = 0;  // power of the messages of other senders, mW
  for (std::size_t i = 0; i < arriving.size(); ++i) {
    if (!arriving[i] || step.transmissions[i].message->sender == message.sender) continue;
    others += std::pow(10, *arriving[i] / 10);
  }
  return others > 0 && *arriving[place] < 10 * std::log10(others) + errors_.capture_ratio;
}

world::DeviceStatePtr RadioState::BeforeStep(world::DeviceStep& step) const {
  if (step.transmissions.empty()) return nullptr;
  const world::Antenna here = AntennaOf(*step.now, mount(), setup_);
  if (here.body < 0) return nullptr;
  // The strength of each transmission. Needed only if one of the radio's errors is on.
  std::vector<std::optional<double>> arriving;
  if (!errors_.is_none()) arriving = Arriving(step, here);
  std::shared_ptr<RadioState> changed;  // null until the radio receives a message
  for (std::size_t i = 0; i < step.transmissions.size(); ++i) {
    world::Transmission& sent = step.transmissions[i];
    const world::RadioMessage& message = *sent.message;
    if (sent.from.body < 0 || message.sender == robot()) continue;
    if (!message.receiver.empty() && message.receiver != robot()) continue;
    const auto strength = arriving.empty() ? HeardAt(sent.from, here, step.rays) : arriving[i];
    if (!strength || (!arriving.empty() && IsLost(step, i, arriving))) continue;
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
