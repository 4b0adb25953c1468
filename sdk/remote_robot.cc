#include "sdk/remote_robot.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <cstdlib>
#include <string_view>

#include "gsv/orb/orb.h"
#include "idl/actuators.hh"
#include "idl/sensors.hh"
#include "sdk/behaviour/finite.h"
#include "sdk/remote_joint.h"

namespace gsv::sdk {
namespace {

Placement FromIdl(const sba::Placement& p) {
  return {p.x_m, p.y_m, p.z_m, p.roll_rad, p.pitch_rad, p.yaw_rad};
}

sba::Placement ToIdl(const Placement& p) { return {p.x, p.y, p.z, p.roll, p.pitch, p.yaw}; }

// Parses the text of a parameter as a value.
Parameters::mapped_type ValueOf(const std::string& text) {
  if (text == "true") return true;
  if (text == "false") return false;
  double number = 0;
  const char* const end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, number);
  if (!text.empty() && parsed.ec == std::errc() && parsed.ptr == end) return number;
  return text;
}

std::string TextOf(const Parameters::mapped_type& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const std::string* text = std::get_if<std::string>(&value)) return *text;
  char text[32];
  const auto written = std::to_chars(text, text + sizeof text, std::get<double>(value));
  return {text, written.ptr};
}

SensorTraits FromIdl(const sba::SensorTraits& idl) {
  SensorTraits traits{
      std::string(idl.name), std::string(idl.type), FromIdl(idl.mounting), idl.update_rate_hz, {}};
  for (CORBA::ULong i = 0; i < idl.parameters.length(); ++i) {
    const sba::NameValue& parameter = idl.parameters[i];
    traits.parameters.emplace(parameter.name, ValueOf(std::string(parameter.value)));
  }
  return traits;
}

sba::SensorTraits ToIdl(const SensorTraits& traits) {
  sba::SensorTraits idl;
  idl.name = traits.name.c_str();
  idl.type = traits.type.c_str();
  idl.mounting = ToIdl(traits.robot_from_sensor);
  idl.update_rate_hz = traits.update_rate;
  idl.parameters.length(static_cast<CORBA::ULong>(traits.parameters.size()));
  CORBA::ULong i = 0;
  for (const auto& [name, value] : traits.parameters) {
    idl.parameters[i].name = name.c_str();
    idl.parameters[i++].value = TextOf(value).c_str();
  }
  return idl;
}

void Copy(const sba::Measurement& from, Reading& to) {
  to.sensor = from.sensor_name;
  to.time = SimTime(from.time_ns);
  to.values.assign(from.values.get_buffer(), from.values.get_buffer() + from.values.length());
  to.labels.clear();
  for (CORBA::ULong i = 0; i < from.labels.length(); ++i) to.labels.emplace_back(from.labels[i]);
}

class RemotePort final : public SensorPort {
 public:
  RemotePort(RemoteRobot& robot, sba::Sensor_ptr sensor, SensorTraits traits)
      : robot_(robot), sensor_(sba::Sensor::_duplicate(sensor)), traits_(std::move(traits)) {
    orb::LimitCalls(sensor_, RemoteRobot::kCallTimeout);
  }

  const SensorTraits& traits() const override { return traits_; }

  bool Measure(Reading& reading) override { return robot_.Read(traits_.name, sensor_, reading); }

  Image TakeImage() override {
    Image image;
    robot_.Try([&] {
      const sba::Measurement_var taken = sensor_->measure();
      image.width = static_cast<int>(taken->image_width);
      image.height = static_cast<int>(taken->image_height);
      const sba::Octets& rgb = taken->image;
      image.rgb.assign(rgb.get_buffer(), rgb.get_buffer() + rgb.length());
    });
    return image;
  }

  base::Status Send(const std::string& receiver, const std::string& content) override {
    return robot_.Ask([&] {
      const sba::Radio_var radio = sba::Radio::_narrow(sensor_);
      if (CORBA::is_nil(radio)) throw sba::Refused("cannot send a message: only a radio can");
      sba::Octets octets(static_cast<CORBA::ULong>(content.size()));
      octets.length(octets.maximum());
      std::copy(content.begin(), content.end(), octets.get_buffer());
      radio->send(receiver.c_str(), octets);
    });
  }

  base::Status CommandDevice(const std::vector<double>& values, const std::string& word) override {
    return robot_.Ask([&] {
      const sba::Actuator_var actuator = sba::Actuator::_narrow(sensor_);
      if (CORBA::is_nil(actuator)) throw sba::Refused("a sensor accepts no commands");
      sba::Doubles numbers(static_cast<CORBA::ULong>(values.size()));
      numbers.length(numbers.maximum());
      std::copy(values.begin(), values.end(), numbers.get_buffer());
      actuator->act(numbers, word.c_str());
    });
  }

  void Fail(const base::Error& error) override { robot_.Fail(error); }

 private:
  RemoteRobot& robot_;
  sba::Sensor_var sensor_;
  const SensorTraits traits_;
};

std::vector<Reading> FromIdl(const sba::Measurements& measurements) {
  std::vector<Reading> readings(measurements.length());
  for (CORBA::ULong i = 0; i < measurements.length(); ++i) {
    Copy(measurements[i], readings[i]);
  }
  return readings;
}

}  // namespace

RemoteRobot::RemoteRobot(std::string name, sba::Hardware_ptr hardware)
    : name_(std::move(name)), hardware_(sba::Hardware::_duplicate(hardware)) {}

RemoteRobot::~RemoteRobot() = default;

base::Result<std::shared_ptr<RemoteRobot>> RemoteRobot::Connect(const std::string& name,
                                                                sba::Hardware_ptr hardware) {
  if (CORBA::is_nil(hardware)) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "init() was called without hardware",
                      name);
  }
  std::shared_ptr<RemoteRobot> robot(new RemoteRobot(name, hardware));
  orb::LimitCalls(robot->hardware_, kCallTimeout);
  auto connected = orb::Call(name, [&] {
    robot->factory_ = robot->hardware_->sensor_factory();
    robot->base_ = robot->hardware_->base();
    robot->footprint_radius_ = robot->hardware_->footprint_radius_m();
    orb::LimitCalls(robot->factory_, kCallTimeout);
    orb::LimitCalls(robot->base_, kCallTimeout);
  });
  if (!connected) return base::Fail(connected.error());
  return robot;
}

void RemoteRobot::Note(const base::Error& error) {
  const base::MutexLock lock(error_mutex_);
  // The end of a run is not an error.
  if (running_.exchange(false) && error.code != base::ErrorCode::kEnded) error_ = error.Sentence();
}

std::string RemoteRobot::error() const {
  const base::MutexLock lock(error_mutex_);
  return error_;
}

base::Status RemoteRobot::OpenClock() {
  return orb::Call(name_, [this] {
    clock_ = hardware_->open_clock();
    orb::LimitCalls(clock_, kCallTimeout);
    batch_clock_ = sba::BatchClock::_narrow(clock_);
    if (!CORBA::is_nil(batch_clock_)) orb::LimitCalls(batch_clock_, kCallTimeout);
    OpenMemory();
  });
}

void RemoteRobot::OpenMemory() {
  const char* const setting = std::getenv("GSV_SHARED_MEMORY");
  if (setting != nullptr && std::string_view(setting) == "0") return;
  const sba::SharedClock_var shared = sba::SharedClock::_narrow(clock_);
  if (CORBA::is_nil(shared)) return;
  orb::LimitCalls(shared, kCallTimeout);
  const auto memory = [&]() -> base::Result<sba::CycleMemory> {
    sba::CycleMemory answer{};
    if (auto ok = orb::Call(name_, [&] { answer = shared->share_memory(); }); !ok) {
      return base::Fail(ok.error());
    }
    return answer;
  }();
  if (!memory) return;  // without the shared memory, each cycle is a remote call
  auto opened =
      CycleClient::Open({memory->process, memory->descriptor}, memory->offset, memory->key);
  if (opened) cycles_ = *std::move(opened);
}

void RemoteRobot::End() {
  running_ = false;
  if (cycles_ != nullptr) cycles_->Interrupt();
}

bool RemoteRobot::RunCycle(const exchange::CycleRequest& request,
                           const std::vector<std::string>& sensors, CycleClient::Answer& answer,
                           bool& is_applied) {
  is_applied = false;
  if (cycles_ == nullptr || !running_) return false;
  const CycleClient::Outcome outcome = cycles_->Run(request, sensors, answer);
  is_applied = outcome == CycleClient::Outcome::kRepeatApplied;
  return outcome == CycleClient::Outcome::kAnswered;
}

void RemoteRobot::CloseClock() {
  Flush();
  // The call may fail, because the clock does not exist after the end of the simulation.
  if (!CORBA::is_nil(clock_)) (void)orb::Call(name_, [this] { clock_->close(); });
}

void RemoteRobot::GiveUp(const std::string& reason) {
  if (CORBA::is_nil(clock_)) return;
  const auto told = orb::Call(name_, [&] { clock_->give_up(reason.c_str()); });
  if (!told) CloseClock();  // older simulations have no give_up() and report a normal end
}

std::vector<SensorTraits> RemoteRobot::Sensors() {
  std::vector<SensorTraits> sensors;
  Try([&] {
    const sba::SensorTraitsList_var list = factory_->list();
    for (CORBA::ULong i = 0; i < list->length(); ++i) sensors.push_back(FromIdl(list.in()[i]));
  });
  return sensors;
}

base::Result<std::unique_ptr<SensorPort>> RemoteRobot::OpenPort(const std::string& sensor) {
  return orb::Call(name_, [&]() -> std::unique_ptr<SensorPort> {
    const sba::Sensor_var opened = factory_->open(sensor.c_str());
    const sba::SensorTraits_var traits = opened->traits();
    return std::make_unique<RemotePort>(*this, opened, FromIdl(traits.in()));
  });
}

base::Result<std::unique_ptr<SensorPort>> RemoteRobot::CreatePort(SensorTraits traits) {
  return orb::Call(name_, [&]() -> std::unique_ptr<SensorPort> {
    const sba::Sensor_var created = factory_->create(traits.type.c_str(), ToIdl(traits));
    return std::make_unique<RemotePort>(*this, created, std::move(traits));
  });
}

std::vector<JointTraits> RemoteRobot::Joints() {
  std::vector<JointTraits> joints;
  Try([&] { joints = ListRemoteJoints(hardware_); });
  return joints;
}

base::Result<std::unique_ptr<Joint>> RemoteRobot::OpenJoint(const std::string& joint) {
  return orb::Call(name_, [&] { return OpenRemoteJoint(*this, hardware_, joint); });
}

bool RemoteRobot::Read(const std::string& sensor, sba::Sensor_ptr reference, Reading& reading) {
  reading.values.clear(), reading.labels.clear();
  if (!running_) return false;
  if (held_.Read(sensor, reading)) return true;
  return Try([&] {
    const sba::Measurement_var measured = reference->measure();
    Copy(measured.in(), reading);
  });
}

void RemoteRobot::Command(const DriveCommand& command) {
  CheckDrive(command.linear, command.angular, command.lateral, name_);
  if (running_ && !held_.Delay(command)) SendCommand(command);
}

void RemoteRobot::Flush() {
  if (const auto command = held_.TakeCommand()) SendCommand(*command);
}

void RemoteRobot::SendCommand(const DriveCommand& command) {
  Try([&] {
    if (command.lateral == 0) {
      base_->drive(command.linear, command.angular);
    } else {
      base_->drive_sideways(command.linear, command.lateral, command.angular);
    }
  });
}

SimTime RemoteRobot::Now() {
  if (!running_) return SimTime(0);
  if (const auto held = held_.now()) return *held;
  SimTime now{0};
  Try([&] { now = SimTime(clock_->now()); });
  return now;
}

bool RemoteRobot::SleepUntil(SimTime instant) {
  if (!CORBA::is_nil(batch_clock_)) return SleepAndRead(instant);
  sba::WaitOutcome outcome = sba::NOT_YET;
  while (outcome == sba::NOT_YET) {
    if (!Try([&] { outcome = clock_->sleep_until(instant.count()); })) return false;
  }
  return true;
}

bool RemoteRobot::SleepAndRead(SimTime instant) {
  const HeldInstant::Wait wait = held_.End();
  const DriveCommand command = wait.command.value_or(DriveCommand());
  bool is_applied = false;
  CycleClient::Answer answer;
  if (RunCycle({0, instant.count(), command.linear, command.lateral, command.angular,
                wait.command.has_value(), 0},
               wait.sensors, answer, is_applied)) {
    held_.Begin(answer.reached, std::move(answer.readings));
    return true;
  }
  sba::BaseCommand given{wait.command.has_value() && !is_applied, command.linear, command.lateral,
                         command.angular};
  sba::Strings sensors;
  sensors.length(static_cast<CORBA::ULong>(wait.sensors.size()));
  for (CORBA::ULong i = 0; i < sensors.length(); ++i) sensors[i] = wait.sensors[i].c_str();
  sba::WaitOutcome outcome = sba::NOT_YET;
  CORBA::LongLong reached = 0;
  CORBA::Boolean holds_time = false;
  std::vector<Reading> readings;
  while (outcome == sba::NOT_YET) {
    const bool ok = Try([&] {
      sba::Measurements_var measurements;
      outcome = batch_clock_->sleep_and_read(given, instant.count(), sensors, reached, holds_time,
                                             measurements.out());
      readings = FromIdl(measurements.in());
    });
    if (!ok) return false;
    given.given = false;
  }
  if (holds_time) {
    held_.Begin(SimTime(reached), std::move(readings));
  } else {
    // In real time, simulated time advances while the behaviour runs. Readings would then be old,
    // so later waits use the plain clock.
    batch_clock_ = sba::BatchClock::_nil();
  }
  return true;
}

bool RemoteRobot::Exchange(const DriveCommand& command, SimTime instant,
                           std::vector<Reading>& readings) {
  CheckDrive(command.linear, command.angular, command.lateral, name_);
  const sba::BaseCommand given{true, command.linear, command.lateral, command.angular};
  Flush();
  (void)held_.End();
  ++cycle_;
  bool is_applied = false;
  answer_.readings.swap(readings);
  const bool is_answered =
      RunCycle({cycle_, instant.count(), command.linear, command.lateral, command.angular, 1, 0},
               {}, answer_, is_applied);
  answer_.readings.swap(readings);
  if (is_answered) return true;
  // A repeated cycle has the same number, so its command is not applied twice.
  sba::WaitOutcome outcome = sba::NOT_YET;
  while (outcome == sba::NOT_YET) {
    const bool ok = Try([&] {
      CORBA::LongLong reached = 0;
      sba::Measurements_var measurements;
      outcome = clock_->exchange(cycle_, given, instant.count(), reached, measurements.out());
      if (outcome == sba::REACHED) readings = FromIdl(measurements.in());
    });
    if (!ok) return false;
  }
  return true;
}

}  // namespace gsv::sdk
