#include "gsv/ros2/trajectory_follower.h"

#include <algorithm>
#include <utility>

namespace gsv::ros2 {
namespace {

constexpr base::SimTime kTrajectoryPeriod = std::chrono::milliseconds(10);

}  // namespace

TrajectoryFollower::TrajectoryFollower(std::shared_ptr<CommandInput> input, std::string body,
                                       std::shared_ptr<const model::Model> model,
                                       std::vector<int> joints, std::function<void()> on_change)
    : Source(kTrajectoryPeriod),
      input_(std::move(input)),
      body_(std::move(body)),
      model_(std::move(model)),
      joints_(std::move(joints)),
      on_change_(std::move(on_change)) {}

void TrajectoryFollower::Take(std::span<const std::byte> sample) {
  auto trajectory = ReadJointTrajectory(sample, *model_, joints_);
  if (!trajectory) return input_->Refuse(trajectory.error(), "joint_trajectory");
  {
    const base::MutexLock lock(mutex_);
    next_ = *std::move(trajectory);
    is_active_ = true;
  }
  on_change_();
}

bool TrajectoryFollower::is_wanted() const {
  const base::MutexLock lock(mutex_);
  return is_active_;
}

void TrajectoryFollower::Begin(JointTrajectory trajectory, const world::Snapshot& snapshot,
                               int body) {
  Active active;
  active.start = trajectory.start.value_or(snapshot.state.time);
  const auto first = snapshot.layout->bodies[static_cast<std::size_t>(body)].first_joint;
  for (const int joint : trajectory.joints) {
    active.initial.push_back(
        snapshot.state.joint_positions[static_cast<std::size_t>(first + joint)]);
  }
  active.trajectory = std::move(trajectory);
  active_ = std::move(active);
}

void TrajectoryFollower::Publish(const Moment& moment) {
  const int body = moment.snapshot->layout->Find(body_);
  if (body < 0) return;
  const base::SimTime now = moment.snapshot->state.time;
  if (now < std::exchange(last_, now)) active_.reset();  // the simulation was reset
  std::optional<JointTrajectory> next;
  {
    const base::MutexLock lock(mutex_);
    next = std::exchange(next_, std::nullopt);
  }
  if (next) Begin(*std::move(next), *moment.snapshot, body);
  if (!active_) {
    const base::MutexLock lock(mutex_);
    is_active_ = next_.has_value();
    return;
  }
  const base::SimTime time = now - active_->start;
  if (time < base::SimTime(0)) return;  // the start is in the future
  const JointTrajectory& trajectory = active_->trajectory;
  input_->CommandPositions(trajectory.joints, trajectory.PositionsAt(time, active_->initial));
  if (!trajectory.points.empty() && time < trajectory.points.back().time) return;
  active_.reset();
  const base::MutexLock lock(mutex_);
  is_active_ = next_.has_value();
}

}  // namespace gsv::ros2
