// The Agent of one robot. What the stepping thread sees of it is guarded by SharedState::mutex; the
// members under "stepping" need it held.
#pragma once

#include <memory>

#include "gsv/simulation/agent.h"
#include "gsv/simulation/agent_clocks.h"
#include "gsv/simulation/behaviour_port.h"
#include "gsv/simulation/shared_state.h"
#include "gsv/simulation/wall_clock.h"

namespace gsv::simulation {

class RobotAgent final : public Agent {
 public:
  RobotAgent(std::string robot, std::shared_ptr<const model::Model> model, bool is_avatar,
             std::shared_ptr<const sensing::SensorRegistry> types,
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
  SimTime Now() const override;
  base::Result<Wait> SleepUntil(ClockId clock, SimTime until,
                                std::chrono::milliseconds lease) override;
  base::Result<Exchanged> Exchange(ClockId clock, std::uint64_t cycle,
                                   std::optional<world::DriveCommand> command, SimTime until,
                                   std::chrono::milliseconds lease) override;
  base::Status Command(const world::DriveCommand& command) override;
  std::vector<model::SensorDescription> Sensors() const override { return rack_.Descriptions(); }
  std::vector<std::string> SensorTypes() const override { return rack_.TypeNames(); }
  base::Status OpenSensor(const std::string& name) override;
  base::Status CreateSensor(model::SensorDescription description) override;
  base::Status CloseSensor(const std::string& name) override;
  base::Result<sensing::Reading> Read(const std::string& sensor) override;

  // A reading for somebody who watches.
  base::Result<sensing::Reading> Watch(const std::string& sensor);

  // Stepping.
  void SetBehaviour(std::shared_ptr<BehaviourPort> behaviour) { behaviour_ = std::move(behaviour); }
  const std::shared_ptr<BehaviourPort>& behaviour() const { return behaviour_; }
  void MarkStarted();
  // The simulation must not step: the agent is waited for and runs.
  bool HoldsUp() const;
  WallTime running_since() const { return running_since_; }
  // Ends waits up to `now`. True when a reported death has taken effect with that.
  bool Wake(SimTime now);
  // It runs and will never wait: takes effect at once.
  void MarkUnresponsive(std::string detail);
  // Its end is known; takes effect at its next wake, at once if it runs.
  void ReportDeath(std::string detail);
  bool is_alive() const { return fate_ == Fate::kAlive && !death_reported_; }
  bool is_watched() const { return behaviour_ != nullptr && is_alive() && !is_gone_; }
  // What is to act from this step on, once.
  std::optional<world::DriveCommand> TakeCommand();
  void Interrupt() { woken_.notify_all(); }
  void MarkGone();
  void ResetClocks();
  void FillStatus(RobotStatus& status) const;
  std::string Describe() const;  // "robot_3 (wander on host:pid)"
  void AddToHash(base::Hash& hash) const;
  SensorRack& rack() { return rack_; }

 private:
  enum class Fate { kAlive, kUnresponsive, kDead };

  base::Status CheckMayAct(const std::unique_lock<std::mutex>& lock) const;
  base::Status CheckAlive(const std::unique_lock<std::mutex>& lock) const;
  base::Status CheckClock(ClockId clock) const;
  base::Result<Wait> WaitOn(std::unique_lock<std::mutex>& lock, ClockId clock, SimTime until,
                            std::chrono::milliseconds lease);
  base::Result<std::vector<NamedReading>> ReadOpenSensors();
  void StopDriving() { pending_ = PendingCommand{}; }

  struct PendingCommand {
    ClockId clock = 0;  // 0: given directly
    world::DriveCommand command;
  };

  const std::string robot_;
  const std::shared_ptr<const model::Model> model_;
  const bool is_avatar_;
  const std::shared_ptr<SharedState> shared_;
  SensorRack rack_;

  // Guarded by shared_->mutex.
  std::condition_variable woken_;
  std::shared_ptr<BehaviourPort> behaviour_;
  AgentClocks clocks_;
  std::optional<PendingCommand> pending_;
  bool started_ = false;
  bool is_gone_ = false;
  bool death_reported_ = false;
  Fate fate_ = Fate::kAlive;
  std::string detail_;
  WallTime running_since_{};
};

}  // namespace gsv::simulation
