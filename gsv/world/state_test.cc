#include "gsv/world/state.h"

#include <functional>

#include <gtest/gtest.h>

namespace gsv::world {
namespace {

std::shared_ptr<const Layout> TwoBodies() {
  auto model = std::make_shared<model::Model>();
  model->links.resize(2);
  model->joints.resize(1);
  model->joints[0].child = 1;
  Body a, b;
  a.name = "alpha", a.model = model;
  b.name = "beta", b.model = model;
  return MakeLayout(1, {b, a}, std::make_shared<model::WorldDescription>());
}

std::uint64_t HashOf(const Layout& layout, const State& state) {
  base::Hash hash;
  AddToHash(layout, state, hash);
  return hash.Digest();
}

TEST(Layout, OrdersBodiesByNameAndNumbersTheirParts) {
  const auto layout = TwoBodies();
  EXPECT_EQ(layout->Find("alpha"), 0);
  EXPECT_EQ(layout->Find("beta"), 1);
  EXPECT_EQ(layout->Find("gamma"), -1);
  EXPECT_EQ(layout->bodies[1].first_link, 2);
  EXPECT_EQ(layout->bodies[1].first_joint, 1);
  EXPECT_EQ(layout->link_count, 4);
}

TEST(AddToHash, DependsOnEveryField) {
  const auto layout = TwoBodies();
  const State state = InitialState(*layout);
  const std::uint64_t before = HashOf(*layout, state);
  const std::vector<std::function<void(State&)>> changes = {
      [](State& s) { ++s.step; },
      [](State& s) { s.time += base::SimTime(1); },
      [](State& s) { s.bodies[0].world_from_model.position.x = 1e-300; },
      [](State& s) { s.bodies[0].world_from_model.position.y = -0.0; },
      [](State& s) { s.bodies[0].world_from_model.position.z = 1; },
      [](State& s) { s.bodies[0].world_from_model.orientation.w = 0.5; },
      [](State& s) { s.bodies[0].world_from_model.orientation.x = 0.5; },
      [](State& s) { s.bodies[0].world_from_model.orientation.y = 0.5; },
      [](State& s) { s.bodies[0].world_from_model.orientation.z = 0.5; },
      [](State& s) { s.bodies[1].linear_velocity.x = 1; },
      [](State& s) { s.bodies[1].linear_velocity.y = 1; },
      [](State& s) { s.bodies[1].linear_velocity.z = 1; },
      [](State& s) { s.bodies[1].angular_velocity.x = 1; },
      [](State& s) { s.bodies[1].angular_velocity.y = 1; },
      [](State& s) { s.bodies[1].angular_velocity.z = 1; },
      [](State& s) { s.bodies[1].drive.command.linear = 1; },
      [](State& s) { s.bodies[1].drive.command.lateral = 1; },
      [](State& s) { s.bodies[1].drive.command.angular = 1; },
      [](State& s) { s.bodies[1].drive.command_time = base::SimTime(1); },
      [](State& s) { s.bodies[1].drive.actual.linear = 1; },
      [](State& s) { s.bodies[1].drive.actual.lateral = 1; },
      [](State& s) { s.bodies[1].drive.actual.angular = 1; },
      [](State& s) { s.bodies[1].distance = 1; },
      [](State& s) { s.bodies[1].collisions = 1; },
      [](State& s) { s.bodies[1].in_contact = true; },
      [](State& s) { s.joint_positions[0] = 1; },
      [](State& s) { s.joint_velocities[1] = 1; },
      [](State& s) {
        s.joint_commands = {{}, {JointCommand::Kind::kEffort, 0}};
      },
      [](State& s) {
        s.joint_commands = {{}, {JointCommand::Kind::kEffort, 1}};
      },
      [](State& s) {
        s.joint_commands = {{}, {JointCommand::Kind::kVelocity, 1}};
      },
      [](State& s) {
        s.joint_commands = {{JointCommand::Kind::kVelocity, 1}, {}};
      },
  };
  for (std::size_t i = 0; i < changes.size(); ++i) {
    State changed = state;
    changes[i](changed);
    EXPECT_NE(HashOf(*layout, changed), before) << "change " << i;
  }
}

}  // namespace
}  // namespace gsv::world
