#include "gsv/hosting/local_robot.h"

#include <algorithm>

#include "gsv/base/check.h"

namespace gsv::hosting {
namespace {

using simulation::MountedSensor;
using SensorPtr = std::shared_ptr<MountedSensor>;

const model::SensorDescription& DescriptionOf(const MountedSensor& sensor) {
  return sensor.design().description;
}

Placement ToPlacement(const geometry::Pose& pose) {
  const auto angles = geometry::ToRollPitchYaw(pose.orientation);
  return {pose.position.x, pose.position.y, pose.position.z, angles.roll, angles.pitch, angles.yaw};
}

geometry::Pose ToPose(const Placement& p) {
  return {{p.x, p.y, p.z}, geometry::FromRollPitchYaw({p.roll, p.pitch, p.yaw})};
}

class LocalSonar final : public Sonar {
 public:
  LocalSonar(LocalRobot& robot, SensorPtr sensor)
      : robot_(robot),
        sensor_(std::move(sensor)),
        max_range_(model::NumberOr(DescriptionOf(*sensor_).parameters, "max", 0.0)) {}

  double Range() override {
    const auto reading = robot_.Read(*sensor_);
    return reading ? reading->values.at(0) : max_range_;
  }
  double max_range() const override { return max_range_; }

 private:
  LocalRobot& robot_;
  const SensorPtr sensor_;
  const double max_range_;
};

class LocalCamera final : public Camera {
 public:
  LocalCamera(LocalRobot& robot, SensorPtr sensor) : robot_(robot), sensor_(std::move(sensor)) {}

  Picture TakePicture() override {
    Picture picture;
    const auto reading = robot_.Read(*sensor_);
    if (!reading || reading->picture == nullptr) return picture;
    picture.width = reading->picture->width;
    picture.height = reading->picture->height;
    picture.rgb = reading->picture->pixels;
    return picture;
  }

 private:
  LocalRobot& robot_;
  const SensorPtr sensor_;
};

class LocalPositioningSystem final : public PositioningSystem {
 public:
  LocalPositioningSystem(LocalRobot& robot, SensorPtr sensor)
      : robot_(robot), sensor_(std::move(sensor)) {}

  Placement Locate() override {
    const auto reading = robot_.Read(*sensor_);
    if (!reading) return {};
    const auto& v = reading->values;
    return {v.at(0), v.at(1), v.at(2), v.at(3), v.at(4), v.at(5)};
  }

 private:
  LocalRobot& robot_;
  const SensorPtr sensor_;
};

}  // namespace

void LocalRobot::Note(const base::Error& error) {
  // The end of a run is no error.
  if (is_running_.exchange(false) && error.code != base::ErrorCode::kEnded) {
    error_ = error.Sentence();
  }
}

void LocalRobot::SetTurn(simulation::Turn* turn) {
  turn_ = turn;
  if (turn_ != nullptr) turn_->ExpectRays(ray_sensors_);
}

std::optional<sensing::Reading> LocalRobot::Read(MountedSensor& sensor) {
  if (!is_running_) return std::nullopt;
  const auto reading = turn_ == nullptr      ? agent_->Read(sensor.name())
                       : sensor.takes_long() ? ReadBlocked(sensor)
                                             : turn_->Read(sensor);
  if (reading && is_running_) return *reading;
  if (!reading) Note(reading.error());
  return std::nullopt;
}

base::Result<sensing::Reading> LocalRobot::ReadBlocked(const MountedSensor& sensor) {
  GSV_CHECK(suspend_);
  // The behaviour may be ended while the picture is under way: then nobody waits for it here.
  auto reading = std::make_shared<base::Result<sensing::Reading>>();
  turn_->Block([reading, agent = agent_, name = sensor.name()] { *reading = agent->Read(name); });
  suspend_();
  return is_running_ ? *reading : sensing::Reading();
}

bool LocalRobot::HasOnlyQuickSensors() const {
  return std::none_of(open_.begin(), open_.end(),
                      [](const SensorPtr& sensor) { return sensor->takes_long(); });
}

void LocalRobot::ReadOpenSensors(std::vector<Reading>& readings) {
  readings.resize(open_.size());
  for (std::size_t i = 0; i < open_.size(); ++i) {
    const auto reading = Read(*open_[i]);
    if (!reading) return;
    if (readings[i].sensor != open_[i]->name()) readings[i].sensor = open_[i]->name();
    readings[i].time = reading->time;
    readings[i].values.assign(reading->values.begin(), reading->values.end());
  }
}

std::vector<SensorTraits> LocalRobot::Sensors() {
  std::vector<SensorTraits> sensors;
  for (const model::SensorDescription& description : agent_->Sensors()) {
    const geometry::Pose robot_from_sensor =
        agent_->RobotFromLink(description.link) * description.link_from_sensor;
    sensors.push_back({description.name, description.type, ToPlacement(robot_from_sensor)});
  }
  return sensors;
}

base::Status LocalRobot::Enter(const std::string& sensor) {
  auto mounted = agent_->Mounted(sensor);
  if (!mounted) return base::Fail(mounted.error());
  const auto place =
      std::lower_bound(open_.begin(), open_.end(), sensor,
                       [](const SensorPtr& a, const std::string& b) { return a->name() < b; });
  if (place != open_.end() && (*place)->name() == sensor) return {};
  open_.insert(place, *mounted);
  if ((*mounted)->casts_rays()) ++ray_sensors_;
  return {};
}

base::Status LocalRobot::OpenSensor(const std::string& sensor) {
  if (auto ok = agent_->OpenSensor(sensor); !ok) return ok;
  return Enter(sensor);
}

base::Result<SensorPtr> LocalRobot::Open(const std::string& sensor, const std::string& type) {
  if (auto ok = OpenSensor(sensor); !ok) return base::Fail(ok.error());
  auto mounted = agent_->Mounted(sensor);
  if (mounted && DescriptionOf(**mounted).type != type) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the sensor \"" + sensor + "\" is no " + type, name());
  }
  return mounted;
}

base::Result<std::unique_ptr<Sonar>> LocalRobot::OpenSonar(const std::string& sensor) {
  auto mounted = Open(sensor, "sonar");
  if (!mounted) return base::Fail(mounted.error());
  return std::make_unique<LocalSonar>(*this, *std::move(mounted));
}

base::Result<std::unique_ptr<Camera>> LocalRobot::OpenCamera(const std::string& sensor) {
  auto mounted = Open(sensor, "camera");
  if (!mounted) return base::Fail(mounted.error());
  return std::make_unique<LocalCamera>(*this, *std::move(mounted));
}

base::Result<SensorPtr> LocalRobot::Create(const std::string& type, const std::string& sensor,
                                           const Placement& robot_from_sensor,
                                           model::Parameters parameters) {
  model::SensorDescription description;
  description.name = sensor;
  description.type = type;
  description.link_from_sensor = Inverse(agent_->RobotFromLink(0)) * ToPose(robot_from_sensor);
  description.parameters = std::move(parameters);
  if (auto ok = agent_->CreateSensor(std::move(description)); !ok) return base::Fail(ok.error());
  if (auto ok = Enter(sensor); !ok) return base::Fail(ok.error());
  return agent_->Mounted(sensor);
}

base::Result<std::unique_ptr<Sonar>> LocalRobot::CreateSonar(const std::string& sensor,
                                                             const Placement& robot_from_sonar,
                                                             double min_range, double max_range) {
  auto mounted =
      Create("sonar", sensor, robot_from_sonar, {{"min", min_range}, {"max", max_range}});
  if (!mounted) return base::Fail(mounted.error());
  return std::make_unique<LocalSonar>(*this, *std::move(mounted));
}

base::Result<std::unique_ptr<Camera>> LocalRobot::CreateCamera(const std::string& sensor,
                                                               const Placement& robot_from_camera,
                                                               int width, int height,
                                                               double horizontal_fov) {
  auto mounted = Create("camera", sensor, robot_from_camera,
                        {{"image.width", static_cast<double>(width)},
                         {"image.height", static_cast<double>(height)},
                         {"horizontal_fov", horizontal_fov}});
  if (!mounted) return base::Fail(mounted.error());
  return std::make_unique<LocalCamera>(*this, *std::move(mounted));
}

base::Result<std::unique_ptr<PositioningSystem>> LocalRobot::CreatePositioningSystem(
    const std::string& sensor) {
  auto mounted = Create("positioning", sensor, {}, {});
  if (!mounted) return base::Fail(mounted.error());
  return std::make_unique<LocalPositioningSystem>(*this, *std::move(mounted));
}

void LocalRobot::Command(const DriveCommand& command) {
  const world::DriveCommand given{command.linear, 0, command.angular};
  if (!world::IsFinite(given)) {
    return Note({base::ErrorCode::kInvalidArgument, "the command is not finite", name()});
  }
  if (turn_ != nullptr) {
    turn_->Command(given);
  } else if (const auto ok = agent_->Command(given); !ok) {
    Note(ok.error());
  }
}

void LocalRobot::Drive(double linear, double angular) {
  if (is_running_) Command({linear, angular});
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
  if (is_running_) ReadOpenSensors(readings);
  return is_running_;
}

}  // namespace gsv::hosting
