// For tests: a lockstep simulation of shapes whose robot drives towards a wall.
#pragma once

#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::recording {

using simulation::kTimeout;
using simulation::RunToEnd;
using simulation::SleepFor;
using simulation::ThreadBehaviour;
using std::chrono_literals::operator""ms;
using std::chrono_literals::operator""s;
using std::chrono_literals::operator""us;

// A behaviour that drives forwards at `speed`, in m/s. It creates a second sonar, "back", before
// its first wait.
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

inline simulation::RobotSpecification Robot(std::string name, double y,
                                            std::shared_ptr<simulation::BehaviourPort> behaviour) {
  return simulation::Robot(std::move(name), 0, y, std::move(behaviour));
}

// A simulation with steps of 10 ms and a robot named "robot" that starts at the origin.
inline std::shared_ptr<simulation::Simulation> MakeSimulation(
    base::SimTime duration, std::shared_ptr<simulation::BehaviourPort> behaviour) {
  simulation::Specification specification = simulation::Lockstep(duration);
  specification.seed = 7;
  auto simulation = simulation::Make(std::move(specification));
  EXPECT_TRUE(simulation->AddRobot(Robot("robot", 0, std::move(behaviour))));
  return simulation;
}

}  // namespace gsv::recording
