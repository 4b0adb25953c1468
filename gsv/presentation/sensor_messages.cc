#include "gsv/presentation/sensor_messages.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "gsv/messages/time.h"
#include "gsv/presentation/state_messages.h"

namespace gsv::presentation {
namespace {

using messages::visualization_msgs::Marker;

constexpr double kDash = 0.02;  // length of a dash, as a fraction of a beam's length

Marker MarkerOf(const std::string& robot, base::SimTime time) {
  Marker marker;
  marker.header.stamp = messages::ToMessage(time);
  marker.header.frame_id = sensing::kWorldFrame;
  marker.ns = robot;
  marker.type = Marker::kLineList;
  marker.pose.orientation.w = 1;
  return marker;
}

// Returns a marker that draws a line between each pair of points.
Marker LinesOf(const std::string& robot, base::SimTime time,
               const std::vector<messages::geometry_msgs::Point>& points_in_world) {
  Marker marker = MarkerOf(robot, time);
  marker.scale.x = 0.01;  // width of the lines, m
  marker.color.r = 0.2f;
  marker.color.g = 0.8f;
  marker.color.b = 1.0f;
  marker.color.a = 0.8f;
  marker.points = points_in_world;
  return marker;
}

Marker NoLinesOf(const std::string& robot, base::SimTime time) {
  Marker marker = MarkerOf(robot, time);
  marker.action = Marker::kDelete;
  return marker;
}

}  // namespace

std::string SensorTopic(const std::string& robot, const std::string& sensor) {
  return "/" + FrameOf(robot, sensor);
}

std::string CompanionTopic(const std::string& sensor_topic, const sensing::Companion& companion) {
  return sensor_topic + "/" + companion.topic;
}

std::vector<std::string> SensorTopicNames(const simulation::Simulation& simulation,
                                          const std::string& robot) {
  std::vector<std::string> names;
  for (const model::SensorDescription& description : simulation.sensors(robot)) {
    const sensing::SensorType* type = simulation.sensor_types().Find(description.type);
    if (type == nullptr) continue;
    const sensing::SensorMessages sent = type->MessagesOf(description);
    if (sent.schema == nullptr) continue;
    names.push_back(SensorTopic(robot, description.name));
    if (sent.companion) names.push_back(CompanionTopic(names.back(), *sent.companion));
  }
  return names;
}

void AppendSensorTransform(const world::Layout& layout, int body,
                           const model::SensorDescription& sensor, const sensing::SensorType& type,
                           base::SimTime time, messages::tf2_msgs::TFMessage& message) {
  const world::Body& robot = layout.bodies[body];
  const model::Link& link = robot.model->links[sensor.link];
  const std::vector<int> moving = world::MovingLinks(*robot.model);
  const bool moves = std::find(moving.begin(), moving.end(), sensor.link) != moving.end();
  const std::string frame = FrameOf(robot.name, sensor.name);
  message.transforms.push_back(StampedTransform(
      moves ? LinkFrame(robot, link) : BodyFrame(robot), frame, time,
      moves ? sensor.link_from_sensor : link.model_from_link * sensor.link_from_sensor));
  if (!type.companion) return;
  const geometry::Pose sensor_from_optical{{}, {0.5, -0.5, 0.5, -0.5}};
  message.transforms.push_back(
      StampedTransform(frame, FrameOf(frame, sensing::kOpticalFrame), time, sensor_from_optical));
}

bool HasLines(const sensing::SensorType& type, const model::SensorDescription& sensor) {
  return type.overlay == sensing::Overlay::kLines ||
         (type.overlay == sensing::Overlay::kPoints && sensor.visualize);
}

void BeamMarkers::Add(const world::Snapshot& snapshot, int body, const sensing::SensorType& type,
                      const sensing::Sensor& sensor, const sensing::Reading& reading) {
  const model::SensorDescription& description = sensor.description();
  if (body != body_) {
    lines_of_body_ = &lines_[snapshot.layout->bodies[static_cast<std::size_t>(body)].name];
    lines_of_body_->is_present = true;
    body_ = body;
    link_ = -1;
  }
  if (!HasLines(type, description)) return;
  if (description.link != link_) {
    link_ = description.link;
    world_from_link_ = world::LinkPose(snapshot, body, link_);
  }
  const geometry::Pose world_from_sensor = world_from_link_ * description.link_from_sensor;
  const bool as_points = type.overlay == sensing::Overlay::kPoints;
  const auto add = [&](const geometry::Vector3& in_sensor) {
    const geometry::Vector3 in_world = world_from_sensor * in_sensor;
    lines_of_body_->points.push_back({in_world.x, in_world.y, in_world.z});
  };
  for (const sensing::Segment& beam : sensor.Beams(reading)) {
    add(as_points ? beam.to + kDash * (beam.from - beam.to) : beam.from);
    add(beam.to);
  }
}

messages::visualization_msgs::MarkerArray BeamMarkers::Take(base::SimTime time) {
  messages::visualization_msgs::MarkerArray message;
  message.markers.reserve(lines_.size());
  body_ = -1;
  for (auto known = lines_.begin(); known != lines_.end();) {
    auto& [robot, lines] = *known;
    if (!lines.is_present) message.markers.push_back(NoLinesOf(robot, time));
    const bool is_over = !lines.is_present && --lines.deletions_left == 0;
    known = is_over ? lines_.erase(known) : std::next(known);
  }
  for (auto& [robot, lines] : lines_) {
    if (!lines.is_present) continue;
    message.markers.push_back(LinesOf(robot, time, lines.points));
    lines.points.clear();
    lines.is_present = false;
    lines.deletions_left = kDeletions;
  }
  return message;
}

}  // namespace gsv::presentation
