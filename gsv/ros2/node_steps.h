// Lets ROS 2 nodes step robots in lockstep. A step waits for the command that has the time stamp of
// the last /clock.
//
// A node answers each /clock with a TwistStamped of the same time. Commands with an earlier time
// are ignored.
//
// Threads  any.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <thread>

#include "gsv/base/mutex.h"
#include "gsv/simulation/agent.h"
#include "gsv/simulation/behaviour_port.h"

namespace gsv::ros2 {

// If a robot's behaviour has this name, a ROS 2 node drives the robot.
inline constexpr const char* kRos2Behaviour = "ros2";

// Stores the commands that nodes have sent, and lets robots wait for them.
class NodeSteps {
 public:
  // Sets whether a node steps the robot. If `is_open` becomes false, the robot no longer waits for
  // its node.
  void Open(const std::string& robot, bool is_open);
  // Whether a node steps the robot.
  bool IsOpen(const std::string& robot) const;

  // Stores a command that a node has sent with this time stamp.
  void Offer(const std::string& robot, base::SimTime stamp, const world::DriveCommand& command);
  // Waits for the command with this time stamp. During the wait, /clock is sent again from time to
  // time. Returns nullopt if the node no longer steps the robot.
  std::optional<world::DriveCommand> Await(const std::string& robot, base::SimTime time);

  // Sets the function that sends /clock again, for nodes that started late or did not receive it.
  // `repeat` must return at once, and may be empty.
  void SetRepeat(std::function<void()> repeat);

 private:
  struct Robot {
    bool is_open = false;                    // whether a node steps the robot
    std::optional<base::SimTime> stamp{};    // time stamp of the newest command
    world::DriveCommand command{};           // the newest command
    std::optional<base::SimTime> awaited{};  // the time stamp for which Await() last waited
    bool has_warned = false;                 // whether a late command was already logged
  };

  mutable base::Mutex mutex_;
  base::ConditionVariable changed_;  // notified when a command arrives or is_open changes
  std::map<std::string, Robot> robots_ GSV_GUARDED_BY(mutex_);
  base::Mutex repeat_mutex_;
  // the function of SetRepeat(); may be empty
  std::function<void()> repeat_ GSV_GUARDED_BY(repeat_mutex_);
};

// The agent of a robot that a node steps. At each instant of /clock, the agent waits for the
// command of the node, applies it, and waits for the next instant. If the command takes longer than
// Specification::deadline, the agent is unresponsive, like any other agent.
class NodeBehaviour final : public simulation::BehaviourPort {
 public:
  // `period` is the period of /clock.
  NodeBehaviour(std::shared_ptr<NodeSteps> steps, base::SimTime period);
  ~NodeBehaviour() override;

  base::Status Init(const std::shared_ptr<simulation::Agent>& agent) override;
  base::Status Start() override;
  base::Status Stop() override;
  base::Status Pause() override { return {}; }
  base::Status Resume() override { return {}; }
  void Destroy() override;
  bool IsDead() override { return false; }
  bool time_managed() const override { return true; }
  const std::string& name() const override { return name_; }
  const std::string& place() const override { return place_; }

 private:
  void Run(simulation::Agent& agent, simulation::ClockId clock);  // the function of thread_

  const std::shared_ptr<NodeSteps> steps_;
  const base::SimTime period_;  // period of /clock
  const std::string name_ = kRos2Behaviour;
  const std::string place_ = "ROS 2";
  std::shared_ptr<simulation::Agent> agent_;
  std::string robot_;
  std::thread thread_;  // executes Run()
};

}  // namespace gsv::ros2
