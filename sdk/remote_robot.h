// A Robot that is used through an sba::Hardware reference.
//
// Threads  the behaviour's thread; End() from any.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>

#include "gsv/base/mutex.h"
#include "gsv/orb/errors.h"
#include "idl/clocks.hh"
#include "sdk/behaviour/robot.h"
#include "sdk/cycle_client.h"
#include "sdk/held_instant.h"

namespace gsv::sdk {

class RemoteRobot final : public Robot, public std::enable_shared_from_this<RemoteRobot> {
 public:
  // Time limit of each remote call. The simulation waits up to a minute for an image, and may
  // itself be delayed by a busy machine or a stopped process.
  static constexpr std::chrono::milliseconds kCallTimeout{70'000};

  // Queries the robot's parts. Fails if the hardware does not answer. The robot is shared, because
  // a garbage-collected language such as Python may keep it beyond the run.
  static base::Result<std::shared_ptr<RemoteRobot>> Connect(const std::string& name,
                                                            sba::Hardware_ptr hardware);
  ~RemoteRobot() override;

  // Opens the clock, so that the simulation counts the behaviour as running before start() returns.
  base::Status OpenClock();
  // Ends the run in this process. Later waits and calls return at once, and a wait by the shared
  // memory that is in progress ends.
  void End();
  // Reports that the behaviour has finished. Called once, after the behaviour's last use of the
  // robot.
  void CloseClock();
  // Reports that the run has ended with an error, instead of CloseClock().
  void GiveUp(const std::string& reason);

  const std::string& name() const override { return name_; }
  double footprint_radius() const override { return footprint_radius_; }
  std::vector<SensorTraits> Sensors() override;
  std::vector<JointTraits> Joints() override;
  base::Result<std::unique_ptr<Joint>> OpenJoint(const std::string& joint) override;
  void Command(const DriveCommand& command) override;
  SimTime Now() override;
  bool SleepUntil(SimTime instant) override;
  bool Exchange(const DriveCommand& command, SimTime instant,
                std::vector<Reading>& readings) override;
  bool IsRunning() const override { return running_; }
  std::string error() const override;
  // OpenPort() opens a sensor of the robot's model. CreatePort() adds a new sensor and opens it.
  base::Result<std::unique_ptr<SensorPort>> OpenPort(const std::string& sensor) override;
  base::Result<std::unique_ptr<SensorPort>> CreatePort(SensorTraits traits) override;

  // Ends the run with an error.
  void Fail(const base::Error& error) { Note(error); }

  // Takes a reading of the sensor.
  bool Read(const std::string& sensor, sba::Sensor_ptr reference, Reading& reading);

  // Calls `call` unless the run is over. The caller handles kInvalidArgument. Any other failure
  // ends the run.
  template <typename Function>
  base::Status Ask(Function call) {
    if (!running_) return base::Fail(base::ErrorCode::kEnded, "the run is over", name_);
    auto status = orb::Call(name_, call);
    if (!status && status.error().code != base::ErrorCode::kInvalidArgument) Note(status.error());
    return status;
  }
  // Calls `call` unless the run is over. A failure ends the run. Returns true on success.
  template <typename Function>
  bool Try(Function call) {
    if (!running_) return false;
    const auto status = orb::Call(name_, call);
    if (!status) Note(status.error());
    return status.has_value();
  }

 private:
  RemoteRobot(std::string name, sba::Hardware_ptr hardware);
  // Ends the run, and stores its first error.
  void Note(const base::Error& error);
  // Sends a command to the base at once.
  void SendCommand(const DriveCommand& command);
  // Sends a command that was delayed.
  void Flush();
  // Opens the memory of the clock, if the simulation is on this host.
  void OpenMemory();
  // Sleeps like SleepUntil(), and gets the readings of used sensors with the same call.
  bool SleepAndRead(SimTime instant);
  // Runs a cycle by the shared memory. Returns true if it was answered. Otherwise the caller must
  // repeat the cycle by a remote call. `is_applied` becomes true if the simulation has applied the
  // command. The remote call must then not contain the command.
  bool RunCycle(const exchange::CycleRequest& request, const std::vector<std::string>& sensors,
                CycleClient::Answer& answer, bool& is_applied);

  const std::string name_;
  sba::Hardware_var hardware_;
  sba::SensorFactory_var factory_;  // opens and creates sensors
  sba::ActuatorProxy_var base_;     // takes commands to the base
  sba::Clock_var clock_;
  // Nil if the clock is no BatchClock, or if simulated time advances while the behaviour runs.
  sba::BatchClock_var batch_clock_;
  std::unique_ptr<CycleClient> cycles_;  // null: there is no shared memory
  CycleClient::Answer answer_;           // used by Exchange()
  HeldInstant held_;                     // readings and command of the current instant
  double footprint_radius_ = 0;          // m
  std::uint64_t cycle_ = 0;              // number of the last exchange
  std::atomic<bool> running_{true};      // false after the end of the run
  mutable base::Mutex error_mutex_;
  // The reason why the run has ended with an error; empty if there is none.
  std::string error_ GSV_GUARDED_BY(error_mutex_);
};

}  // namespace gsv::sdk
