#include "gsv/simulation/editing/carry_over.h"

#include <chrono>

#include <gmock/gmock.h>

namespace gsv::simulation {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

std::shared_ptr<const model::Model> WithJoints(std::size_t count) {
  auto model = std::make_shared<model::Model>();
  model->links.resize(count + 1);
  model->joints.resize(count);
  for (std::size_t i = 0; i < count; ++i) {
    model->joints[i].name = "joint_" + std::to_string(i);
    model->joints[i].child = static_cast<int>(i) + 1;
  }
  return model;
}

world::Body Named(std::string name, std::size_t joints, double x) {
  world::Body body;
  body.name = std::move(name);
  body.model = WithJoints(joints);
  body.initial_pose = geometry::PlanarPose(x, 0, 0, 0);
  return body;
}

std::shared_ptr<const world::Layout> LayoutOf(std::vector<world::Body> bodies) {
  return world::MakeLayout(1, std::move(bodies), std::make_shared<model::WorldDescription>());
}

TEST(CarryOver, KeepsTheStateOfOldBodiesAndStartsNewBodiesAtTheirInitialPose) {
  const auto before = LayoutOf({Named("b", 2, 0), Named("gone", 1, 0)});
  world::State state = world::InitialState(*before);
  state.step = 7;
  state.time = 70ms;
  state.bodies[0].world_from_model.position.x = 3;
  state.joint_positions = {0.1, 0.2, 0.3};
  state.joint_velocities = {1, 2, 3};
  world::CommandJoint(*before, 0, 1, {world::JointCommand::Kind::kVelocity, 5}, state);
  state.joint_integrals = {6, 7, 8};
  // "a" is sorted before "b", so the indices of the joints of "b" increase by one.
  const auto after = LayoutOf({Named("a", 1, -1), Named("b", 2, 0)});
  const world::State carried = CarryOver(*before, state, *after);
  EXPECT_EQ(carried.step, 7);
  EXPECT_EQ(carried.time, 70ms);
  EXPECT_EQ(carried.bodies[0].world_from_model.position.x, -1);
  EXPECT_EQ(carried.bodies[1].world_from_model.position.x, 3);
  EXPECT_THAT(carried.joint_positions, ElementsAre(0, 0.1, 0.2));
  EXPECT_THAT(carried.joint_velocities, ElementsAre(0, 1, 2));
  ASSERT_EQ(carried.joint_commands.size(), 3u);
  EXPECT_EQ(carried.joint_commands[0].kind, world::JointCommand::Kind::kNone);
  EXPECT_EQ(carried.joint_commands[2].value, 5);
  EXPECT_THAT(carried.joint_integrals, ElementsAre(0, 6, 7));
  EXPECT_EQ(carried.bodies[0].since, 70ms);
  EXPECT_EQ(carried.bodies[1].since, 0ms);
}

world::Contact Between(int first, int second) {
  world::Contact contact;
  contact.first = first, contact.second = second;
  return contact;
}

TEST(CarryOver, KeepsContactsAndAccelerationsOfASnapshot) {
  world::Snapshot earlier;
  earlier.layout = LayoutOf({Named("b", 1, 0), Named("c", 0, 1), Named("gone", 0, 2)});
  earlier.state = world::InitialState(*earlier.layout);
  earlier.step_length = 10ms;
  earlier.contacts = {Between(0, 1), Between(1, 2)};
  earlier.accelerations = {{{1, 0, 0}, {}}, {{2, 0, 0}, {}}, {{3, 0, 0}, {}}};
  earlier.joint_accelerations = {4};
  const auto layout = LayoutOf({Named("a", 1, -1), Named("b", 1, 0), Named("c", 0, 1)});
  world::State now = world::InitialState(*layout);
  now.bodies[0].world_from_model.position.x = -3;
  world::Snapshot carried = CarryOver(earlier, layout, now);
  EXPECT_EQ(carried.state.bodies[0].world_from_model.position.x, -3);
  EXPECT_EQ(carried.step_length, 10ms);
  ASSERT_EQ(carried.contacts.size(), 1u);
  EXPECT_EQ(carried.contacts[0].first, 1);
  EXPECT_EQ(carried.contacts[0].second, 2);
  ASSERT_EQ(carried.accelerations.size(), 3u);
  EXPECT_EQ(carried.accelerations[0].linear.x, 0);
  EXPECT_EQ(carried.accelerations[2].linear.x, 2);
  EXPECT_THAT(carried.joint_accelerations, ElementsAre(0, 4));
  ForgetMotion({"b"}, carried);
  EXPECT_TRUE(carried.contacts.empty());
  EXPECT_THAT(carried.joint_accelerations, ElementsAre(0, 0));
  EXPECT_EQ(carried.accelerations[2].linear.x, 2);
}

TEST(ResetToInitialPose, StopsABodyAtItsInitialPose) {
  const auto layout = LayoutOf({Named("a", 1, 4), Named("b", 1, 5)});
  world::State state = world::InitialState(*layout);
  state.bodies[1].world_from_model = {};
  state.bodies[1].linear_velocity = {1, 0, 0};
  state.bodies[1].in_contact = true;
  state.joint_velocities = {1, 2};
  ResetToInitialPose(*layout, 1, state);
  EXPECT_EQ(state.bodies[1].world_from_model.position.x, 5);
  EXPECT_EQ(state.bodies[1].linear_velocity, geometry::Vector3());
  EXPECT_FALSE(state.bodies[1].in_contact);
  EXPECT_THAT(state.joint_velocities, ElementsAre(1, 0));
}

}  // namespace
}  // namespace gsv::simulation
