// Implements Agent for one robot: its clocks, commands and sensors, and the turns of a local
// behaviour. Its state is guarded by SharedState::mutex (simulation_mutex).
#pragma once

#include <atomic>
#include <memory>
#include <set>

#include "gsv/simulation/agent.h"
#include "gsv/simulation/pace/wall_clock.h"
#include "gsv/simulation/robots/agent_clocks.h"
#include "gsv/simulation/robots/event_signaler.h"
#include "gsv/simulation/robots/local_behaviour.h"
#include "gsv/simulation/robots/robot_commands.h"
#include "gsv/simulation/robots/shared_state.h"
#include "gsv/simulation/robots/wait_event.h"

namespace gsv::simulation {

// The agent of one robot.
class RobotAgent final : public Agent, public std::enable_shared_from_this<RobotAgent> {
 public:
  RobotAgent(std::string robot, std::shared_ptr<const model::Model> model, bool is_avatar,
             std::shared_ptr<SharedState> shared);

  // The members of Agent.
  const std::string& robot() const override { return robot_; }
  std::string model() const override { return model_->name; }
  double footprint_radius() const override { return footprint_radius_; }
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
  base::Result<Exchanged> SleepAndRead(ClockId clock, std::optional<world::DriveCommand> command,
                                       SimTime until, std::chrono::milliseconds lease,
                                       const std::set<std::string>& sensors) override;
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

  base::Result<CycleMemory> ShareMemory(ClockId clock) override;

  // The result of Wake().
  struct Woken {
    // Whether a wait has ended or the agent has died. The caller must then call CollectWoken(), and
    // signal what it collects, preferably after releasing its locks.
    bool has_passed = false;
    bool has_died = false;  // whether a reported death has taken effect in this call
  };
  // Begins the cycle that the client has posted to the channel, if there is one. If the wait of
  // this cycle is already over, the channel is added to `due`.
  void BeginCycle(const std::shared_ptr<CycleChannel>& channel, EventSignaler::Events& due)
      GSV_REQUIRES(simulation_mutex);
  // Adds to `due` the wait event and the channels whose clients must be woken after Wake().
  void CollectWoken(const Woken& woken, EventSignaler::Events& due) GSV_REQUIRES(simulation_mutex);
  // Whether the clock of the channel delays the next step.
  bool IsAwaited(const CycleChannel& channel) const GSV_REQUIRES(simulation_mutex) {
    return BlocksStep() && !clocks_.IsWaiting(channel.clock());
  }
  // Reads the sensors of a cycle and writes their readings to `content`.
  CycleChannel::Readings WriteReadings(const CycleChannel::Request& request,
                                       exchange::ContentWriter& content);
  // Closes the shared memory of a clock, if it has one.
  void CloseChannel(ClockId clock);

  // Returns a reading for an observer.
  base::Result<sensing::Reading> Watch(const std::string& sensor);

  // Sets the robot's index in the current layout.
  void SetBody(int body) GSV_REQUIRES(simulation_mutex) { body_ = body; }
  int body() const GSV_REQUIRES(simulation_mutex) { return body_; }
  void SetBehaviour(std::shared_ptr<BehaviourPort> behaviour) GSV_REQUIRES(simulation_mutex);
  const std::shared_ptr<BehaviourPort>& behaviour() const GSV_REQUIRES(simulation_mutex) {
    return behaviour_;
  }
  // Whether the behaviour runs in this process, in turns. Such a behaviour has no thread of its own
  // that waits for instants.
  bool is_hosted() const GSV_REQUIRES(simulation_mutex) { return local_ != nullptr; }
  // Records that the behaviour has started.
  void MarkStarted() GSV_REQUIRES(simulation_mutex);
  bool is_started() const GSV_REQUIRES(simulation_mutex) { return started_; }
  // Whether the agent still runs, so that the next step must wait for it.
  bool BlocksStep() const GSV_REQUIRES(simulation_mutex);
  // Whether the agent itself delays the step. False if it only waits until other agents have had
  // their turns.
  bool IsAtWork() const GSV_REQUIRES(simulation_mutex);
  // The wall-clock time since which the agent runs.
  WallTime running_since() const GSV_REQUIRES(simulation_mutex) { return running_since_; }
  // Ends waits for instants up to `now`.
  Woken Wake(SimTime now, WallTime wall_now) GSV_REQUIRES(simulation_mutex);
  // Like Wake(), but does not mark the local behaviour as ready. If the agent was woken and has not
  // died, the caller must take its turn.
  Woken WakeForTurn(SimTime now, WallTime wall_now) GSV_REQUIRES(simulation_mutex);
  // The event on which the agent's calls wait. After a signal, a call checks whether its wait is
  // over.
  std::shared_ptr<WaitEvent> wait_event() { return {shared_from_this(), &wait_event_}; }
  // Marks the agent as unresponsive, because it runs and does not wait.
  void MarkUnresponsive(std::string detail) GSV_REQUIRES(simulation_mutex);
  // Reports the behaviour's death. From now on, is_alive() is false, and the agent does not block
  // the next step. The robot stops when the death takes effect. If the agent runs or has given up,
  // the death takes effect in the next Wake(). If the agent waits, the death takes effect when its
  // wait ends.
  void ReportDeath(std::string detail) GSV_REQUIRES(simulation_mutex);
  // Whether the behaviour is neither dead nor unresponsive.
  bool is_alive() const GSV_REQUIRES(simulation_mutex) {
    return fate_ == Fate::kAlive && !death_reported_;
  }
  // Whether the robot has a behaviour that is alive.
  bool is_watched() const GSV_REQUIRES(simulation_mutex) {
    return behaviour_ != nullptr && is_alive() && !is_removed_;
  }
  // Returns and clears the commands for the next step. Commands for motors and joints that have
  // failed are left out.
  RobotCommands TakeCommands() GSV_REQUIRES(simulation_mutex);
  // Applies the initial commands of the robot's devices.
  void StartDevices() GSV_REQUIRES(simulation_mutex);
  // Applies a fault: the drive stops from the next step on.
  void LoseMotor() GSV_REQUIRES(simulation_mutex);
  // Applies a fault: the joint has no motor from the next step on.
  void LoseJoint(int joint) GSV_REQUIRES(simulation_mutex);
  // Records that the robot was removed. Calls of its behaviour then fail.
  void MarkRemoved() GSV_REQUIRES(simulation_mutex);
  bool is_removed() const GSV_REQUIRES(simulation_mutex) { return is_removed_; }
  // Resets the agent for a new run: its clocks, its commands, its faults, and whether it is alive.
  void ResetClocks() GSV_REQUIRES(simulation_mutex);
  void FillStatus(RobotStatus& status) const GSV_REQUIRES(simulation_mutex);
  // Returns a text such as "robot_3 (wander on host:pid)".
  std::string Describe() const GSV_REQUIRES(simulation_mutex);
  // Returns a text such as "robot_3 (wander)" for events: without the process, so that equal runs
  // have equal events.
  std::string DescribeInEvents() const GSV_REQUIRES(simulation_mutex);
  void AddToHash(base::Hash& hash) const GSV_REQUIRES(simulation_mutex);
  SensorRack& rack() { return rack_; }

  // The turn of a local behaviour. TakeTurn() needs no lock.
  void TakeTurn(const Turn::Instant& instant, sensing::Sampling& sampling);
  // The start of the current turn; empty between turns. Any thread may call this.
  std::optional<WallTime> in_turn_since() const;
  // How long the last timed turn took. Only the stepping thread may call this, after the turn.
  WallDuration turn_took() const { return turn_took_; }
  // Applies the result of the last turn. If the behaviour waits for slow work, returns this work.
  std::function<void()> ApplyTurn() GSV_REQUIRES(simulation_mutex);
  // After ApplyUsualTurn(), the lists of SharedState must be changed as this structure says.
  struct UsualEnd {
    bool is_usual = false;     // false: nothing was applied, and ApplyTurn() must be called
    bool has_command = false;  // whether the agent must be added to SharedState::commanded
    bool has_drive = false;    // whether `drive` must be added to SharedState::drives
    bool was_counted = false;  // whether the agent no longer counts in SharedState::running
    SimTime until{0};          // time at which to add the agent to SharedState::turn_sleepers
    world::DriveCommand drive;
  };
  // Applies the turn if it ended in a wait for a later instant, as almost all turns do. Changes
  // only this agent, so calls for different agents may run concurrently while the stepping thread
  // holds the mutex.
  UsualEnd ApplyUsualTurn(SimTime now) GSV_REQUIRES(simulation_mutex);
  // If the agent's only command is for the drive, takes it, applies it to `state` and returns true.
  // Else does nothing and returns false. Concurrent calls are allowed as for ApplyUsualTurn().
  bool ApplyDriveCommand(world::State& state) GSV_REQUIRES(simulation_mutex);
  // Applies a command of SharedState::drives to `state`. Concurrent calls are allowed as for
  // ApplyUsualTurn().
  void ApplyDrive(const world::DriveCommand& command, world::State& state) const
      GSV_REQUIRES(simulation_mutex) {
    world::DriveState& driven = state.bodies[static_cast<std::size_t>(body_)].drive;
    driven.command = has_motor_ ? command : world::DriveCommand{};
    driven.command_time = state.time;
  }
  // Loads the agent's data into the cache, because a call for it follows soon.
  void Prefetch() const { PrefetchLines(&shared_, kPrefetchedLines); }
  // Load the data of a turn at `snapshot` into the cache, in two parts. For speed, call these
  // functions in this order, some time after Prefetch().
  void PrefetchBehaviour(const world::Snapshot& snapshot) const;
  void PrefetchTurn() const;
  // Loads the first part of the data of ApplyDriveCommand() into the cache.
  void PrefetchCommands() const GSV_NO_THREAD_SAFETY_ANALYSIS {
    PrefetchBody();
    PrefetchLines(&commands_, 2);
  }
  // Load the data of ApplyDrive() into the cache, in two parts.
  void PrefetchBody() const { PrefetchLines(&shared_, 1); }
  void PrefetchDrive(const world::State& state) const GSV_REQUIRES(simulation_mutex) {
    PrefetchLines(&state.bodies[static_cast<std::size_t>(body_)].drive, 1);
  }
  // Marks the local behaviour as ready for a turn.
  void MakeReady() GSV_REQUIRES(simulation_mutex);

 private:
  // Whether the behaviour still takes part in the run.
  enum class Fate { kAlive, kUnresponsive, kDead };

  // Fails if the behaviour may not give commands now.
  base::Status CheckCanCommand() const GSV_REQUIRES(simulation_mutex);
  // Reports to the channel that the wait of its cycle is over.
  void SetDue(CycleChannel& channel) GSV_REQUIRES(simulation_mutex);
  // Commands the drive, unless an exchange of a clock with a higher id has already done so.
  base::Status OfferDrive(ClockId clock, const world::DriveCommand& command)
      GSV_REQUIRES(simulation_mutex);
  // Fails if the behaviour is dead, or the run has ended.
  base::Status CheckAlive() const GSV_REQUIRES(simulation_mutex);
  // Fails if the clock is not open.
  base::Status CheckClock(ClockId clock) const GSV_REQUIRES(simulation_mutex);
  // Waits on the clock. `lock` is released during the wait.
  base::Result<Wait> WaitOn(AgentCallLock& lock, ClockId clock, SimTime until,
                            std::chrono::milliseconds lease) GSV_REQUIRES(simulation_mutex);
  // Returns the present readings of all sensors that are open.
  base::Result<std::vector<NamedReading>> ReadOpenSensors();
  // Returns the present reading of a sensor for the behaviour or an observer.
  base::Result<sensing::Reading> Sample(MountedSensor& sensor);
  // Makes the clock wait. Returns false if `until` is already reached.
  bool BeginWait(ClockId clock, SimTime until) GSV_REQUIRES(simulation_mutex);
  // Reports that the agent is dead because its behaviour ended with this error.
  void ReportFailure(std::string_view reason) GSV_REQUIRES(simulation_mutex);
  // Updates whether the simulation waits for this agent. Call it after every change that may affect
  // BlocksStep().
  void UpdateRunningCount() GSV_REQUIRES(simulation_mutex);

  // Adds the commands of the last turn to commands_.
  void MergeTurnCommands() GSV_REQUIRES(simulation_mutex);
  // Returns the agent's commands for the next step, and adds the agent to SharedState::commanded.
  RobotCommands& Commands() GSV_REQUIRES(simulation_mutex);
  void StopDriving() GSV_REQUIRES(simulation_mutex) { Commands().SetDrive({}); }
  // Switches on, from the next step on, a device that is on while it is open.
  void SwitchOn(const MountedSensor& sensor) GSV_REQUIRES(simulation_mutex);
  // Applies the initial command of a device.
  void StartDevice(const MountedSensor& sensor) GSV_REQUIRES(simulation_mutex);

  static void PrefetchLines(const void* begin, std::size_t lines) {
    for (std::size_t line = 0; line < lines; ++line) {
      __builtin_prefetch(static_cast<const char*>(begin) + 64 * line);
    }
  }

  // The members that each turn uses are the first ones, and fill these cache lines. Usual turns
  // change no member of the first cache line, so several threads can keep this line in their
  // caches.
  static constexpr std::size_t kPrefetchedLines = 6;
  // State that the parts of the simulation share.
  alignas(64) const std::shared_ptr<SharedState> shared_;
  std::shared_ptr<BehaviourPort> behaviour_ GSV_GUARDED_BY(simulation_mutex);
  LocalBehaviour* local_ GSV_GUARDED_BY(simulation_mutex) = nullptr;  // behaviour_->local()
  int body_ GSV_GUARDED_BY(simulation_mutex) = -1;  // index in the layout; -1 if not in the world
  bool has_motor_ GSV_GUARDED_BY(simulation_mutex) = true;  // false after LoseMotor()
  // Whether a local behaviour waits for slow work that it passed to Block().
  bool is_blocked_ GSV_GUARDED_BY(simulation_mutex) = false;
  bool started_ GSV_GUARDED_BY(simulation_mutex) = false;  // whether the behaviour has started
  bool is_removed_ GSV_GUARDED_BY(simulation_mutex) = false;
  // Whether ReportDeath() was called. The death has taken effect if `fate_` is kDead.
  bool death_reported_ GSV_GUARDED_BY(simulation_mutex) = false;
  // Whether the behaviour has reported its own death. Its later calls fail.
  bool has_given_up_ GSV_GUARDED_BY(simulation_mutex) = false;
  Fate fate_ GSV_GUARDED_BY(simulation_mutex) = Fate::kAlive;
  alignas(64) AgentClocks clocks_ GSV_GUARDED_BY(simulation_mutex);
  // whether the agent counts in shared_->running
  bool is_counted_ GSV_GUARDED_BY(simulation_mutex) = false;
  // whether the agent is in shared_->commanded
  bool is_commanded_ GSV_GUARDED_BY(simulation_mutex) = false;
  WallTime running_since_ GSV_GUARDED_BY(simulation_mutex){};
  RobotCommands commands_ GSV_GUARDED_BY(simulation_mutex);  // commands for the next step
  Turn turn_;  // used by the stepping thread and, during a turn, by the thread of the turn
  ClockId turn_clock_ = 0;                        // the clock of the last turn; used like turn_
  std::atomic<WallTime> turn_began_{WallTime()};  // start of the current turn; WallTime() between
                                                  // turns
  WallDuration turn_took_{};                      // duration of the last turn; used like turn_

  const std::string robot_;
  const std::shared_ptr<const model::Model> model_;
  const double footprint_radius_;  // in m; stored because behaviours ask for it in each turn
  const bool is_avatar_;
  SensorRack rack_;       // the robot's sensors
  WaitEvent wait_event_;  // signalled when a wait of the agent ends
  // The channels of this agent's clocks. Some of them may be closed.
  std::vector<std::shared_ptr<CycleChannel>> channels_ GSV_GUARDED_BY(simulation_mutex);
  // The number of calls that wait on wait_event_.
  int waiting_calls_ GSV_GUARDED_BY(simulation_mutex) = 0;
  // The joints that no longer follow commands, because of a fault.
  std::set<int> lost_joints_ GSV_GUARDED_BY(simulation_mutex);
  // The reason why the agent is dead or unresponsive.
  std::string detail_ GSV_GUARDED_BY(simulation_mutex);
  // The error that the behaviour reported; empty if there is none.
  std::string cause_ GSV_GUARDED_BY(simulation_mutex);
  SimTime detail_since_ GSV_GUARDED_BY(simulation_mutex){0};  // time since which detail_ applies
};

}  // namespace gsv::simulation
