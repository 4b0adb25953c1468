// A behaviour inside this process: the simulation itself runs it, in turns between two steps, on
// the threads of its team. A turn goes from a wake to the next wait.
//
// Threads      one turn of a behaviour at a time, not always on the same thread; turns of different
//              behaviours at the same time.
// Determinism  a turn may depend on the readings it takes and on what the behaviour remembers.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <variant>

#include "gsv/base/thread_team.h"
#include "gsv/sensing/sensor.h"
#include "gsv/simulation/agent.h"
#include "gsv/simulation/behaviour_port.h"
#include "gsv/simulation/history/snapshot_history.h"
#include "gsv/simulation/robots/mounted_sensor.h"
#include "gsv/simulation/robots/robot_commands.h"

namespace gsv::simulation {

// What a behaviour may do in its turn. Ends as the last of WaitUntil(), Block(), Finish() and
// Fail() says; without any of them the behaviour has finished.
class Turn {
 public:
  // What all turns of one instant share.
  struct Instant {
    base::SimTime now{0};
    SnapshotHistory::Frame snapshots;
    sensing::RaySceneCache* rays = nullptr;
    std::uint64_t seed = 0;

    // Has the team make ready what readings need, if the last instant's did.
    void Prepare(base::ThreadTeam& team);
    sensing::Sampling MakeSampling() const;

    mutable std::atomic<bool> casts_rays{false};
    std::shared_ptr<const sensing::RayScene> scene;  // held while the turns are taken
  };

  Turn() = default;
  // `sampling` is that of the behaviour's robot, now.
  Turn(const Instant& instant, const sensing::Sampling& sampling)
      : instant_(&instant), sampling_(&sampling) {}

  base::SimTime now() const { return instant_->now; }

  // A reading at this instant; for sensors that answer at once, see Block().
  base::Result<sensing::Reading> Read(MountedSensor& sensor) const;
  // So many sensors that cast rays are about to be read.
  void ExpectRays(std::size_t sensors) const { sampling_->ExpectRays(sensors); }

  // Acts from this step on; a later command replaces it.
  void Command(const world::DriveCommand& command) { commands_.SetDrive({0, command}); }
  // The same for a joint of the robot's model.
  base::Status CommandJoint(int joint, const world::JointCommand& command);
  JointReading ReadJoint(int joint) const;  // at this instant
  // By a radio, to the robot `receiver`; empty: to all.
  base::Status Send(const MountedSensor& radio, const std::string& receiver, std::string content);
  // Commands an actuator from this instant on.
  base::Status CommandDevice(const MountedSensor& actuator, world::DeviceCommand command);
  // The command belongs to an exchange on the behaviour's clock.
  void CountExchange() { ++exchanges_; }

  // The next turn comes at the first step at or after `instant`; at once if that is here.
  void WaitUntil(base::SimTime instant) { end_ = Waiting{instant}; }
  // Does `work`, which may take its time (a picture), on a thread that may wait; the next turn
  // comes when it is done. Time does not go on in lockstep.
  void Block(std::function<void()> work) { end_ = Blocked{std::move(work)}; }
  void Finish() { end_ = Finished{}; }
  // Instead of Finish(): the run has ended with an error, see Agent::GiveUp().
  void Fail(std::string reason) { end_ = Failed{std::move(reason)}; }

 private:
  friend class RobotAgent;

  struct Waiting {
    base::SimTime until{0};
  };
  struct Blocked {
    std::function<void()> work;
  };
  struct Finished {};
  struct Failed {
    std::string reason;
  };

  const Instant* instant_ = nullptr;
  const sensing::Sampling* sampling_ = nullptr;
  RobotCommands commands_;
  std::uint64_t exchanges_ = 0;
  std::variant<Finished, Failed, Waiting, Blocked> end_;
};

class LocalBehaviour : public BehaviourPort {
 public:
  LocalBehaviour* local() final { return this; }
  bool IsDead() final { return false; }
  bool time_managed() const final { return true; }

  // Start() has opened the clock that the turns are counted on.
  virtual ClockId clock() const = 0;
  // Must come to its end: nothing can interrupt it. When it has not after the deadline, the
  // simulation fails; until it does come, nobody gets at the world, and all that needs it is
  // refused.
  virtual void TakeTurn(Turn& turn) = 0;
};

}  // namespace gsv::simulation
