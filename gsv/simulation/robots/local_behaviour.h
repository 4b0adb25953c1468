// A behaviour that runs in the simulation's process, without a thread of its own. The simulation
// calls the behaviour's function TakeTurn() between two steps, on the threads of a team. Such a
// call is a turn: it begins when the behaviour's wait is over, and ends when the behaviour waits
// again.
//
// Threads      a behaviour takes one turn at a time, not always on the same thread. Different
//              behaviours take turns at the same time.
// Determinism  a turn may depend only on its readings and on the state of the behaviour.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <variant>

#include "gsv/base/thread_team.h"
#include "gsv/sensing/beam_set.h"
#include "gsv/simulation/agent.h"
#include "gsv/simulation/behaviour_port.h"
#include "gsv/simulation/history/snapshot_history.h"
#include "gsv/simulation/robots/mounted_sensor.h"
#include "gsv/simulation/robots/robot_commands.h"

namespace gsv::simulation {

// A turn is one execution of a local behaviour between two steps. The behaviour uses the members of
// this class during its turn. The last call of WaitUntil(), Block(), Finish() or Fail() decides
// what happens after the turn. If the turn contains no such call, the behaviour has finished.
class Turn {
 public:
  // The data that all turns at one instant share.
  struct Instant {
    base::SimTime now{0};              // simulated time of the instant
    SnapshotHistory::Frame snapshots;  // the snapshots that the sensors read
    sensing::RaySceneCache* rays = nullptr;
    std::uint64_t seed = 0;
    bool is_timed = false;  // whether the durations of turns are measured, see
                            // RobotAgent::turn_took()

    // Builds the ray scene, on the threads of the team. Builds it only if a turn at the previous
    // instant has cast rays.
    void Prepare(base::ThreadTeam& team);
    sensing::Sampling MakeSampling() const;

    // Records that a turn has cast rays. Prepare() then builds the ray scene at the next instant.
    void NoteRays() const;

    mutable std::atomic<bool> casts_rays{false};     // see NoteRays()
    std::shared_ptr<const sensing::RayScene> scene;  // keeps the scene alive during the turns
  };

  // Begins a new turn. `sampling` is the Sampling of the behaviour's robot at this instant.
  void Begin(const Instant& instant, const sensing::Sampling& sampling) {
    instant_ = &instant;
    sampling_ = &sampling;
    commands_.Clear();
    exchanges_ = 0;
    end_ = Finished{};
  }

  base::SimTime now() const { return instant_->now; }

  // Reads a sensor at this instant. Slow sensors must be read in Block().
  base::Result<sensing::Reading> Read(MountedSensor& sensor) const;
  // Sets the values that the sensors of `beams` measure at this instant. These sensors have no
  // update rate.
  void ReadBeams(const sensing::BeamSet& beams, std::span<double> values) const;
  // The time of the snapshot that the turn reads.
  base::SimTime snapshot_time() const { return sampling_->snapshot()->state.time; }
  // Announces that the turn will read `sensors` sensors that cast rays.
  void ExpectRays(std::size_t sensors) const { sampling_->ExpectRays(sensors); }

  // Commands the base from this step on. A later call replaces the command.
  void Command(const world::DriveCommand& command) { commands_.SetDrive({0, command}); }
  // Commands a joint of the robot's model from this step on.
  base::Status CommandJoint(int joint, const world::JointCommand& command);
  JointReading ReadJoint(int joint) const;  // Returns the state of a joint at this instant.
  // Sends a message by a radio to the robot `receiver`, or to all robots if `receiver` is empty.
  base::Status Send(const MountedSensor& radio, const std::string& receiver, std::string content);
  // Commands an actuator from this instant on.
  base::Status CommandDevice(const MountedSensor& actuator, world::DeviceCommand command);
  // Counts an exchange (command, wait, readings) on the behaviour's clock.
  void CountExchange() { ++exchanges_; }

  // Ends the turn. The next turn is at the first step at or after `instant`, or at once if that
  // step was already taken.
  void WaitUntil(base::SimTime instant) { end_ = Waiting{instant}; }
  // Ends the turn and runs `work` on another thread, for slow work such as an image. The next turn
  // starts when `work` is done. In lockstep, simulated time stands still until then.
  void Block(std::function<void()> work) { end_ = Blocked{std::move(work)}; }
  // Ends the behaviour's run without an error.
  void Finish() { end_ = Finished{}; }
  // Ends the behaviour's run with an error. See Agent::GiveUp().
  void Fail(std::string reason) { end_ = Failed{std::move(reason)}; }

 private:
  friend class RobotAgent;

  // The four ways in which a turn can end.
  struct Waiting {
    base::SimTime until{0};  // simulated time of the next turn
  };
  struct Blocked {
    std::function<void()> work;  // the argument of Block()
  };
  struct Finished {};
  struct Failed {
    std::string reason;
  };

  const Instant* instant_ = nullptr;             // the instant of this turn, see Begin()
  const sensing::Sampling* sampling_ = nullptr;  // see Begin()
  RobotCommands commands_;                       // the commands of this turn
  std::uint64_t exchanges_ = 0;                  // number of CountExchange() calls in this turn
  std::variant<Finished, Failed, Waiting, Blocked> end_;  // how the turn ends
};

// Base class of behaviours that run in this process, in turns.
class LocalBehaviour : public BehaviourPort {
 public:
  LocalBehaviour* local() final { return this; }
  bool IsDead() final { return false; }
  bool time_managed() const final { return true; }

  // The clock that the turns use to wait. Start() opens it.
  virtual ClockId clock() const = 0;
  // Loads the data of the next turn into the processor's cache. Called shortly before the turn.
  virtual void PrefetchTurn() const {}
  // Executes a turn. The function must return, because nothing can interrupt it. If the turn
  // exceeds the deadline, the simulation fails. Requests that need the world are then refused until
  // the function returns.
  virtual void TakeTurn(Turn& turn) = 0;
};

}  // namespace gsv::simulation
