#include "gsv/simulation/editing/carry_over.h"

#include <algorithm>
#include <tuple>

#include "gsv/base/sorting.h"

namespace gsv::simulation {
namespace {

void CarryBody(const world::Layout& old_layout, const world::State& old_state, int old,
               const world::Layout& layout, int now, world::State& state) {
  const world::Body& body = layout.bodies[static_cast<std::size_t>(now)];
  const world::Body& old_body = old_layout.bodies[static_cast<std::size_t>(old)];
  state.bodies[static_cast<std::size_t>(now)] = old_state.bodies[static_cast<std::size_t>(old)];
  const auto carry = [&](const auto& from, auto& to) {
    std::copy_n(from.begin() + old_body.first_joint, body.model->joints.size(),
                to.begin() + body.first_joint);
  };
  carry(old_state.joint_positions, state.joint_positions);
  carry(old_state.joint_velocities, state.joint_velocities);
  if (!state.goals.empty() && !old_state.goals.empty()) {
    state.goals[static_cast<std::size_t>(now)] = old_state.goals[static_cast<std::size_t>(old)];
  }
  if (!old_state.joint_integrals.empty()) {
    state.joint_integrals.resize(static_cast<std::size_t>(layout.joint_count));
    carry(old_state.joint_integrals, state.joint_integrals);
  }
  if (old_state.joint_commands.empty()) return;
  state.joint_commands.resize(static_cast<std::size_t>(layout.joint_count));
  carry(old_state.joint_commands, state.joint_commands);
}

}  // namespace

world::State CarryOver(const world::Layout& old_layout, const world::State& old_state,
                       const world::Layout& layout) {
  world::State state = world::InitialState(layout);
  state.step = old_state.step;
  state.time = old_state.time;
  for (int i = 0; i < static_cast<int>(layout.bodies.size()); ++i) {
    const int old = old_layout.Find(layout.bodies[static_cast<std::size_t>(i)].name);
    if (old >= 0) {
      CarryBody(old_layout, old_state, old, layout, i, state);
    } else {
      state.bodies[static_cast<std::size_t>(i)].since = old_state.time;
    }
  }
  state.devices = old_state.devices;
  return state;
}

world::Snapshot CarryOver(const world::Snapshot& earlier,
                          const std::shared_ptr<const world::Layout>& layout,
                          const world::State& now) {
  const world::Layout& old_layout = *earlier.layout;
  world::Snapshot snapshot;
  snapshot.layout = layout;
  snapshot.state = CarryOver(old_layout, earlier.state, *layout);
  snapshot.step_length = earlier.step_length;
  snapshot.transmissions = earlier.transmissions;
  const bool has_accelerations = !earlier.accelerations.empty();
  if (has_accelerations) snapshot.accelerations.resize(layout->bodies.size());
  const bool has_joint_accelerations = !earlier.joint_accelerations.empty();
  if (has_joint_accelerations) {
    snapshot.joint_accelerations.resize(static_cast<std::size_t>(layout->joint_count));
  }
  for (std::size_t i = 0; i < layout->bodies.size(); ++i) {
    const world::Body& body = layout->bodies[i];
    const int old = old_layout.Find(body.name);
    if (old < 0) {
      snapshot.state.bodies[i] = now.bodies[i];
      continue;
    }
    if (has_accelerations) {
      snapshot.accelerations[i] = earlier.accelerations[static_cast<std::size_t>(old)];
    }
    if (has_joint_accelerations) {
      const world::Body& old_body = old_layout.bodies[static_cast<std::size_t>(old)];
      std::copy_n(earlier.joint_accelerations.begin() + old_body.first_joint,
                  body.model->joints.size(),
                  snapshot.joint_accelerations.begin() + body.first_joint);
    }
  }
  for (const world::Contact& contact : earlier.contacts) {
    const auto index_of = [&](int old) {
      return layout->Find(old_layout.bodies[static_cast<std::size_t>(old)].name);
    };
    world::Contact carried = contact;
    carried.first = index_of(contact.first), carried.second = index_of(contact.second);
    if (carried.first >= 0 && carried.second >= 0) snapshot.contacts.push_back(carried);
  }
  base::Sort(snapshot.contacts, [](const world::Contact& a, const world::Contact& b) {
    return std::tie(a.first, a.second, a.supports) < std::tie(b.first, b.second, b.supports);
  });
  return snapshot;
}

void ForgetMotion(const std::vector<std::string>& bodies, world::Snapshot& snapshot) {
  for (const std::string& name : bodies) {
    const int body = snapshot.layout->Find(name);
    if (body < 0) continue;
    std::erase_if(snapshot.contacts, [&](const world::Contact& contact) {
      return contact.first == body || contact.second == body;
    });
    if (!snapshot.accelerations.empty()) {
      snapshot.accelerations[static_cast<std::size_t>(body)] = {};
    }
    if (snapshot.joint_accelerations.empty()) continue;
    const world::Body& of = snapshot.layout->bodies[static_cast<std::size_t>(body)];
    std::fill_n(snapshot.joint_accelerations.begin() + of.first_joint, of.model->joints.size(),
                0.0);
  }
}

void ResetToInitialPose(const world::Layout& layout, int body, world::State& state) {
  const world::Body& placed = layout.bodies[static_cast<std::size_t>(body)];
  world::BodyState& now = state.bodies[static_cast<std::size_t>(body)];
  now.world_from_model = placed.initial_pose;
  now.linear_velocity = now.angular_velocity = {};
  now.drive.actual = {};
  now.in_contact = false;
  std::fill_n(state.joint_velocities.begin() + placed.first_joint, placed.model->joints.size(),
              0.0);
}

}  // namespace gsv::simulation
