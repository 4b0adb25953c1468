#include "gsv/reality/simulated_device.h"

#include <algorithm>
#include <cmath>

#include "gsv/sensing/devices/built_in.h"
#include "gsv/sensing/registry.h"
#include "gsv/world/snapshot.h"

namespace gsv::reality {
namespace {

constexpr const char* kRobot = "robot";

std::shared_ptr<world::Snapshot> WithRobot(const model::WorldDescription& description,
                                           const std::vector<model::SensorDescription>& sensors) {
  std::vector<world::Body> bodies;
  for (const model::PlacedModel& placed : description.models) {
    world::Body body;
    body.name = placed.name;
    body.model = placed.model;
    body.initial_pose = placed.world_from_model;
    body.kind = world::KindOf(placed);
    if (!body.is_robot() && body.name != kRobot) bodies.push_back(std::move(body));
  }
  auto model = std::make_shared<model::Model>();
  model->name = kRobot;
  model->links.resize(1);
  model->sensors = sensors;
  world::Body robot;
  robot.name = kRobot;
  robot.model = model;
  robot.kind = world::BodyKind::kUnmoved;
  bodies.push_back(robot);
  auto snapshot = std::make_shared<world::Snapshot>();
  snapshot->layout = world::MakeLayout(
      1, std::move(bodies), std::make_shared<const model::WorldDescription>(description));
  snapshot->state = world::InitialState(*snapshot->layout);
  return snapshot;
}

}  // namespace

base::Result<SimulatedDevice> SimulatedDevice::Create(const model::WorldDescription& world,
                                                      std::vector<model::SensorDescription> sensors,
                                                      std::uint64_t seed) {
  SimulatedDevice device;
  device.seed_ = seed;
  device.first_ = WithRobot(world, sensors);
  device.body_ = device.first_->layout->Find(kRobot);
  device.rays_ = std::make_unique<sensing::RaySceneCache>();
  sensing::SensorRegistry registry;
  sensing::AddBuiltInSensors(registry);
  for (model::SensorDescription& description : sensors) {
    auto sensor = registry.Find(description.type)->create(description);
    if (!sensor) return base::Fail(sensor.error());
    device.sensors_.push_back(*std::move(sensor));
  }
  return device;
}

std::vector<double> SimulatedDevice::Read(const TimedPose& pose, std::int64_t step) {
  auto now = std::make_shared<world::Snapshot>(*first_);
  now->state.step = step;
  now->state.time = base::FromSeconds(std::max(0.0, pose.time));
  now->state.bodies[static_cast<std::size_t>(body_)].world_from_model =
      geometry::PlanarPose(pose.x, pose.y, 0, pose.yaw);
  const sensing::Sampling sampling(now, body_, seed_, *rays_);
  std::vector<double> values;
  for (const auto& sensor : sensors_) {
    const auto reading = sensor->Sample(sampling);
    if (!reading) continue;
    values.insert(values.end(), reading->values.begin(), reading->values.end());
  }
  return values;
}

std::vector<model::SensorDescription> SensorsOf(const Log& log, const std::string& preset,
                                                const model::Parameters& parameters,
                                                double height) {
  std::vector<model::SensorDescription> sensors;
  const auto add = [&](const std::string& type, const std::string& name, double yaw,
                       model::Parameters own) {
    model::SensorDescription sensor;
    sensor.type = type;
    sensor.name = name;
    sensor.link_from_sensor = geometry::PlanarPose(log.sensor_forward, 0, height, yaw);
    own.insert(parameters.begin(), parameters.end());
    if (!preset.empty()) own.emplace("preset", preset);
    sensor.parameters = std::move(own);
    sensors.push_back(std::move(sensor));
  };
  if (log.is_sonar) {
    for (std::size_t i = 0; i < log.beam_angles.size(); ++i) {
      add("sonar", "sonar_" + std::to_string(i), log.beam_angles[i], {{"max", log.max_range}});
    }
  } else if (!log.beam_angles.empty()) {
    add("lidar", "lidar", 0,
        {{"scan.horizontal.samples", static_cast<double>(log.beam_angles.size())},
         {"scan.horizontal.min_angle", log.beam_angles.front()},
         {"scan.horizontal.max_angle", log.beam_angles.back()},
         {"range.max", log.max_range}});
  }
  return sensors;
}

}  // namespace gsv::reality
