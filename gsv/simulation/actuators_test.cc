// Tests the commands of robots to their lamps and speakers: when commands take effect, and that
// fast and slow behaviours lead to the same final state.
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::simulation {
namespace {

RobotSpecification RobotWithLamp(std::string name, double y,
                                 std::shared_ptr<BehaviourPort> behaviour = nullptr,
                                 model::Parameters parameters = {}) {
  RobotSpecification robot = Robot(std::move(name), 0, y, std::move(behaviour));
  auto model = std::make_shared<model::Model>(*robot.model);
  for (const char* type : {"lamp", "speaker"}) {
    model::SensorDescription device;
    device.name = device.type = type;
    if (device.type == "lamp") device.parameters = parameters;
    model->sensors.push_back(device);
  }
  robot.model = std::move(model);
  return robot;
}

double BrightnessOf(Simulation& simulation, const std::string& robot,
                    const std::string& lamp = "lamp") {
  const auto reading = simulation.Watch(robot, lamp);
  EXPECT_TRUE(reading) << reading.error().Sentence();
  return reading ? reading->values[0] : -1;
}

TEST(Actuators, ApplyACommandFromItsInstantOn) {
  std::vector<double> seen;
  auto simulation = Make(Lockstep(100ms));
  auto behaviour = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
    ASSERT_TRUE(agent.OpenSensor("lamp"));
    ASSERT_TRUE(SleepFor(agent, clock, 20ms));
    ASSERT_TRUE(agent.CommandDevice("lamp", {{0.5, 1, 0, 0}, ""}));
    ASSERT_TRUE(agent.CommandDevice("lamp", {{0.75, 0, 1, 0}, ""}));
    seen.push_back(agent.Read("lamp")->values[0]);
    ASSERT_TRUE(SleepFor(agent, clock, 10ms));
    seen.push_back(agent.Read("lamp")->values[0]);
  });
  ASSERT_TRUE(simulation->AddRobot(RobotWithLamp("robot", 0, behaviour)));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(seen, (std::vector<double>{0, 0.75}));
  const auto snapshot = simulation->snapshot();
  ASSERT_EQ(snapshot->state.devices->size(), 1u);
  EXPECT_EQ(snapshot->state.devices->front()->followed()->since, 20ms);
}

TEST(Actuators, RefuseAnInvalidCommandWithASentence) {
  auto simulation = Make(Lockstep(20ms));
  std::vector<std::string> why;
  auto behaviour = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId) {
    for (const auto& status :
         {agent.CommandDevice("lamp", {{2, 1, 1, 1}, ""}), agent.CommandDevice("front", {{1}, ""}),
          agent.CommandDevice("siren", {{1}, ""}),
          agent.CommandDevice("speaker", {{440, 1, 1}, "song"})}) {
      ASSERT_FALSE(status);
      why.push_back(status.error().Sentence());
    }
  });
  ASSERT_TRUE(simulation->AddRobot(RobotWithLamp("robot", 0, behaviour)));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(why, (std::vector<std::string>{
                     "robot/lamp: the brightness is 2; it must lie between 0 and 1",
                     "robot/front: a sensor accepts no commands",
                     "robot: the robot has no sensor \"siren\"",
                     "robot/speaker: there is no sound \"song\"; the sounds are tone, buzz, chirp, "
                     "noise"}));
  EXPECT_EQ(simulation->snapshot()->state.devices, nullptr);
}

TEST(Actuators, HashDoesNotDependOnTheSpeedOfBehaviours) {
  const auto hash_of = [](std::chrono::microseconds first, std::chrono::microseconds second) {
    const auto blinks = [](std::chrono::microseconds dawdling) {
      return std::make_shared<ThreadBehaviour>([=](Agent& agent, ClockId clock) {
        double brightness = 0;
        do {
          std::this_thread::sleep_for(dawdling);
          brightness = 1 - brightness;
          (void)agent.CommandDevice("lamp", {{brightness, 1, 0.5, 0}, ""});
          (void)agent.CommandDevice("speaker", {{440, 0.1, brightness}, "tone"});
        } while (SleepFor(agent, clock, 30ms));
      });
    };
    auto simulation = Make(Lockstep(300ms));
    EXPECT_TRUE(simulation->AddRobot(RobotWithLamp("b", 1, blinks(first))));
    EXPECT_TRUE(simulation->AddRobot(RobotWithLamp("a", -1, blinks(second))));
    EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
    return simulation->state_hash();
  };
  EXPECT_EQ(hash_of(0us, 1500us), hash_of(1500us, 0us));
}

TEST(Actuators, LampCanBeOnFromTheStartAndAfterAReset) {
  auto simulation = Make(Lockstep(50ms));
  auto behaviour = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
    if (SleepFor(agent, clock, 20ms)) (void)agent.CommandDevice("lamp", {{0, 1, 1, 1}, ""});
  });
  ASSERT_TRUE(simulation->AddRobot(RobotWithLamp("robot", 0, behaviour, {{"brightness", 0.5}})));
  EXPECT_EQ(BrightnessOf(*simulation, "robot"), 0.5);
  for (int run = 0; run < 2; ++run) {
    ASSERT_TRUE(simulation->RunUntil(20ms));
    ASSERT_EQ(simulation->WaitForPhase({Phase::kPaused}, kTimeout), Phase::kPaused);
    ASSERT_NE(simulation->snapshot()->state.devices, nullptr);
    EXPECT_EQ(BrightnessOf(*simulation, "robot"), 0.5);
    ASSERT_TRUE(simulation->Resume());
    ASSERT_EQ(simulation->WaitForPhase({Phase::kFinished}, kTimeout), Phase::kFinished);
    EXPECT_EQ(BrightnessOf(*simulation, "robot"), 0);
    ASSERT_TRUE(simulation->Reset());
    EXPECT_EQ(simulation->snapshot()->state.devices, nullptr);
  }
}

TEST(Actuators, AreRemovedWithTheirRobotOrTheirSensor) {
  auto simulation = Make(Lockstep(100ms));
  auto behaviour = std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
    model::SensorDescription led;
    led.name = "extra";
    led.type = "led";
    led.parameters = {{"brightness", 1.0}};
    ASSERT_TRUE(agent.CreateSensor(led));
    ASSERT_TRUE(agent.CommandDevice("lamp", {{1, 1, 1, 1}, ""}));
    if (!SleepFor(agent, clock, 20ms)) return;
    EXPECT_EQ(agent.Read("extra")->values[0], 1);
    ASSERT_TRUE(agent.CloseSensor("extra"));
    ASSERT_TRUE(agent.CloseSensor("lamp"));
    while (SleepFor(agent, clock, 20ms)) {
    }
  });
  ASSERT_TRUE(simulation->AddRobot(RobotWithLamp("robot", 0, behaviour)));
  ASSERT_TRUE(simulation->AddRobot(RobotWithLamp("other", 1, nullptr, {{"brightness", 1.0}})));
  ASSERT_TRUE(simulation->RunUntil(50ms));
  ASSERT_EQ(simulation->WaitForPhase({Phase::kPaused}, kTimeout), Phase::kPaused);
  // The model's lamp stays on, even if no behaviour has opened it.
  ASSERT_EQ(simulation->snapshot()->state.devices->size(), 2u);
  EXPECT_EQ(BrightnessOf(*simulation, "robot"), 1);
  ASSERT_TRUE(simulation->RemoveRobot("robot"));
  ASSERT_EQ(simulation->snapshot()->state.devices->size(), 1u);
  EXPECT_EQ(simulation->snapshot()->state.devices->front()->robot(), "other");
}

}  // namespace
}  // namespace gsv::simulation
