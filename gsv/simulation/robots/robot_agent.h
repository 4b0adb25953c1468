// The Agent of one robot. Its state is guarded by SharedState::mutex (simulation_mutex).
#pragma once

#include <atomic>
#include <memory>
#include <set>

#include "gsv/simulation/agent.h"
#include "gsv/simulation/pace/wall_clock.h"
#include "gsv/simulation/robots/agent_clocks.h"
#include "gsv/simulation/robots/local_behaviour.h"
#include "gsv/simulation/robots/robot_commands.h"
#include "gsv/simulation/robots/shared_state.h"
#include "gsv/simulation/robots/wait_event.h"

namespace gsv::simulation {

class RobotAgent final : public Agent, public std::enable_shared_from_this<RobotAgent> {
 public:
  RobotAgent(std::string robot, std::shared_ptr<const model::Model> model, bool is_avatar,
             std::shared_ptr<SharedState> shared);

  // Agent.
  const std::string& robot() const override { return robot_; }
  std::string model() const override { return model_->name; }
  double footprint_radius() const override { return model::FootprintRadius(*model_); }
  geometry::Pose RobotFromLink(int link) const override {
    return model_->links.at(link).model_from_link;
  }
  base::Result<ClockId> OpenClock() override;
  base::Status CloseClock(ClockId clock) override;
  base::Status GiveUp(ClockId clock, const std::string& reason) override;
  SimTime Now() const override;
  base::Result<Wait> SleepUntil(ClockId clock, SimTime until,
                                std::chrono::milliseconds lease) override;
  base::Result<Exchanged> Exchange(ClockId clock, std::uint64_t cycle,
                                   std::optional<world::DriveCommand> command, SimTime until,
                                   std::chrono::milliseconds lease) override;
  base::Status Command(const world::DriveCommand& command) override;
  const std::vector<model::Joint>& Joints() const override { return model_->joints; }
  base::Status CommandJoint(int joint, const world::JointCommand& command) override;
  base::Result<JointReading> ReadJoint(int joint) override;
  std::vector<model::SensorDescription> Sensors() const override { return rack_.Descriptions(); }
  std::vector<std::string> SensorTypes() const override { return rack_.TypeNames(); }
  base::Status OpenSensor(const std::string& name) override;
  base::Status CreateSensor(model::SensorDescription description) override;
  base::Status CloseSensor(const std::string& name) override;
  base::Result<std::shared_ptr<MountedSensor>> Mounted(const std::string& sensor) const override {
    return rack_.Find(sensor);
  }
  base::Result<sensing::Reading> Read(const std::string& sensor) override;
  base::Status Send(const std::string& radio, const std::string& receiver,
                    std::string content) override;
  base::Status CommandDevice(const std::string& actuator, world::DeviceCommand command) override;

  // A reading for somebody who watches.
  base::Result<sensing::Reading> Watch(const std::string& sensor);

  // Stepping.
  // Its index in the present layout.
  void SetBody(int body) GSV_REQUIRES(simulation_mutex) { body_ = body; }
  int body() const GSV_REQUIRES(simulation_mutex) { return body_; }
  void SetBehaviour(std::shared_ptr<BehaviourPort> behaviour) GSV_REQUIRES(simulation_mutex);
  const std::shared_ptr<BehaviourPort>& behaviour() const GSV_REQUIRES(simulation_mutex) {
    return behaviour_;
  }
  // Its behaviour is in this process: it takes turns, and no thread waits for it.
  bool is_hosted() const GSV_REQUIRES(simulation_mutex) {
    return behaviour_ != nullptr && behaviour_->local() != nullptr;
  }
  void MarkStarted() GSV_REQUIRES(simulation_mutex);
  bool is_started() const GSV_REQUIRES(simulation_mutex) { return started_; }
  // The simulation must not step: the agent is waited for and runs.
  bool BlocksStep() const GSV_REQUIRES(simulation_mutex);
  // It holds up the simulation, and not only because others have their turn before it.
  bool IsAtWork() const GSV_REQUIRES(simulation_mutex);
  WallTime running_since() const GSV_REQUIRES(simulation_mutex) { return running_since_; }
  struct Woken {
    bool has_passed = false;  // its gate is to be opened, best outside of all locks
    bool has_died = false;    // a reported death has taken effect
  };
  // Ends waits up to `now`.
  Woken Wake(SimTime now, WallTime wall_now) GSV_REQUIRES(simulation_mutex);
  // Where its waiting calls stand; once it is open they look whether their wait is over.
  std::shared_ptr<WaitEvent> wait_event() { return {shared_from_this(), &wait_event_}; }
  // It runs and will never wait: takes effect at once.
  void MarkUnresponsive(std::string detail) GSV_REQUIRES(simulation_mutex);
  // Its end is known; takes effect at its next wake, at once if it runs.
  void ReportDeath(std::string detail) GSV_REQUIRES(simulation_mutex);
  bool is_alive() const GSV_REQUIRES(simulation_mutex) {
    return fate_ == Fate::kAlive && !death_reported_;
  }
  bool is_watched() const GSV_REQUIRES(simulation_mutex) {
    return behaviour_ != nullptr && is_alive() && !is_removed_;
  }
  // Returns the commands that act from this step on, as far as its motor and joints can follow
  // them, and clears them.
  RobotCommands TakeCommands() GSV_REQUIRES(simulation_mutex);
  // Has its devices follow the commands that they follow from the start.
  void StartDevices() GSV_REQUIRES(simulation_mutex);
  // Faults: from the next step on its drive stands still, or nothing moves that joint.
  void LoseMotor() GSV_REQUIRES(simulation_mutex);
  void LoseJoint(int joint) GSV_REQUIRES(simulation_mutex);
  void MarkRemoved() GSV_REQUIRES(simulation_mutex);
  bool is_removed() const GSV_REQUIRES(simulation_mutex) { return is_removed_; }
  void ResetClocks() GSV_REQUIRES(simulation_mutex);
  void FillStatus(RobotStatus& status) const GSV_REQUIRES(simulation_mutex);
  std::string Describe() const GSV_REQUIRES(simulation_mutex);  // "robot_3 (wander on host:pid)"
  void AddToHash(base::Hash& hash) const GSV_REQUIRES(simulation_mutex);
  SensorRack& rack() { return rack_; }

  // A local behaviour's turn. TakeTurn() needs no lock; Settle() enters what came of it, and gives
  // the work that the behaviour is blocked on, if it is.
  void TakeTurn(const Turn::Instant& instant, sensing::Sampling& sampling);
  // When the turn began that is under way; empty between turns. Any thread.
  std::optional<WallTime> in_turn_since() const;
  std::function<void()> ApplyTurn() GSV_REQUIRES(simulation_mutex);
  // The turn of its local behaviour has come.
  void MakeReady() GSV_REQUIRES(simulation_mutex);

 private:
  enum class Fate { kAlive, kUnresponsive, kDead };

  base::Status CheckCanCommand() const GSV_REQUIRES(simulation_mutex);
  base::Status CheckAlive() const GSV_REQUIRES(simulation_mutex);
  base::Status CheckClock(ClockId clock) const GSV_REQUIRES(simulation_mutex);
  // Releases `lock` while it waits.
  base::Result<Wait> WaitOn(AgentCallLock& lock, ClockId clock, SimTime until,
                            std::chrono::milliseconds lease) GSV_REQUIRES(simulation_mutex);
  base::Result<std::vector<NamedReading>> ReadOpenSensors();
  base::Result<sensing::Reading> Sample(MountedSensor& sensor);
  // The clock waits; false when `until` is here already.
  bool BeginWait(ClockId clock, SimTime until) GSV_REQUIRES(simulation_mutex);
  void ReportFailure(std::string_view reason) GSV_REQUIRES(simulation_mutex);
  // Tells the simulation whether it has to wait for this agent; after whatever may change that.
  void UpdateRunningCount() GSV_REQUIRES(simulation_mutex);

  // The commands that the next step takes, which it does not forget then.
  RobotCommands& Commands() GSV_REQUIRES(simulation_mutex);
  void StopDriving() GSV_REQUIRES(simulation_mutex) { Commands().SetDrive({}); }
  // A device that is on while it is open is on from the next step on.
  void SwitchOn(const MountedSensor& sensor) GSV_REQUIRES(simulation_mutex);
  // A device follows the command that it follows from the start.
  void StartDevice(const MountedSensor& sensor) GSV_REQUIRES(simulation_mutex);

  const std::string robot_;
  const std::shared_ptr<const model::Model> model_;
  const bool is_avatar_;
  const std::shared_ptr<SharedState> shared_;
  SensorRack rack_;

  WaitEvent wait_event_;

  std::shared_ptr<BehaviourPort> behaviour_ GSV_GUARDED_BY(simulation_mutex);
  AgentClocks clocks_ GSV_GUARDED_BY(simulation_mutex);
  RobotCommands commands_ GSV_GUARDED_BY(simulation_mutex);
  int body_ GSV_GUARDED_BY(simulation_mutex) = -1;
  bool has_motor_ GSV_GUARDED_BY(simulation_mutex) = true;
  std::set<int> lost_joints_ GSV_GUARDED_BY(simulation_mutex);
  bool is_counted_ GSV_GUARDED_BY(simulation_mutex) = false;    // in shared_->running
  bool is_commanded_ GSV_GUARDED_BY(simulation_mutex) = false;  // in shared_->commanded
  // A local behaviour is blocked on work that takes its time.
  bool is_blocked_ GSV_GUARDED_BY(simulation_mutex) = false;
  bool started_ GSV_GUARDED_BY(simulation_mutex) = false;
  bool is_removed_ GSV_GUARDED_BY(simulation_mutex) = false;
  bool death_reported_ GSV_GUARDED_BY(simulation_mutex) = false;
  // It has reported its death itself: nothing of it counts any more.
  bool has_given_up_ GSV_GUARDED_BY(simulation_mutex) = false;
  Fate fate_ GSV_GUARDED_BY(simulation_mutex) = Fate::kAlive;
  std::string detail_ GSV_GUARDED_BY(simulation_mutex);
  WallTime running_since_ GSV_GUARDED_BY(simulation_mutex){};

  Turn turn_;  // the stepping thread's, and during a turn the thread's that takes it
  std::atomic<WallTime> turn_began_{WallTime()};  // WallTime(): no turn is under way
};

}  // namespace gsv::simulation
