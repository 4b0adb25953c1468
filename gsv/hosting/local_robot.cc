#include "gsv/hosting/local_robot.h"

#include <algorithm>

#include <boost/container/small_vector.hpp>

#include "gsv/base/check.h"
#include "gsv/hosting/local_joint.h"
#include "sdk/behaviour/finite.h"

namespace gsv::hosting {
namespace {

using simulation::MountedSensor;
using SensorPtr = std::shared_ptr<MountedSensor>;

Placement ToPlacement(const geometry::Pose& pose) {
  const auto angles = geometry::ToRollPitchYaw(pose.orientation);
  return {pose.position.x, pose.position.y, pose.position.z, angles.roll, angles.pitch, angles.yaw};
}

geometry::Pose ToPose(const Placement& p) {
  return {{p.x, p.y, p.z}, geometry::FromRollPitchYaw({p.roll, p.pitch, p.yaw})};
}

SensorTraits TraitsOf(const model::SensorDescription& description,
                      const geometry::Pose& robot_from_link) {
  return {description.name, description.type,
          ToPlacement(robot_from_link * description.link_from_sensor), description.update_rate,
          description.parameters};
}

// Below this number of beams, each beam is cast separately.
constexpr std::size_t kMinSweep = 3;

// A thread's buffer for the readings of the behaviour whose turn it executes. If the next behaviour
// has the same plan, the buffer already contains the names of its sensors, and is in the cache.
struct ThreadReadings {
  std::shared_ptr<const SweepPlan> plan;
  std::vector<Reading> readings;
};

void SetNames(const SweepPlan& plan, std::vector<Reading>& readings) {
  readings.resize(plan.names.size());
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (readings[i].sensor != plan.names[i]) readings[i].sensor = plan.names[i];
  }
}

void SetValue(double value, SimTime time, Reading& to) {
  to.time = time;
  if (to.values.size() != 1) to.values.resize(1);
  to.values.front() = value;
  if (!to.labels.empty()) to.labels.clear();
}

void Copy(const MountedSensor& sensor, const sensing::Reading& from, Reading& to) {
  if (to.sensor != sensor.name()) to.sensor = sensor.name();
  to.time = from.time;
  to.values.assign(from.values.begin(), from.values.end());
  to.labels.clear();
  if (from.labels != nullptr) to.labels = *from.labels;
}

class LocalPort final : public SensorPort {
 public:
  LocalPort(LocalRobot& robot, SensorPtr sensor, SensorTraits traits)
      : robot_(robot), sensor_(std::move(sensor)), traits_(std::move(traits)) {}

  const SensorTraits& traits() const override { return traits_; }

  bool Measure(Reading& reading) override {
    const auto measured = robot_.Read(*sensor_);
    reading.values.clear(), reading.labels.clear();
    if (measured) Copy(*sensor_, *measured, reading);
    return measured.has_value();
  }

  Image TakeImage() override {
    Image image;
    const auto reading = robot_.Read(*sensor_);
    if (!reading || reading->image == nullptr) return image;
    image.width = reading->image->width;
    image.height = reading->image->height;
    image.rgb = reading->image->pixels;
    return image;
  }

  base::Status Send(const std::string& receiver, const std::string& content) override {
    return robot_.Send(*sensor_, receiver, content);
  }

  base::Status CommandDevice(const std::vector<double>& values, const std::string& word) override {
    return robot_.CommandDevice(*sensor_, {values, word});
  }

  void Fail(const base::Error& error) override { robot_.Note(error); }

 private:
  LocalRobot& robot_;
  const SensorPtr sensor_;
  const SensorTraits traits_;
};

}  // namespace

void LocalRobot::Note(const base::Error& error) {
  // The error kEnded only says that the run is over, so it is not stored.
  if (is_running_.exchange(false) && error.code != base::ErrorCode::kEnded) {
    error_ = error.Sentence();
  }
}

void LocalRobot::SetTurn(simulation::Turn* turn) {
  turn_ = turn;
  if (turn_ != nullptr) turn_->ExpectRays(ray_sensors_);
}

void LocalRobot::PlanSweeps() {
  plan_ = std::make_shared<const SweepPlan>(open_);
  is_plan_shared_ = false;
  sweeps_ = std::make_shared<simulation::Sweeps>();
  for (std::size_t i = 0; i < open_.size(); ++i) {
    if (plan_->beam_of[i] != SweepPlan::kNoBeam) open_[i]->Join(sweeps_);
  }
}

std::optional<sensing::Reading> LocalRobot::Read(MountedSensor& sensor) {
  if (!is_running_) return std::nullopt;
  auto reading = turn_ == nullptr      ? agent_->Read(sensor.name())
                 : sensor.takes_long() ? ReadBlocked(sensor)
                                       : turn_->Read(sensor);
  if (reading && is_running_) return *std::move(reading);
  if (!reading) Note(reading.error());
  return std::nullopt;
}

base::Status LocalRobot::Send(const MountedSensor& radio, const std::string& receiver,
                              const std::string& content) {
  if (!is_running_) return base::Fail(base::ErrorCode::kEnded, "the run is over", name());
  auto status = turn_ != nullptr ? turn_->Send(radio, receiver, content)
                                 : agent_->Send(radio.name(), receiver, content);
  if (!status && status.error().code != base::ErrorCode::kInvalidArgument) Note(status.error());
  return status;
}

base::Status LocalRobot::CommandDevice(const MountedSensor& actuator,
                                       world::DeviceCommand command) {
  if (!is_running_) return base::Fail(base::ErrorCode::kEnded, "the run is over", name());
  auto status = turn_ != nullptr ? turn_->CommandDevice(actuator, std::move(command))
                                 : agent_->CommandDevice(actuator.name(), std::move(command));
  if (!status && status.error().code != base::ErrorCode::kInvalidArgument) Note(status.error());
  return status;
}

base::Result<sensing::Reading> LocalRobot::ReadBlocked(const MountedSensor& sensor) {
  GSV_CHECK(suspend_);
  // `reading` is on the heap, because the behaviour may end while the image is rendered. Then this
  // stack frame no longer exists.
  auto reading = std::make_shared<base::Result<sensing::Reading>>();
  turn_->Block([reading, agent = agent_, name = sensor.name()] { *reading = agent->Read(name); });
  suspend_();
  return is_running_ ? *reading : sensing::Reading();
}

bool LocalRobot::HasOnlyFastSensors() const {
  return std::none_of(open_.begin(), open_.end(),
                      [](const SensorPtr& sensor) { return sensor->takes_long(); });
}

bool LocalRobot::SweepInto(std::vector<Reading>& readings) {
  const sensing::BeamSet& beams = plan_->beams;
  if (turn_ == nullptr || beams.size() < kMinSweep) return false;
  if (!sweeps_->is_allowed.load(std::memory_order_relaxed)) return false;
  boost::container::small_vector<double, 16> values(beams.size(), boost::container::default_init);
  turn_->ReadBeams(beams, std::span(values.data(), values.size()));
  // Only this thread writes `count`, so no atomic increment is needed.
  auto& count = sweeps_->count;
  count.store(count.load(std::memory_order_relaxed) + 1, std::memory_order_relaxed);
  const SimTime time = turn_->snapshot_time();
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const std::size_t beam = plan_->beam_of[i];
    if (beam != SweepPlan::kNoBeam) SetValue(values[beam], time, readings[i]);
  }
  return true;
}

const std::vector<Reading>& LocalRobot::ReadOpenSensors() {
  static thread_local ThreadReadings of_thread;
  if (plan_ != nullptr && !is_plan_shared_) plan_ = Share(plan_), is_plan_shared_ = true;
  if (of_thread.plan != plan_) {
    of_thread.plan = plan_;
    if (plan_ != nullptr) SetNames(*plan_, of_thread.readings);
  }
  if (plan_ == nullptr) of_thread.readings.clear();
  if (is_running_ && plan_ != nullptr) ReadInto(of_thread.readings);
  return of_thread.readings;
}

void LocalRobot::ReadInto(std::vector<Reading>& readings) {
  const bool has_swept = SweepInto(readings);
  if (has_swept && plan_->HasOnlyBeams()) return;
  for (std::size_t i = 0; i < open_.size(); ++i) {
    if (has_swept && plan_->beam_of[i] != SweepPlan::kNoBeam) continue;
    const auto reading = Read(*open_[i]);
    if (!reading) return;
    Copy(*open_[i], *reading, readings[i]);
  }
}

std::vector<SensorTraits> LocalRobot::Sensors() {
  std::vector<SensorTraits> sensors;
  for (const model::SensorDescription& description : agent_->Sensors()) {
    sensors.push_back(TraitsOf(description, agent_->RobotFromLink(description.link)));
  }
  return sensors;
}

base::Result<std::unique_ptr<SensorPort>> LocalRobot::Enter(const std::string& sensor) {
  auto mounted = agent_->Mounted(sensor);
  if (!mounted) return base::Fail(mounted.error());
  const auto place =
      std::lower_bound(open_.begin(), open_.end(), sensor,
                       [](const SensorPtr& a, const std::string& b) { return a->name() < b; });
  if (place == open_.end() || (*place)->name() != sensor) {
    open_.insert(place, *mounted);
    if ((*mounted)->casts_rays()) ++ray_sensors_;
    PlanSweeps();
  }
  const model::SensorDescription& description = (*mounted)->design().description;
  SensorTraits traits = TraitsOf(description, agent_->RobotFromLink(description.link));
  return std::make_unique<LocalPort>(*this, *std::move(mounted), std::move(traits));
}

base::Result<std::unique_ptr<SensorPort>> LocalRobot::OpenPort(const std::string& sensor) {
  if (auto ok = agent_->OpenSensor(sensor); !ok) return base::Fail(ok.error());
  return Enter(sensor);
}

base::Result<std::unique_ptr<SensorPort>> LocalRobot::CreatePort(SensorTraits traits) {
  model::SensorDescription description;
  description.name = traits.name;
  description.type = traits.type;
  description.link_from_sensor =
      Inverse(agent_->RobotFromLink(0)) * ToPose(traits.robot_from_sensor);
  description.update_rate = traits.update_rate;
  description.parameters = std::move(traits.parameters);
  if (auto ok = agent_->CreateSensor(std::move(description)); !ok) return base::Fail(ok.error());
  return Enter(traits.name);
}

void LocalRobot::Command(const DriveCommand& command) {
  if (!is_running_) return;
  CheckDrive(command.linear, command.angular, command.lateral, name());
  const world::DriveCommand given{command.linear, command.lateral, command.angular};
  if (turn_ != nullptr) {
    turn_->Command(given);
  } else if (const auto ok = agent_->Command(given); !ok) {
    Note(ok.error());
  }
}

std::vector<JointTraits> LocalRobot::Joints() { return TraitsOf(agent_->Joints()); }

base::Result<std::unique_ptr<Joint>> LocalRobot::OpenJoint(const std::string& joint) {
  return MakeLocalJoint(*this, agent_->Joints(), joint);
}

void LocalRobot::CommandJoint(int joint, const world::JointCommand& command) {
  if (!is_running_) return;
  const auto ok =
      turn_ != nullptr ? turn_->CommandJoint(joint, command) : agent_->CommandJoint(joint, command);
  if (!ok) Note(ok.error());
}

std::optional<simulation::JointReading> LocalRobot::ReadJoint(int joint) {
  if (!is_running_) return std::nullopt;
  if (turn_ != nullptr) return turn_->ReadJoint(joint);
  const auto reading = agent_->ReadJoint(joint);
  if (reading) return *reading;
  Note(reading.error());
  return std::nullopt;
}

SimTime LocalRobot::Now() { return turn_ != nullptr ? turn_->now() : agent_->Now(); }

bool LocalRobot::SleepUntil(SimTime instant) {
  if (!is_running_ || turn_ == nullptr) return false;
  turn_->WaitUntil(instant);
  suspend_();
  return is_running_;
}

bool LocalRobot::Exchange(const DriveCommand& command, SimTime instant,
                          std::vector<Reading>& readings) {
  if (!is_running_ || turn_ == nullptr) return false;
  Command(command);
  if (!is_running_) return false;
  turn_->CountExchange();
  turn_->WaitUntil(instant);
  suspend_();
  if (!is_running_) return false;
  if (plan_ == nullptr) {
    readings.clear();
    return true;
  }
  SetNames(*plan_, readings);
  ReadInto(readings);
  return is_running_;
}

}  // namespace gsv::hosting
