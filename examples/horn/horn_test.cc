// Tests the horn, for which GSV itself has no code: microphones hear it, it is part of the state,
// and it stops by itself.
#include <cmath>

#include <gtest/gtest.h>

#include "gsv/sensing/module.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::simulation {
namespace {

RobotSpecification RobotWith(const std::string& type, std::string name, double y,
                             std::shared_ptr<BehaviourPort> behaviour = nullptr) {
  RobotSpecification robot = Robot(std::move(name), 0, y, std::move(behaviour));
  auto model = std::make_shared<model::Model>(*robot.model);
  model::SensorDescription device;
  device.name = device.type = type;
  model->sensors.push_back(device);
  robot.model = std::move(model);
  return robot;
}

std::shared_ptr<Simulation> MakeWithHorns(SimTime duration) {
  auto sensors = std::make_shared<sensing::SensorRegistry>();
  sensing::AddBuiltInSensors(*sensors);
  EXPECT_TRUE(gsv_sensor_module()->add(*sensors));
  auto simulation = Simulation::Create(Lockstep(duration), sensors);
  EXPECT_TRUE(simulation) << simulation.error().Sentence();
  return *simulation;
}

TEST(Horn, MicrophoneHearsItForItsDuration) {
  auto simulation = MakeWithHorns(0s);
  auto honks = std::make_shared<ThreadBehaviour>([](Agent& agent, ClockId clock) {
    ASSERT_TRUE(agent.CommandDevice("horn", {{0.2}, ""}));
    while (SleepFor(agent, clock, 1s)) {
    }
  });
  ASSERT_TRUE(simulation->AddRobot(RobotWith("horn", "car", 0, honks)));
  ASSERT_TRUE(simulation->AddRobot(RobotWith("microphone", "ear", 10)));
  const auto run_to = [&](SimTime instant) {
    ASSERT_TRUE(simulation->RunUntil(instant));
    ASSERT_EQ(simulation->WaitForPhase({Phase::kPaused}, kTimeout), Phase::kPaused);
  };
  run_to(150ms);
  EXPECT_NEAR(simulation->Watch("car", "horn")->values[0], 0.05, 1e-12);
  const auto heard = simulation->Watch("ear", "microphone");
  ASSERT_TRUE(heard);
  // 105 dB at 1 m decrease by 20 dB over 10 m; the ambient noise is 30 dB.
  EXPECT_NEAR(heard->values[0], 10 * std::log10(std::pow(10, 8.5) + 1e3), 1e-9);
  EXPECT_EQ(heard->values[1], 420);
  EXPECT_EQ(heard->labels->front(), "car/horn");
  run_to(200ms);
  EXPECT_EQ(simulation->Watch("car", "horn")->values[0], 0);
  EXPECT_EQ(simulation->Watch("ear", "microphone")->labels->front(), "");
}

TEST(Horn, AffectsTheHash) {
  const auto hash_of = [](double duration) {
    auto simulation = MakeWithHorns(100ms);
    auto honks = std::make_shared<ThreadBehaviour>([=](Agent& agent, ClockId) {
      ASSERT_TRUE(agent.CommandDevice("horn", {{duration}, ""}));
    });
    EXPECT_TRUE(simulation->AddRobot(RobotWith("horn", "car", 0, honks)));
    EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
    return simulation->state_hash();
  };
  EXPECT_EQ(hash_of(1), hash_of(1));
  EXPECT_NE(hash_of(1), hash_of(2));
}

TEST(Horn, RejectsInvalidCommands) {
  auto simulation = MakeWithHorns(20ms);
  std::string why;
  auto honks = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId) {
    const auto status = agent.CommandDevice("horn", {{61}, ""});
    ASSERT_FALSE(status);
    why = status.error().Sentence();
  });
  ASSERT_TRUE(simulation->AddRobot(RobotWith("horn", "car", 0, honks)));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(why, "car/horn: the duration is 61; it must lie between 0 and 60");
}

}  // namespace
}  // namespace gsv::simulation
