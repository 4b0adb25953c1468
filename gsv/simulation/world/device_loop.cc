#include "gsv/simulation/world/device_loop.h"

#include <algorithm>

namespace gsv::simulation {
namespace {

// Casts rays in a snapshot. The ray scene is built when the first ray is cast.
class SnapshotRays final : public world::RayCaster {
 public:
  SnapshotRays(std::shared_ptr<const world::Snapshot> snapshot, sensing::RaySceneCache& cache,
               base::ThreadTeam* team)
      : snapshot_(std::move(snapshot)), cache_(cache), team_(team) {}

  std::optional<world::Hit> Cast(const world::Ray& ray, int ignored_body) const override {
    if (scene_ == nullptr) scene_ = cache_.At(snapshot_, team_);
    return scene_->Cast(ray, ignored_body);
  }

 private:
  const std::shared_ptr<const world::Snapshot> snapshot_;
  sensing::RaySceneCache& cache_;
  base::ThreadTeam* const team_;
  mutable std::shared_ptr<const sensing::RayScene> scene_;
};

// The device states of a world. Snapshots share them, so they are copied before the first change.
class ChangingDevices {
 public:
  explicit ChangingDevices(world::State& state) : state_(state) {}

  std::size_t size() const { return state_.devices == nullptr ? 0 : state_.devices->size(); }
  const world::DeviceStatePtr& operator[](std::size_t place) const {
    return (*state_.devices)[place];
  }
  void Replace(std::size_t place, world::DeviceStatePtr next) { Own()[place] = std::move(next); }

  // Replaces a device's state by `next`, or removes it if `next` is null.
  void Set(const std::string& robot, const std::string& device, world::DeviceStatePtr next) {
    world::DeviceStates& states = Own();
    const std::size_t place = world::PlaceOf(states, robot, device);
    const auto at = states.begin() + static_cast<std::ptrdiff_t>(place);
    const bool is_there =
        at != states.end() && (*at)->robot() == robot && (*at)->device() == device;
    if (next == nullptr) {
      if (is_there) states.erase(at);
    } else if (is_there) {
      *at = std::move(next);
    } else {
      states.insert(at, std::move(next));
    }
  }
  world::DeviceStatePtr Find(const std::string& robot, const std::string& device) const {
    if (state_.devices == nullptr) return nullptr;
    const std::size_t place = world::PlaceOf(*state_.devices, robot, device);
    if (place == size()) return nullptr;
    const world::DeviceStatePtr& at = (*state_.devices)[place];
    return at->robot() == robot && at->device() == device ? at : nullptr;
  }
  void RemoveIf(const auto& is_unwanted) { std::erase_if(Own(), is_unwanted); }

 private:
  world::DeviceStates& Own() {
    if (own_ == nullptr) {
      own_ = state_.devices == nullptr ? std::make_shared<world::DeviceStates>()
                                       : std::make_shared<world::DeviceStates>(*state_.devices);
      state_.devices = own_;
    }
    return *own_;
  }

  world::State& state_;
  std::shared_ptr<world::DeviceStates> own_;
};

void Apply(const DeviceAction& action, const std::string& robot, world::DeviceStep& step,
           ChangingDevices& devices) {
  const world::DeviceStatePtr before = devices.Find(robot, action.name());
  switch (action.kind) {
    case DeviceAction::Kind::kSwitchOn:
      if (before == nullptr) devices.Set(robot, action.name(), action.device->SwitchedOn(robot));
      return;
    case DeviceAction::Kind::kSwitchOff:
      devices.Set(robot, action.name(), nullptr);
      return;
    case DeviceAction::Kind::kCommand: {
      world::DeviceStatePtr next = action.device->Apply(robot, before, action.command, step);
      if (next != before) devices.Set(robot, action.name(), std::move(next));
      return;
    }
  }
}

}  // namespace

std::vector<world::Transmission> StepDevices(const std::shared_ptr<const world::Snapshot>& now,
                                             base::SimTime length, DeviceActions actions,
                                             sensing::RaySceneCache& rays, base::ThreadTeam* team,
                                             std::uint64_t seed, world::State& state) {
  std::sort(actions.begin(), actions.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<world::Transmission> transmissions;
  const SnapshotRays caster(now, rays, team);
  world::DeviceStep step{now, length, caster, state, transmissions, seed};
  ChangingDevices devices(state);
  for (const auto& [robot, of_robot] : actions) {
    for (const DeviceAction& action : of_robot) Apply(action, robot, step, devices);
  }
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (auto next = devices[i]->BeforeStep(step)) devices.Replace(i, std::move(next));
  }
  return transmissions;
}

void MoveDevices(const world::Layout& layout, base::SimTime time, world::State& state) {
  if (state.devices == nullptr) return;
  for (const world::DeviceStatePtr& device : *state.devices) {
    device->AfterMove(layout, time, state);
  }
}

void CarryOverDevices(const world::Layout& layout, const std::vector<std::string>& placed,
                      world::State& state) {
  if (state.devices == nullptr) return;
  ChangingDevices devices(state);
  devices.RemoveIf(
      [&](const world::DeviceStatePtr& device) { return layout.Find(device->robot()) < 0; });
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (auto next = devices[i]->CarryOver(layout, placed, state.time)) {
      devices.Replace(i, std::move(next));
    }
  }
}

}  // namespace gsv::simulation
