#include "gsv/recording/sensor_topics.h"

#include <cmath>
#include <optional>
#include <utility>

#include "gsv/base/log.h"
#include "gsv/messages/sensor_msgs.h"
#include "gsv/presentation/state_messages.h"
#include "gsv/sensing/encoding.h"

namespace gsv::recording {
namespace {

// Every n-th instant of the sensor, n as small as `rate` allows.
base::SimTime PeriodOf(const model::SensorDescription& description, double rate) {
  if (description.update_rate <= 0) return base::FromSeconds(1 / rate);
  const base::SimTime own = base::FromSeconds(1 / description.update_rate);
  return own * static_cast<std::int64_t>(std::ceil(description.update_rate / rate - 1e-9));
}

bool SameDescription(const model::SensorDescription& a, const model::SensorDescription& b) {
  return a.name == b.name && a.type == b.type && a.link == b.link &&
         a.link_from_sensor == b.link_from_sensor && a.update_rate == b.update_rate &&
         a.parameters == b.parameters;
}

}  // namespace

struct SensorTopics::Sensor {
  std::string robot;
  model::SensorDescription description;
  const sensing::SensorType* type = nullptr;
  std::unique_ptr<sensing::Sensor> sensor;
  Instants instants;
  bool is_wanted = true;                       // else it is read for its beams alone
  std::optional<ChannelId> channel;            // once there was a reading
  std::optional<ChannelId> companion_channel;  // the same, where the type has one
  std::optional<sensing::Reading> newest;
  bool has_failed = false;
};

SensorTopics::SensorTopics(McapWriter& writer, std::shared_ptr<const sensing::SensorRegistry> types,
                           std::uint64_t seed, SensorTopicOptions options)
    : writer_(writer),
      types_(std::move(types)),
      seed_(seed),
      options_(std::move(options)),
      beams_instants_(base::FromSeconds(1 / options_.rates.beams)),
      beams_(writer, options_.selection, "/gsv/beams"),
      transforms_(writer, options_.selection, "/tf_static") {}

SensorTopics::~SensorTopics() = default;

void SensorTopics::Mount(const SensorLists& lists, const world::Snapshot& snapshot) {
  Sensors found;
  for (const auto& [robot, list] : lists) {
    for (const model::SensorDescription& description : list) {
      const std::string topic = "/" + presentation::FrameOf(robot, description.name);
      const auto known = sensors_.find(topic);
      if (known != sensors_.end() && SameDescription(known->second->description, description)) {
        found.insert(*known);
      } else if (std::shared_ptr<Sensor> sensor = Make(robot, description)) {
        found.emplace(topic, std::move(sensor));
      }
    }
  }
  if (found == sensors_) return;
  sensors_ = std::move(found);
  WriteTransforms(snapshot);
}

std::shared_ptr<SensorTopics::Sensor> SensorTopics::Make(
    const std::string& robot, const model::SensorDescription& description) {
  const sensing::SensorType* type = types_->Find(description.type);
  if (type == nullptr || type->schema == nullptr) return nullptr;
  const bool is_wanted =
      options_.selection.Has("/" + presentation::FrameOf(robot, description.name));
  const bool has_beams = beams_.is_wanted() && presentation::HasLines(*type, description);
  if (!is_wanted && !has_beams) return nullptr;
  auto sensor = type->create(description);
  if (!sensor) {
    Complain(sensor.error());
    return nullptr;
  }
  const double rate = (*sensor)->TakesLong() ? options_.rates.pictures : options_.rates.readings;
  return std::make_shared<Sensor>(Sensor{robot,
                                         description,
                                         type,
                                         *std::move(sensor),
                                         Instants(PeriodOf(description, rate)),
                                         is_wanted,
                                         {},
                                         {},
                                         {},
                                         false});
}

void SensorTopics::Record(const std::shared_ptr<const world::Snapshot>& snapshot) {
  for (const auto& [topic, sensor] : sensors_) {
    if (!sensor->instants.Pass(snapshot->state.time) || sensor->has_failed) continue;
    const int body = snapshot->layout->Find(sensor->robot);
    if (body >= 0) Sample(topic, *sensor, snapshot, body);
  }
  if (beams_instants_.Pass(snapshot->state.time) && beams_.is_wanted()) WriteBeams(*snapshot);
}

void SensorTopics::Sample(const std::string& topic, Sensor& sensor,
                          const std::shared_ptr<const world::Snapshot>& snapshot, int body) {
  base::Result<sensing::Reading> reading = sensor.sensor->Sample({snapshot, body, seed_, rays_});
  if (!reading) {
    sensor.has_failed = true;
    return Complain(reading.error());
  }
  if (!sensor.is_wanted) {
    sensor.newest = *std::move(reading);
    return;
  }
  if (!sensor.channel) {
    const auto channel = writer_.AddChannel(topic, *sensor.type->schema);
    if (!channel) {
      sensor.has_failed = true;
      return Complain(channel.error());
    }
    sensor.channel = *channel;
    sensor.companion_channel = AddCompanion(topic, *sensor.type);
  }
  const std::vector<std::uint8_t> message = Encode(sensor, *reading);
  writer_.Write(*sensor.channel, reading->time, std::as_bytes(std::span(message)));
  if (sensor.companion_channel) {
    const std::vector<std::uint8_t> companion = sensor.type->companion->encode(
        sensor.description, *reading, presentation::FrameOf(sensor.robot, sensor.description.name));
    writer_.Write(*sensor.companion_channel, reading->time, std::as_bytes(std::span(companion)));
  }
  sensor.newest = *std::move(reading);
}

std::optional<ChannelId> SensorTopics::AddCompanion(const std::string& topic,
                                                    const sensing::SensorType& type) {
  if (!type.companion) return std::nullopt;
  const std::string companion = topic + "/" + type.companion->topic;
  if (!options_.selection.Has(companion)) return std::nullopt;
  const auto channel = writer_.AddChannel(companion, *type.companion->schema);
  if (channel) return *channel;
  Complain(channel.error());
  return std::nullopt;
}

std::vector<std::uint8_t> SensorTopics::Encode(const Sensor& sensor,
                                               const sensing::Reading& reading) const {
  using messages::sensor_msgs::CompressedImage;
  const std::string frame = presentation::FrameOf(sensor.robot, sensor.description.name);
  const bool is_picture = sensor.type->schema == &messages::SchemaOf<CompressedImage>() &&
                          reading.picture != nullptr && options_.write_png;
  if (is_picture) {
    if (auto png = options_.write_png(*reading.picture)) {
      CompressedImage message;
      message.header = sensing::HeaderOf(reading, frame);
      message.format = "png";
      message.data = *std::move(png);
      return sensing::Encoded(message);
    }
  }
  return sensor.type->encode(sensor.description, reading, frame);
}

void SensorTopics::WriteTransforms(const world::Snapshot& snapshot) {
  messages::tf2_msgs::TFMessage message;
  for (const auto& [topic, sensor] : sensors_) {
    const int body = snapshot.layout->Find(sensor->robot);
    if (body < 0) continue;
    presentation::AppendSensorTransform(*snapshot.layout, body, sensor->description, *sensor->type,
                                        snapshot.state.time, message);
  }
  transforms_.Write(snapshot.state.time, message);
}

void SensorTopics::WriteBeams(const world::Snapshot& snapshot) {
  std::map<std::string, std::vector<geometry::Vector3>> points;  // in the world, by robot
  for (const auto& [topic, sensor] : sensors_) {
    if (!presentation::HasLines(*sensor->type, sensor->description) || !sensor->newest) continue;
    const int body = snapshot.layout->Find(sensor->robot);
    if (body < 0) continue;
    const geometry::Pose world_from_sensor =
        world::LinkPose(snapshot, body, sensor->description.link) *
        sensor->description.link_from_sensor;
    presentation::AppendLines(*sensor->type, sensor->description, *sensor->newest,
                              world_from_sensor, points[sensor->robot]);
  }
  const base::SimTime time = snapshot.state.time;
  messages::visualization_msgs::MarkerArray message;
  for (const std::string& robot : robots_with_beams_) {
    if (!points.contains(robot))
      message.markers.push_back(presentation::NoBeamsMarker(robot, time));
  }
  robots_with_beams_.clear();
  for (auto& [robot, its_points] : points) {
    robots_with_beams_.insert(robot);
    message.markers.push_back(presentation::BeamsMarker(robot, time, std::move(its_points)));
  }
  if (!message.markers.empty()) beams_.Write(time, message);
}

void SensorTopics::Complain(const base::Error& error) {
  if (std::exchange(has_complained_, true)) return;
  spdlog::warn("a sensor is not recorded: {}", error.Sentence());
}

}  // namespace gsv::recording
