// For tests: small worlds, robots and behaviours in this process.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include <gtest/gtest.h>

#include "gsv/sensing/devices/built_in.h"
#include "gsv/simulation/simulation.h"

namespace gsv::simulation {

using namespace std::chrono_literals;
using geometry::PlanarPose;

inline constexpr auto kLease = 200ms;  // maximum wall-clock time of one wait call, see Wait
inline constexpr auto kTimeout = 20s;  // wall-clock time limit of every expected change

// The current pose of a body.
inline geometry::Pose PoseOf(const Simulation& simulation, const std::string& name) {
  const auto snapshot = simulation.snapshot();
  const int body = snapshot->layout->Find(name);
  return snapshot->state.bodies.at(static_cast<std::size_t>(body)).world_from_model;
}

// A behaviour on a thread of this process.
class ThreadBehaviour final : public BehaviourPort {
 public:
  // The code of the behaviour's thread. It waits on the given clock.
  using Body = std::function<void(Agent&, ClockId)>;

  explicit ThreadBehaviour(Body body, bool time_managed = true)
      : body_(std::move(body)), time_managed_(time_managed) {}

  base::Status Init(const std::shared_ptr<Agent>& agent) override {
    agent_ = agent;
    ++inits;
    return init_error ? base::Fail(*init_error) : base::Status();
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
    ++stops;
    return {};
  }
  base::Status Pause() override {
    ++pauses;
    return {};
  }
  base::Status Resume() override {
    ++resumes;
    return {};
  }
  void Destroy() override { agent_.reset(); }
  bool IsDead() override { return dead; }
  bool time_managed() const override { return time_managed_; }
  const std::string& name() const override { return name_; }
  const std::string& place() const override { return place_; }

  std::optional<base::Error> init_error;  // the result of Init(); nullopt for success
  std::atomic<bool> dead = false;         // the result of IsDead()
  std::atomic<int> inits = 0, stops = 0, pauses = 0, resumes = 0;  // numbers of calls

 private:
  const Body body_;
  const bool time_managed_;
  const std::string name_ = "test", place_ = "here:1";
  std::shared_ptr<Agent> agent_;
  std::jthread thread_;
};

// Waits for a duration of simulated time. Returns false if the run has ended.
inline bool SleepFor(Agent& agent, ClockId clock, SimTime duration) {
  const SimTime until = agent.Now() + duration;
  for (;;) {
    const auto wait = agent.SleepUntil(clock, until, kLease);
    if (!wait) return false;
    if (*wait == Wait::kReached) return true;
  }
}

// A robot: a disc with a sonar "front" ahead and a drive that reaches any velocity at once.
inline std::shared_ptr<const model::Model> Disc(double radius) {
  auto model = std::make_shared<model::Model>();
  model->name = "disc";
  model->links.resize(1);
  model->links[0].name = "base";
  model->links[0].collisions.push_back(
      {"body", {{0, 0, 0.25}, {}}, geometry::Cylinder{radius, 0.5}, {}});
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

// A static wall of 0.2 m by 10 m, 2 m high.
inline std::shared_ptr<const model::Model> Wall() {
  auto model = std::make_shared<model::Model>();
  model->name = "wall";
  model->is_static = true;
  model->links.resize(1);
  model->links[0].collisions.push_back({"wall", {{0, 0, 1}, {}}, geometry::Box{{0.2, 10, 2}}, {}});
  return model;
}

// A run in lockstep with steps of 10 ms, in a world with a wall at x = 3.
inline Specification Lockstep(SimTime duration) {
  auto world = std::make_shared<model::WorldDescription>();
  world->name = "test";
  world->max_step_size = 10ms;
  world->models.push_back({"wall", Wall(), PlanarPose(3, 0, 0, 0), true});
  Specification specification;
  specification.world = world;
  specification.mode = Mode::kLockstep;
  specification.duration = duration;
  return specification;
}

// Creates a simulation with the built-in sensors.
inline std::shared_ptr<Simulation> Make(Specification specification) {
  auto sensors = std::make_shared<sensing::SensorRegistry>();
  sensing::AddBuiltInSensors(*sensors);
  auto simulation = Simulation::Create(std::move(specification), sensors);
  EXPECT_TRUE(simulation) << simulation.error().Sentence();
  return *simulation;
}

// A robot with a radius of 0.2 m at (x, y). Its front points along x.
inline RobotSpecification Robot(std::string name, double x, double y,
                                std::shared_ptr<BehaviourPort> behaviour = nullptr) {
  RobotSpecification robot;
  robot.name = std::move(name);
  robot.model = Disc(0.2);
  robot.world_from_robot = PlanarPose(x, y, 0, 0);
  robot.behaviour = std::move(behaviour);
  return robot;
}

// A behaviour that drives at this speed. In each cycle of 50 ms, it first sleeps for `dawdling` of
// wall-clock time.
inline std::shared_ptr<ThreadBehaviour> Drives(double speed,
                                               std::chrono::microseconds dawdling = 0us) {
  return std::make_shared<ThreadBehaviour>([=](Agent& agent, ClockId clock) {
    do {
      if (dawdling > 0us) std::this_thread::sleep_for(dawdling);
      (void)agent.Command({speed, 0, 0});
    } while (SleepFor(agent, clock, 50ms));
  });
}

// Starts the run and waits for its end.
inline Phase RunToEnd(Simulation& simulation) {
  EXPECT_TRUE(simulation.Start());
  return simulation.WaitForPhase({Phase::kFinished, Phase::kFailed, Phase::kStopped}, kTimeout);
}

inline RobotStatus StatusOf(const Simulation& simulation, const std::string& name) {
  for (const RobotStatus& robot : simulation.status().robots) {
    if (robot.name == name) return robot;
  }
  ADD_FAILURE() << "no robot " << name;
  return {};
}

}  // namespace gsv::simulation
