#include "gsv/simulation/world/attachments.h"

#include <algorithm>

#include "gsv/base/check.h"

namespace gsv::simulation {
namespace {

using dynamics::Attachment;

// Returns the attachments of devices in `state`, ordered by robot and then by device.
std::vector<Attachment> HeldIn(const world::Layout& layout, const world::State& state) {
  std::vector<Attachment> held;
  if (state.devices == nullptr) return held;
  for (const world::DeviceStatePtr& device : *state.devices) {
    const world::Grasp* const grasp = device->grasp();
    if (grasp == nullptr) continue;
    held.push_back({layout.Find(device->robot()), device->mount().link, layout.Find(grasp->held),
                    grasp->link_from_held});
  }
  return held;
}

bool Contains(const std::vector<Attachment>& attachments, const Attachment& wanted) {
  return std::any_of(attachments.begin(), attachments.end(), [&](const Attachment& each) {
    return each.held_body == wanted.held_body && each.holder_body == wanted.holder_body &&
           each.holder_link == wanted.holder_link && each.link_from_held == wanted.link_from_held;
  });
}

}  // namespace

base::Status Attachments::SetLayout(const std::shared_ptr<const world::Layout>& layout,
                                    const world::State& state, dynamics::Engine& engine) {
  attached_.clear();
  if (auto ok = engine.SetLayout(layout); !ok) return ok;
  Follow(*layout, state, engine);
  return {};
}

void Attachments::Follow(const world::Layout& layout, const world::State& state,
                         dynamics::Engine& engine) {
  if (state.devices == nullptr && attached_.empty()) return;
  std::vector<Attachment> held = HeldIn(layout, state);
  for (const Attachment& each : attached_) {
    if (!Contains(held, each)) engine.Detach(each.held_body);
  }
  for (const Attachment& each : held) {
    // A gripper grasps only dynamic bodies, and a body can be attached to only one gripper. So
    // attaching succeeds.
    if (!Contains(attached_, each)) GSV_CHECK(engine.Attach(each, state));
  }
  attached_ = std::move(held);
}

}  // namespace gsv::simulation
