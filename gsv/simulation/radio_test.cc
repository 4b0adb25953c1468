// Tests messages between robots: when and in which order they arrive, and that fast and slow
// behaviours lead to the same final state.
#include <set>

#include "gsv/base/base64.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::simulation {
namespace {

std::shared_ptr<const model::Model> DiscWithRadio(model::Parameters parameters = {}) {
  auto model = std::make_shared<model::Model>(*Disc(0.2));
  model::SensorDescription radio;
  radio.name = "radio";
  radio.type = "radio";
  radio.link_from_sensor.position.z = 0.5;
  radio.parameters = std::move(parameters);
  model->sensors.push_back(radio);
  return model;
}

RobotSpecification RobotWithRadio(std::string name, double x, double y,
                                  std::shared_ptr<BehaviourPort> behaviour,
                                  model::Parameters parameters = {}) {
  RobotSpecification robot = Robot(std::move(name), x, y, std::move(behaviour));
  robot.model = DiscWithRadio(std::move(parameters));
  return robot;
}

struct Heard {
  std::string sender, content;
  std::uint64_t number = 0;
  friend bool operator==(const Heard&, const Heard&) = default;
};
using Inbox = std::vector<Heard>;

Inbox Listen(Agent& agent) {
  const auto reading = agent.Read("radio");
  EXPECT_TRUE(reading) << reading.error().Sentence();
  Inbox inbox;
  for (std::size_t i = 0; reading && i < reading->values.size() / 3; ++i) {
    inbox.push_back({reading->labels->at(2 * i), *base::FromBase64(reading->labels->at(2 * i + 1)),
                     static_cast<std::uint64_t>(reading->values[3 * i])});
  }
  return inbox;
}

// A behaviour that opens its radio, waits 100 ms, and then calls `what` once.
std::shared_ptr<ThreadBehaviour> Speaks(std::function<void(Agent&)> what) {
  return std::make_shared<ThreadBehaviour>([what](Agent& agent, ClockId clock) {
    ASSERT_TRUE(agent.OpenSensor("radio"));
    if (!SleepFor(agent, clock, 100ms)) return;
    what(agent);
    while (SleepFor(agent, clock, 1s)) {
    }
  });
}

std::shared_ptr<ThreadBehaviour> Says(std::vector<std::string> words, std::string to = {}) {
  return Speaks([words, to](Agent& agent) {
    for (const std::string& word : words) EXPECT_TRUE(agent.Send("radio", to, word));
  });
}

// A behaviour that opens its radio and stores the messages in its inbox at each of these instants.
std::shared_ptr<ThreadBehaviour> Hears(std::vector<SimTime> instants,
                                       std::map<SimTime, Inbox>& heard) {
  return std::make_shared<ThreadBehaviour>([=, &heard](Agent& agent, ClockId clock) {
    ASSERT_TRUE(agent.OpenSensor("radio"));
    for (const SimTime instant : instants) {
      if (!SleepFor(agent, clock, instant - agent.Now())) return;
      heard[instant] = Listen(agent);
    }
  });
}

TEST(Radio, DeliversWithTheNextStepInTheOrderOfSenders) {
  std::map<SimTime, Inbox> heard;
  auto simulation = Make(Lockstep(300ms));
  // The robots are not added in the order of their names: the robot that is added first is the last
  // by name.
  ASSERT_TRUE(simulation->AddRobot(RobotWithRadio("zoe", 0, 2, Says({"z1", "z2"}))));
  ASSERT_TRUE(
      simulation->AddRobot(RobotWithRadio("ear", 0, 0, Hears({100ms, 110ms, 200ms}, heard))));
  ASSERT_TRUE(simulation->AddRobot(RobotWithRadio("ann", 0, -2, Says({"a1", "a2"}))));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  const Inbox all = {{"ann", "a1", 1}, {"ann", "a2", 2}, {"zoe", "z1", 3}, {"zoe", "z2", 4}};
  EXPECT_EQ(heard[100ms], Inbox());
  EXPECT_EQ(heard[110ms], all);
  EXPECT_EQ(heard[200ms], all);
}

TEST(Radio, ReachesOneOrAllButNotTheSenderAndNotDistantRobots) {
  std::map<SimTime, Inbox> near, addressed, far;
  auto simulation = Make(Lockstep(200ms));
  ASSERT_TRUE(
      simulation->AddRobot(RobotWithRadio("speaker", 0, 0, Speaks([](Agent& agent) {
                                            EXPECT_TRUE(agent.Send("radio", "", "to all"));
                                            EXPECT_TRUE(agent.Send("radio", "addressed", "to one"));
                                            EXPECT_TRUE(agent.Send("radio", "nobody", "to none"));
                                          }),
                                          {{"range", 5.0}})));
  ASSERT_TRUE(simulation->AddRobot(RobotWithRadio("near", 0, 4.9, Hears({150ms}, near))));
  ASSERT_TRUE(simulation->AddRobot(RobotWithRadio("addressed", 0, -3, Hears({150ms}, addressed))));
  ASSERT_TRUE(simulation->AddRobot(RobotWithRadio("far", -5.1, 0, Hears({150ms}, far))));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(near[150ms], (Inbox{{"speaker", "to all", 1}}));
  EXPECT_EQ(addressed[150ms], (Inbox{{"speaker", "to all", 1}, {"speaker", "to one", 2}}));
  EXPECT_EQ(far[150ms], Inbox());
  EXPECT_EQ(simulation->Watch("speaker", "radio")->values.size(), 0u);
}

TEST(Radio, IsBlockedByAnAbsorbingWall) {
  std::map<SimTime, Inbox> before, behind;
  auto simulation = Make(Lockstep(200ms));  // the wall is at x = 3, between the robots
  ASSERT_TRUE(simulation->AddRobot(
      RobotWithRadio("speaker", 2, 0, Says({"hello"}), {{"wall_loss", 1000.0}})));
  ASSERT_TRUE(simulation->AddRobot(RobotWithRadio("before", -4, 0, Hears({150ms}, before))));
  ASSERT_TRUE(simulation->AddRobot(RobotWithRadio("behind", 4, 0, Hears({150ms}, behind))));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(before[150ms], (Inbox{{"speaker", "hello", 1}}));
  EXPECT_EQ(behind[150ms], Inbox());
}

TEST(Radio, KeepsTheLastMessagesAndCountsAll) {
  std::map<SimTime, Inbox> heard;
  auto simulation = Make(Lockstep(200ms));
  ASSERT_TRUE(simulation->AddRobot(RobotWithRadio("a", 0, 0, Says({"1", "2", "3", "4", "5"}))));
  ASSERT_TRUE(
      simulation->AddRobot(RobotWithRadio("b", 0, 2, Hears({150ms}, heard), {{"inbox", 2.0}})));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(heard[150ms], (Inbox{{"a", "4", 4}, {"a", "5", 5}}));
}

TEST(Radio, ReceivesOnlyWhileItIsOpen) {
  Inbox at_first, after_all;
  auto simulation = Make(Lockstep(400ms));
  ASSERT_TRUE(simulation->AddRobot(RobotWithRadio("a", 0, 0, Says({"early"}))));
  ASSERT_TRUE(simulation->AddRobot(
      RobotWithRadio("b", 0, 2, std::make_shared<ThreadBehaviour>([&](Agent& agent, ClockId clock) {
                       if (!SleepFor(agent, clock, 150ms)) return;
                       ASSERT_TRUE(agent.OpenSensor("radio"));
                       if (!SleepFor(agent, clock, 50ms)) return;
                       at_first = Listen(agent);
                       ASSERT_TRUE(agent.CloseSensor("radio"));
                       ASSERT_TRUE(agent.OpenSensor("radio"));
                       if (SleepFor(agent, clock, 50ms)) after_all = Listen(agent);
                     }))));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(at_first, Inbox());
  EXPECT_EQ(after_all, Inbox());
  EXPECT_EQ(simulation->snapshot()->state.devices->size(), 2u);
}

TEST(Radio, RefusesLongMessagesTooManyMessagesAndOtherSensors) {
  auto simulation = Make(Lockstep(200ms));
  ASSERT_TRUE(simulation->AddRobot(RobotWithRadio(
      "a", 0, 0, Speaks([](Agent& agent) {
        EXPECT_TRUE(agent.Send("radio", "", std::string(10, 'x')));
        const auto long_one = agent.Send("radio", "", std::string(11, 'x'));
        ASSERT_FALSE(long_one);
        EXPECT_NE(long_one.error().Sentence().find("max_size, 10"), std::string::npos);
        EXPECT_FALSE(agent.Send("front", "", "x"));  // "front" is a sonar, not a radio
        EXPECT_FALSE(agent.Send("nothing", "", "x"));
        for (int i = 1; i < 64; ++i) EXPECT_TRUE(agent.Send("radio", "", "x"));
        EXPECT_FALSE(agent.Send("radio", "", "x"));
      }),
      {{"max_size", 10.0}})));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
}

TEST(Radio, ClearsMessagesOnResetAndOfRemovedRobots) {
  auto simulation = Make(Lockstep(200ms));
  std::map<SimTime, Inbox> heard;
  ASSERT_TRUE(simulation->AddRobot(RobotWithRadio("a", 0, 0, Says({"hello"}))));
  ASSERT_TRUE(simulation->AddRobot(RobotWithRadio("b", 0, 2, Hears({150ms}, heard))));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  const std::string first = simulation->state_hash();
  ASSERT_TRUE(simulation->Reset());
  EXPECT_EQ(simulation->snapshot()->state.devices, nullptr);
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_EQ(simulation->state_hash(), first);
  ASSERT_TRUE(simulation->RemoveRobot("b"));
  ASSERT_EQ(simulation->snapshot()->state.devices->size(), 1u);
  EXPECT_EQ(simulation->snapshot()->state.devices->front()->robot(), "a");
}

// A behaviour that sends the number of messages that it received, and drives accordingly.
std::shared_ptr<ThreadBehaviour> Chats(std::chrono::microseconds dawdling) {
  return std::make_shared<ThreadBehaviour>([=](Agent& agent, ClockId clock) {
    ASSERT_TRUE(agent.OpenSensor("radio"));
    std::uint64_t heard = 0;
    do {
      std::this_thread::sleep_for(dawdling);
      const Inbox inbox = Listen(agent);
      if (!inbox.empty()) heard = inbox.back().number;
      ASSERT_TRUE(agent.Send("radio", "", agent.robot() + std::to_string(heard)));
      ASSERT_TRUE(agent.Command({0.1 * static_cast<double>(heard % 5), 0, 0.3}));
    } while (SleepFor(agent, clock, 20ms));
  });
}

TEST(Radio, HashDoesNotDependOnTheSpeedOfBehaviours) {
  std::set<std::string> hashes;
  for (const int slow : {-1, 0, 3}) {
    auto simulation = Make(Lockstep(400ms));
    for (int i = 0; i < 4; ++i) {
      ASSERT_TRUE(simulation->AddRobot(RobotWithRadio("robot" + std::to_string(i), -1.0 * i, 0,
                                                      Chats(i == slow ? 700us : 0us),
                                                      {{"range", 2.2}, {"inbox", 3.0}})));
    }
    ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
    // the number of the newest message
    EXPECT_GT(simulation->Watch("robot0", "radio")->values[6], 10);
    hashes.insert(simulation->state_hash());
  }
  EXPECT_EQ(hashes.size(), 1u);
}

TEST(Radio, MessagesChangeTheHash) {
  const auto hash_of = [](const std::string& word) {
    auto simulation = Make(Lockstep(200ms));
    EXPECT_TRUE(simulation->AddRobot(RobotWithRadio("a", 0, 0, Says({word}))));
    EXPECT_TRUE(simulation->AddRobot(RobotWithRadio("b", 0, 2, Says({}))));
    EXPECT_EQ(RunToEnd(*simulation), Phase::kFinished);
    return simulation->state_hash();
  };
  EXPECT_EQ(hash_of("one"), hash_of("one"));
  EXPECT_NE(hash_of("one"), hash_of("two"));
}

}  // namespace
}  // namespace gsv::simulation
