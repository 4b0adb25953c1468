#include "sdk/remote_robot.h"

#include <cstring>

#include "gsv/orb/errors.h"

namespace gsv::sdk {
namespace {

Placement FromIdl(const sba::Placement& p) {
  return {p.x_m, p.y_m, p.z_m, p.roll_rad, p.pitch_rad, p.yaw_rad};
}

sba::Placement ToIdl(const Placement& p) { return {p.x, p.y, p.z, p.roll, p.pitch, p.yaw}; }

class RemoteSonar final : public Sonar {
 public:
  RemoteSonar(RemoteRobot& robot, sba::Sonar_ptr sonar, double max_range)
      : robot_(robot), sonar_(sba::Sonar::_duplicate(sonar)), max_range_(max_range) {}

  double Range() override {
    double range = max_range_;
    robot_.Try([&] { range = sonar_->range(); });
    return range;
  }
  double max_range() const override { return max_range_; }

 private:
  RemoteRobot& robot_;
  sba::Sonar_var sonar_;
  const double max_range_;
};

class RemoteCamera final : public Camera {
 public:
  RemoteCamera(RemoteRobot& robot, sba::Camera_ptr camera)
      : robot_(robot), camera_(sba::Camera::_duplicate(camera)) {}

  Picture TakePicture() override {
    Picture picture;
    robot_.Try([&] {
      const sba::Picture_var taken = camera_->take_picture();
      picture.width = static_cast<int>(taken->width);
      picture.height = static_cast<int>(taken->height);
      const sba::Octets& rgb = taken->rgb;
      picture.rgb.assign(rgb.get_buffer(), rgb.get_buffer() + rgb.length());
    });
    return picture;
  }

 private:
  RemoteRobot& robot_;
  sba::Camera_var camera_;
};

class RemotePositioningSystem final : public PositioningSystem {
 public:
  RemotePositioningSystem(RemoteRobot& robot, sba::PositioningSystem_ptr system)
      : robot_(robot), system_(sba::PositioningSystem::_duplicate(system)) {}

  Placement Locate() override {
    Placement placement;
    robot_.Try([&] { placement = FromIdl(system_->locate()); });
    return placement;
  }

 private:
  RemoteRobot& robot_;
  sba::PositioningSystem_var system_;
};

std::vector<Reading> FromIdl(const sba::Measurements& measurements) {
  std::vector<Reading> readings(measurements.length());
  for (CORBA::ULong i = 0; i < measurements.length(); ++i) {
    const sba::Doubles& values = measurements[i].values;
    readings[i].sensor = measurements[i].sensor_name;
    readings[i].time = SimTime(measurements[i].time_ns);
    readings[i].values.assign(values.get_buffer(), values.get_buffer() + values.length());
  }
  return readings;
}

}  // namespace

RemoteRobot::RemoteRobot(std::string name, sba::Hardware_ptr hardware)
    : name_(std::move(name)), hardware_(sba::Hardware::_duplicate(hardware)) {}

RemoteRobot::~RemoteRobot() = default;

base::Result<std::unique_ptr<RemoteRobot>> RemoteRobot::Connect(const std::string& name,
                                                                sba::Hardware_ptr hardware) {
  if (CORBA::is_nil(hardware)) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "was given no hardware", name);
  }
  std::unique_ptr<RemoteRobot> robot(new RemoteRobot(name, hardware));
  auto connected = orb::Call(name, [&] {
    robot->factory_ = robot->hardware_->sensor_factory();
    robot->base_ = robot->hardware_->base();
    robot->footprint_radius_ = robot->hardware_->footprint_radius_m();
  });
  if (!connected) return base::Fail(connected.error());
  return robot;
}

template <typename Function>
bool RemoteRobot::Try(Function call) {
  if (!running_) return false;
  const auto status = orb::Call(name_, call);
  if (!status) Note(status.error());
  return status.has_value();
}

void RemoteRobot::Note(const base::Error& error) {
  const std::lock_guard lock(error_mutex_);
  // The end of a run is no error.
  if (running_.exchange(false) && error.code != base::ErrorCode::kEnded) error_ = error.Sentence();
}

std::string RemoteRobot::error() const {
  const std::lock_guard lock(error_mutex_);
  return error_;
}

base::Status RemoteRobot::OpenClock() {
  return orb::Call(name_, [this] { clock_ = hardware_->open_clock(); });
}

void RemoteRobot::End() { running_ = false; }

void RemoteRobot::CloseClock() {
  // The simulation may be gone already; then there is nobody to tell.
  if (!CORBA::is_nil(clock_)) (void)orb::Call(name_, [this] { clock_->close(); });
}

std::vector<SensorTraits> RemoteRobot::Sensors() {
  std::vector<SensorTraits> sensors;
  Try([&] {
    const sba::SensorTraitsList_var list = factory_->list();
    for (CORBA::ULong i = 0; i < list->length(); ++i) {
      const sba::SensorTraits& traits = list.in()[i];
      sensors.push_back(
          {std::string(traits.name), std::string(traits.type), FromIdl(traits.mounting)});
    }
  });
  return sensors;
}

base::Status RemoteRobot::OpenSensor(const std::string& sensor) {
  return orb::Call(name_, [&] { sba::Sensor_var opened = factory_->open(sensor.c_str()); });
}

base::Result<std::unique_ptr<Sonar>> RemoteRobot::OpenSonar(const std::string& sensor) {
  return orb::Call(name_, [&]() -> std::unique_ptr<Sonar> {
    const sba::Sensor_var opened = factory_->open(sensor.c_str());
    const sba::Sonar_var sonar = sba::Sonar::_narrow(opened);
    if (CORBA::is_nil(sonar))
      throw sba::Refused(("the sensor \"" + sensor + "\" is no sonar").c_str());
    return std::make_unique<RemoteSonar>(*this, sonar, sonar->max_range());
  });
}

base::Result<std::unique_ptr<Camera>> RemoteRobot::OpenCamera(const std::string& sensor) {
  return orb::Call(name_, [&]() -> std::unique_ptr<Camera> {
    const sba::Sensor_var opened = factory_->open(sensor.c_str());
    const sba::Camera_var camera = sba::Camera::_narrow(opened);
    if (CORBA::is_nil(camera))
      throw sba::Refused(("the sensor \"" + sensor + "\" is no camera").c_str());
    return std::make_unique<RemoteCamera>(*this, camera);
  });
}

base::Result<std::unique_ptr<Sonar>> RemoteRobot::CreateSonar(const std::string& sensor,
                                                              const Placement& robot_from_sonar,
                                                              double min_range, double max_range) {
  return orb::Call(name_, [&]() -> std::unique_ptr<Sonar> {
    const sba::Sonar_var sonar =
        factory_->create_sonar(sensor.c_str(), ToIdl(robot_from_sonar), min_range, max_range);
    return std::make_unique<RemoteSonar>(*this, sonar, max_range);
  });
}

base::Result<std::unique_ptr<Camera>> RemoteRobot::CreateCamera(const std::string& sensor,
                                                                const Placement& robot_from_camera,
                                                                int width, int height,
                                                                double horizontal_fov) {
  return orb::Call(name_, [&]() -> std::unique_ptr<Camera> {
    const sba::Camera_var camera = factory_->create_camera(
        sensor.c_str(), ToIdl(robot_from_camera), static_cast<CORBA::ULong>(width),
        static_cast<CORBA::ULong>(height), horizontal_fov);
    return std::make_unique<RemoteCamera>(*this, camera);
  });
}

base::Result<std::unique_ptr<PositioningSystem>> RemoteRobot::CreatePositioningSystem(
    const std::string& sensor) {
  return orb::Call(name_, [&]() -> std::unique_ptr<PositioningSystem> {
    const sba::PositioningSystem_var system = factory_->create_positioning_system(sensor.c_str());
    return std::make_unique<RemotePositioningSystem>(*this, system);
  });
}

void RemoteRobot::Drive(double linear, double angular) {
  Try([&] { base_->drive(linear, angular); });
}

SimTime RemoteRobot::Now() {
  SimTime now{0};
  Try([&] { now = SimTime(clock_->now()); });
  return now;
}

bool RemoteRobot::SleepUntil(SimTime instant) {
  sba::WaitOutcome outcome = sba::NOT_YET;
  while (outcome == sba::NOT_YET) {
    if (!Try([&] { outcome = clock_->sleep_until(instant.count()); })) return false;
  }
  return true;
}

bool RemoteRobot::Exchange(const DriveCommand& command, SimTime instant,
                           std::vector<Reading>& readings) {
  const sba::BaseCommand given{true, command.linear, 0, command.angular};
  ++cycle_;
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
