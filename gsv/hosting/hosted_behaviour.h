// Runs a gsv::Behaviour in this process, for one robot of one simulation. The same behaviour can
// also run as a program, with the same results.
//
// A turn is the part of a behaviour between two waits. The turns of a Controller whose open
// sensors are all fast are plain function calls. Any other behaviour runs on a fibre, and each wait
// suspends the fibre.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "gsv/base/mutex.h"
#include "gsv/hosting/fibre.h"
#include "gsv/hosting/local_robot.h"
#include "sdk/behaviour/run.h"

namespace gsv::hosting {

class alignas(64) HostedBehaviour final : public simulation::LocalBehaviour {
 public:
  HostedBehaviour(std::string name, BehaviourFactory factory);
  ~HostedBehaviour() override;

  base::Status Init(const std::shared_ptr<simulation::Agent>& agent) override;
  base::Status Start() override;
  base::Status Stop() override;
  base::Status Pause() override;
  base::Status Resume() override;
  void Destroy() override;
  const std::string& name() const override { return name_; }
  const std::string& place() const override { return place_; }

  simulation::ClockId clock() const override { return clock_; }
  void PrefetchTurn() const override;
  void TakeTurn(simulation::Turn& turn) override;

 private:
  void Run() GSV_REQUIRES(mutex_);
  void Control(simulation::Turn& turn) GSV_REQUIRES(mutex_);
  // Passes new readings to the controller. Returns its command, or a stop if the run ends.
  DriveCommand ControlOnce() GSV_REQUIRES(mutex_);
  void EndTurn(simulation::Turn& turn) GSV_REQUIRES(mutex_);  // Called after the last turn.
  // Ends the run, so that the behaviour returns.
  void EndRun() GSV_REQUIRES(mutex_);
  base::Status Guarded(const char* what, const std::function<base::Status()>& call);

  // The members that each turn uses come first, in two cache lines (RobotAgent prefetches them).
  base::Mutex mutex_;  // held during a turn
  std::unique_ptr<LocalRobot> robot_ GSV_GUARDED_BY(mutex_);
  std::atomic<simulation::ClockId> clock_ = 0;
  // The started behaviour if it is a Controller that needs no fibre; else null.
  Controller* controller_ GSV_GUARDED_BY(mutex_) = nullptr;
  std::optional<SimTime> next_ GSV_GUARDED_BY(mutex_);  // the instant of a controller's next turn
  // See LocalRobot::sweeps(). PrefetchTurn() reads it during turns of other threads.
  std::atomic<const void*> sweeps_ = nullptr;
  // The fibre of a started behaviour; null if controller_ is set.
  std::unique_ptr<Fibre> fibre_ GSV_GUARDED_BY(mutex_);

  std::unique_ptr<Behaviour> behaviour_ GSV_GUARDED_BY(mutex_);
  std::shared_ptr<simulation::Agent> agent_ GSV_GUARDED_BY(mutex_);  // the robot in the simulation
  RunFailure failure_ GSV_GUARDED_BY(mutex_);
  const std::string name_, place_;
  const BehaviourFactory factory_;
};

}  // namespace gsv::hosting
