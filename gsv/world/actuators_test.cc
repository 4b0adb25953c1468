#include "gsv/world/actuators.h"

#include <functional>

#include <gtest/gtest.h>

namespace gsv::world {
namespace {

using namespace std::chrono_literals;

ActuatorStatePtr Told(std::string robot, std::string actuator, ActuatorOrder order = {}) {
  return std::make_shared<const ActuatorState>(
      ActuatorState{std::move(robot), std::move(actuator), nullptr, std::move(order), 0s});
}

TEST(Actuators, AreFoundByRobotAndName) {
  const Actuators all = {Told("a", "lamp"), Told("a", "siren"), Told("b", "lamp")};
  EXPECT_EQ(FindActuator(&all, "a", "siren"), all[1].get());
  EXPECT_EQ(FindActuator(&all, "b", "lamp"), all[2].get());
  EXPECT_EQ(FindActuator(&all, "b", "siren"), nullptr);
  EXPECT_EQ(FindActuator(nullptr, "a", "lamp"), nullptr);
}

TEST(Actuators, EachFieldIsInTheHash) {
  const auto hash_of = [](const ActuatorState& state) {
    base::Hash hash;
    AddToHash({std::make_shared<const ActuatorState>(state)}, hash);
    return hash.Digest();
  };
  const ActuatorState state = *Told("robot", "lamp", {{1, 0.5}, "word"});
  for (const auto& change : std::vector<std::function<void(ActuatorState&)>>{
           [](auto& s) { s.robot = "other"; }, [](auto& s) { s.actuator = "other"; },
           [](auto& s) { s.order.values[1] = 0.25; }, [](auto& s) { s.order.values.push_back(0); },
           [](auto& s) { s.order.word = ""; }, [](auto& s) { s.since = 1ns; },
           [](auto& s) { s.opening_before = 1; }, [](auto& s) { s.grip.held = "post"; },
           [](auto& s) { s.grip.link_from_held.position.z = 1; },
           [](auto& s) { s.grip.link_from_held.orientation.x = 1; },
           [](auto& s) { s.grip.width = 1; }}) {
    ActuatorState changed = state;
    change(changed);
    EXPECT_NE(hash_of(changed), hash_of(state));
  }
}

TEST(SoundOf, LastsAsLongAsItWasToldTo) {
  ActuatorState speaker = *Told("robot", "speaker", {{440, 0.5, 0.8}, "tone"});
  speaker.since = 2s;
  const auto begun = SoundOf(speaker, 2s);
  ASSERT_TRUE(begun);
  EXPECT_EQ(begun->elapsed, 0);
  const auto sound = SoundOf(speaker, 2400ms);
  ASSERT_TRUE(sound);
  EXPECT_EQ(sound->name, "tone");
  EXPECT_EQ(sound->frequency, 440);
  EXPECT_EQ(sound->volume, 0.8);
  EXPECT_NEAR(sound->elapsed, 0.4, 1e-12);
  EXPECT_NEAR(sound->left, 0.1, 1e-12);
  EXPECT_FALSE(SoundOf(speaker, 2500ms));
  speaker.order.values[2] = 0;
  EXPECT_FALSE(SoundOf(speaker, 2s));
}

TEST(OpeningOf, GoesFromWhereTheJawsWereWhenTheyWereTold) {
  GripperSetup setup;
  setup.opening = 0.1;
  setup.closing_time = 0.5;
  const auto gripper = std::make_shared<const ActuatorSetup>(ActuatorSetup{0, {}, setup});
  const ActuatorState closing = After(nullptr, {"robot", "gripper", gripper, {{0}, ""}, 1s});
  EXPECT_EQ(OpeningOf(closing, 1s), 0.1);
  EXPECT_NEAR(OpeningOf(closing, 1200ms), 0.06, 1e-12);
  EXPECT_EQ(OpeningOf(closing, 2s), 0);
  const ActuatorState opening = After(&closing, {"robot", "gripper", gripper, {{1}, ""}, 1200ms});
  EXPECT_NEAR(OpeningOf(opening, 1300ms), 0.08, 1e-12);
  EXPECT_EQ(OpeningOf(opening, 2s), 0.1);
  ActuatorState holding = closing;
  holding.grip.held = "post";
  holding.grip.width = 0.03;
  EXPECT_EQ(OpeningOf(holding, 2s), 0.03);
  const ActuatorState again = After(&holding, {"robot", "gripper", gripper, {{0}, ""}, 3s});
  EXPECT_EQ(again.grip.held, "post");
  EXPECT_TRUE(After(&holding, {"robot", "gripper", gripper, {{1}, ""}, 3s}).grip.held.empty());
}

}  // namespace
}  // namespace gsv::world
