// Moves the joints of a robot along the trajectories that ROS 2 nodes send.
//
// Threads  Take() on any thread; other functions on the publisher's thread.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "gsv/base/mutex.h"
#include "gsv/ros2/commands.h"
#include "gsv/ros2/joint_trajectory.h"
#include "gsv/ros2/source.h"

namespace gsv::ros2 {

// Commands the joints of one robot along its current trajectory.
class TrajectoryFollower final : public Source {
 public:
  // `joints` are the joints that accept commands. `on_change` is called when a trajectory arrives.
  TrajectoryFollower(std::shared_ptr<CommandInput> input, std::string body,
                     std::shared_ptr<const model::Model> model, std::vector<int> joints,
                     std::function<void()> on_change);

  // Replaces the active trajectory by the JointTrajectory message in `sample`, if it is valid.
  void Take(std::span<const std::byte> sample);

  bool is_wanted() const override;
  // Sends the joints the positions of the trajectory at the time of `moment`.
  void Publish(const Moment& moment) override;

 private:
  // The trajectory that the joints follow now.
  struct Active {
    JointTrajectory trajectory;
    base::SimTime start{};        // simulated time of its start
    std::vector<double> initial;  // joint positions at the start of the trajectory
  };

  // Makes the trajectory the active one.
  void Begin(JointTrajectory trajectory, const world::Snapshot& snapshot, int body);

  const std::shared_ptr<CommandInput> input_;
  const std::string body_;  // name of the robot's body
  const std::shared_ptr<const model::Model> model_;
  const std::vector<int> joints_;  // indices in the model
  const std::function<void()> on_change_;
  std::optional<Active> active_;  // nullopt if no trajectory is followed
  base::SimTime last_{0};         // time of the last Publish()
  mutable base::Mutex mutex_;
  // A trajectory that Take() has received, and that Publish() has not yet begun.
  std::optional<JointTrajectory> next_ GSV_GUARDED_BY(mutex_);
  bool is_active_ GSV_GUARDED_BY(mutex_) = false;  // whether active_ or next_ is set
};

}  // namespace gsv::ros2
