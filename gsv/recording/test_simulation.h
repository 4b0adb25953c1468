// A lockstep simulation built of shapes, whose robot drives towards a wall, for tests.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include <gtest/gtest.h>

#include "gsv/simulation/simulation.h"

namespace gsv::recording {

using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;
using std::chrono_literals::operator""us;

inline constexpr auto kPatience = 20s;  // wall time in which every expected change must have come

// A behaviour on a thread of this process.
class ThreadBehaviour final : public simulation::BehaviourPort {
 public:
  using Body = std::function<void(simulation::Agent&, simulation::ClockId)>;

  explicit ThreadBehaviour(Body body) : body_(std::move(body)) {}

  base::Status Init(const std::shared_ptr<simulation::Agent>& agent) override {
    agent_ = agent;
    return {};
  }
  base::Status Start() override {
    const auto clock = agent_->OpenClock();
    if (!clock) return base::Fail(clock.error());
    thread_ = std::jthread([this, id = *clock] {
      body_(*agent_, id);
      (void)agent_->CloseClock(id);
    });
    return {};
  }
  base::Status Stop() override {
    if (thread_.joinable()) thread_.join();
    return {};
  }
  base::Status Pause() override { return {}; }
  base::Status Resume() override { return {}; }
  void Destroy() override { agent_.reset(); }
  bool IsDead() override { return false; }
  bool time_managed() const override { return true; }
  const std::string& name() const override { return name_; }
  const std::string& place() const override { return place_; }

 private:
  const Body body_;
  const std::string name_ = "test", place_ = "here:1";
  std::shared_ptr<simulation::Agent> agent_;
  std::jthread thread_;
};

inline bool SleepFor(simulation::Agent& agent, simulation::ClockId clock, base::SimTime duration) {
  const base::SimTime until = agent.Now() + duration;
  for (;;) {
    const auto wait = agent.SleepUntil(clock, until, 200ms);
    if (!wait) return false;
    if (*wait == simulation::Wait::kReached) return true;
  }
}

// Forwards at `speed`, m/s. It mounts a second sonar, "back", before it first waits.
inline std::shared_ptr<ThreadBehaviour> Drives(double speed,
                                               std::chrono::microseconds dawdling = 0us) {
  return std::make_shared<ThreadBehaviour>(
      [=](simulation::Agent& agent, simulation::ClockId clock) {
        model::SensorDescription back;
        back.name = "back";
        back.type = "sonar";
        back.link_from_sensor = geometry::PlanarPose(0, 0, 0.25, 3.14159);
        back.parameters = {{"min", 0.1}, {"max", 5.0}};
        EXPECT_TRUE(agent.CreateSensor(back));
        do {
          if (dawdling > 0us) std::this_thread::sleep_for(dawdling);
          (void)agent.Command({speed, 0, 0});
        } while (SleepFor(agent, clock, 50ms));
      });
}

// A disc of 0.2 m with a sonar, "front", at its middle.
inline std::shared_ptr<const model::Model> Disc() {
  auto model = std::make_shared<model::Model>();
  model->name = "disc";
  model->links.resize(1);
  model->links[0].name = "base";
  model->links[0].collisions.push_back(
      {"body", {{0, 0, 0.25}, {}}, geometry::Cylinder{0.2, 0.5}, {}});
  model->drive.emplace();
  model->drive->kind = model::DriveKind::kVelocity;
  model::SensorDescription sonar;
  sonar.name = "front";
  sonar.type = "sonar";
  sonar.link_from_sensor = {{0, 0, 0.25}, {}};
  sonar.parameters = {{"min", 0.1}, {"max", 5.0}};
  model->sensors.push_back(sonar);
  return model;
}

// Its face is at x = 2.9 m.
inline std::shared_ptr<const model::Model> Wall() {
  auto model = std::make_shared<model::Model>();
  model->name = "wall";
  model->is_static = true;
  model->links.resize(1);
  model->links[0].collisions.push_back({"wall", {{0, 0, 1}, {}}, geometry::Box{{0.2, 10, 2}}, {}});
  return model;
}

inline simulation::RobotSpecification Robot(std::string name, double y,
                                            std::shared_ptr<simulation::BehaviourPort> behaviour) {
  simulation::RobotSpecification robot;
  robot.name = std::move(name);
  robot.model = Disc();
  robot.world_from_robot = geometry::PlanarPose(0, y, 0, 0);
  robot.behaviour = std::move(behaviour);
  return robot;
}

// Steps of 10 ms; a robot "robot" that starts at the origin.
inline std::shared_ptr<simulation::Simulation> MakeSimulation(
    base::SimTime duration, std::shared_ptr<simulation::BehaviourPort> behaviour) {
  auto world = std::make_shared<model::WorldDescription>();
  world->name = "test";
  world->max_step_size = 10ms;
  world->models.push_back({"wall", Wall(), geometry::PlanarPose(3, 0, 0, 0), true});
  simulation::Specification specification;
  specification.world = world;
  specification.mode = simulation::Mode::kLockstep;
  specification.duration = duration;
  specification.seed = 7;
  auto sensors = std::make_shared<sensing::SensorRegistry>();
  sensing::AddBuiltInSensors(*sensors);
  auto simulation = simulation::Simulation::Create(std::move(specification), sensors);
  EXPECT_TRUE(simulation) << simulation.error().Sentence();
  EXPECT_TRUE((*simulation)->AddRobot(Robot("robot", 0, std::move(behaviour))));
  return *simulation;
}

inline simulation::Phase RunToEnd(simulation::Simulation& simulation) {
  using simulation::Phase;
  EXPECT_TRUE(simulation.Start());
  return simulation.WaitForPhase({Phase::kFinished, Phase::kFailed, Phase::kStopped}, kPatience);
}

}  // namespace gsv::recording
