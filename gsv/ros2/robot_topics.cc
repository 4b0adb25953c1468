#include "gsv/ros2/robot_topics.h"

#include <algorithm>
#include <map>
#include <utility>

#include "gsv/base/log.h"
#include "gsv/messages/geometry_msgs.h"
#include "gsv/messages/std_msgs.h"
#include "gsv/messages/time.h"
#include "gsv/presentation/state_messages.h"
#include "gsv/readings/catalogue.h"
#include "gsv/ros2/message_source.h"
#include "gsv/ros2/names.h"
#include "gsv/ros2/sensor_source.h"
#include "gsv/ros2/trajectory_follower.h"
#include "gsv/world/station.h"

namespace gsv::ros2 {
namespace {

constexpr base::SimTime kTruthPeriod = std::chrono::milliseconds(20);
constexpr const char* kRobotNode = "robot";
constexpr const char* kDriveTopic = "cmd_vel";

// Returns "fleet/one/" for "/fleet/one", and an empty text for "/".
std::string PrefixOf(const std::string& name_space) {
  return name_space == "/" ? std::string() : name_space.substr(1) + "/";
}

bool HasOdometry(const world::Body& body) {
  return !body.is_avatar() && body.is_robot() && body.model->drive.has_value();
}

bool HasType(const sensing::SensorRegistry& types,
             const std::vector<model::SensorDescription>& sensors, const char* name) {
  return std::any_of(sensors.begin(), sensors.end(), [&](const auto& description) {
    const sensing::SensorType* const type = types.Find(description.type);
    return type != nullptr && type->name == name;
  });
}

// Returns the joints that accept commands and do not belong to the drive.
std::vector<int> FreeJoints(const model::Model& model) {
  std::vector<int> joints;
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    const int joint = static_cast<int>(j);
    const model::Joint& each = model.joints[j];
    const bool is_free = model::TakesCommands(each.kind) && !each.mimic;
    if (is_free && !world::IsOfDrive(model, joint)) joints.push_back(joint);
  }
  return joints;
}

messages::geometry_msgs::PoseStamped TruthMessage(const world::Snapshot& snapshot,
                                                  const std::string& body) {
  messages::geometry_msgs::PoseStamped message;
  message.header.stamp = messages::ToMessage(snapshot.state.time);
  message.header.frame_id = kRosWorldFrame;
  const int index = snapshot.layout->Find(body);
  if (index < 0) return message;
  const geometry::Pose& pose =
      snapshot.state.bodies[static_cast<std::size_t>(index)].world_from_model;
  message.pose.position = {pose.position.x, pose.position.y, pose.position.z};
  message.pose.orientation = {pose.orientation.x, pose.orientation.y, pose.orientation.z,
                              pose.orientation.w};
  return message;
}

}  // namespace

RobotTopics::RobotTopics(const Context& context, const world::Body& body, std::string name_space,
                         bool takes_commands)
    : body_(body.name),
      model_(body.model),
      kind_(body.kind),
      has_odometry_(HasOdometry(body)),
      takes_commands_(takes_commands),
      sensors_(context.simulation.sensors(body.name)),
      frames_(PrefixOf(name_space), *body.model),
      node_(context.participant, context.options.distro, name_space, kRobotNode, context.on_match) {
  AddSensors(context);
  AddImplied(context);
  description_ = node_.Advertise("robot_description", "std_msgs/msg/String", kLatchedQos);
  if (takes_commands_) TakeCommands(context, body);
}

bool RobotTopics::Fits(const world::Body& body,
                       const std::vector<model::SensorDescription>& sensors,
                       bool takes_commands) const {
  return body.model == model_ && body.kind == kind_ && sensors == sensors_ &&
         takes_commands == takes_commands_;
}

void RobotTopics::AddSensors(const Context& context) {
  const sensing::SensorRegistry& types = context.simulation.sensor_types();
  // Number of sensors with each usual topic. Types of sensors may share a topic, as cameras do.
  std::map<std::string, int> counts;
  for (const model::SensorDescription& description : sensors_) {
    const sensing::SensorType* const type = types.Find(description.type);
    if (type != nullptr) ++counts[UsualTopicOf(*type, description)];
    is_optical_.push_back(type != nullptr && type->companion.has_value());
  }
  for (const model::SensorDescription& description : sensors_) {
    const sensing::SensorType* const type = types.Find(description.type);
    if (type == nullptr) continue;
    AddSensor(context, description, counts[UsualTopicOf(*type, description)] == 1);
  }
}

void RobotTopics::AddSensor(const Context& context, model::SensorDescription description,
                            bool is_only) {
  RosSensor sensor;
  sensor.body = body_;
  sensor.type = context.simulation.sensor_types().Find(description.type);
  sensor.is_only = is_only;
  auto made = context.sensors.Of(description);
  if (!made) {
    spdlog::warn("{}/{} is not published to ROS 2: {}", body_, description.name,
                 made.error().Sentence());
    return;
  }
  sensor.sensor = *std::move(made);
  sensor.description = std::move(description);
  std::vector<SensorOutput> outputs = OutputsOf(sensor, frames_, *model_);
  sources_.push_back(std::make_unique<SensorSource>(std::move(sensor), std::move(outputs), node_));
}

// Adds the topics that ROS 2 expects of every robot. They are added even if the model has no sensor
// for them.
void RobotTopics::AddImplied(const Context& context) {
  const sensing::SensorRegistry& types = context.simulation.sensor_types();
  const auto add = [&](const char* type) {
    if (HasType(types, sensors_, type)) return;
    model::SensorDescription description;
    description.name = std::string("ros2_") + type;
    description.type = type;
    AddSensor(context, std::move(description), true);
  };
  if (has_odometry_) add(readings::Odometry::kType);
  const auto moves = [](const model::Joint& joint) {
    return joint.kind != model::JointKind::kFixed;
  };
  if (std::any_of(model_->joints.begin(), model_->joints.end(), moves)) {
    add(readings::JointEncoders::kType);
  }
  dds::Writer* const truth =
      node_.Advertise("ground_truth/pose", "geometry_msgs/msg/PoseStamped", kDefaultQos);
  sources_.push_back(std::make_unique<MessageSource<messages::geometry_msgs::PoseStamped>>(
      kTruthPeriod, truth,
      [body = body_](const world::Snapshot& snapshot) { return TruthMessage(snapshot, body); }));
}

void RobotTopics::TakeCommands(const Context& context, const world::Body& body) {
  const std::shared_ptr<simulation::Agent> agent = context.simulation.agent(body_);
  if (agent == nullptr) return;
  const auto input = std::make_shared<CommandInput>(agent, body, context.options.steps);
  if (has_odometry_) {
    const bool is_stamped = context.options.is_cmd_vel_stamped;
    drive_type_ = is_stamped ? "geometry_msgs/msg/TwistStamped" : "geometry_msgs/msg/Twist";
    drive_reader_ =
        node_.Subscribe(kDriveTopic, drive_type_, kDefaultQos,
                        [input, is_stamped](std::span<const std::byte> sample) {
                          is_stamped ? input->TakeTwistStamped(sample) : input->TakeTwist(sample);
                        });
  }
  TakeJointCommands(context, input);
}

void RobotTopics::TakeJointCommands(const Context& context,
                                    const std::shared_ptr<CommandInput>& input) {
  using Kind = world::JointCommand::Kind;
  const std::vector<int> joints = FreeJoints(*model_);
  if (joints.empty()) return;
  const std::pair<const char*, Kind> topics[] = {
      {"joint_position_controller/commands", Kind::kPosition},
      {"joint_velocity_controller/commands", Kind::kVelocity},
      {"joint_effort_controller/commands", Kind::kEffort}};
  for (const auto& [topic, kind] : topics) {
    node_.Subscribe(topic, "std_msgs/msg/Float64MultiArray", kDefaultQos,
                    [input, joints, kind = kind](std::span<const std::byte> sample) {
                      input->TakeJoints(sample, joints, kind);
                    });
  }
  auto follower =
      std::make_unique<TrajectoryFollower>(input, body_, model_, joints, context.on_match);
  node_.Subscribe(
      "joint_trajectory", "trajectory_msgs/msg/JointTrajectory", kDefaultQos,
      [&follower = *follower](std::span<const std::byte> sample) { follower.Take(sample); });
  sources_.push_back(std::move(follower));
}

void RobotTopics::AppendMovingFrames(const world::Snapshot& snapshot,
                                     messages::tf2_msgs::TFMessage& message) const {
  const int body = snapshot.layout->Find(body_);
  if (body >= 0) frames_.AppendMoving(snapshot, body, has_odometry_, message);
}

void RobotTopics::AppendStaticFrames(const world::Snapshot& snapshot,
                                     messages::tf2_msgs::TFMessage& message) const {
  const int index = snapshot.layout->Find(body_);
  if (index < 0) return;
  const base::SimTime time = snapshot.state.time;
  const world::Body& body = snapshot.layout->bodies[static_cast<std::size_t>(index)];
  if (world::IsStation(body)) {
    message.transforms.push_back(presentation::StampedTransform(
        kRosWorldFrame, frames_.base(), time,
        snapshot.state.bodies[static_cast<std::size_t>(index)].world_from_model));
  }
  frames_.AppendStatic(*model_, sensors_, is_optical_, time, message);
}

void RobotTopics::SendDescription(RobotDescriptions& descriptions) {
  if (description_ == nullptr || !description_->has_readers()) return;
  const auto text = descriptions.Of(model_);
  if (text) {
    Send(messages::std_msgs::String{*text}, description_);
  } else {
    spdlog::warn("{} has no robot_description: {}", body_, text.error().Sentence());
  }
  description_ = nullptr;
}

void RobotTopics::CheckPublishers(const std::vector<dds::Endpoint>& endpoints) {
  if (drive_reader_ == nullptr) return;
  const std::string topic = InNamespace(node_.name_space(), kDriveTopic);
  if (!has_warned_of_many_ && drive_reader_->writers() > 1) {
    has_warned_of_many_ = true;
    spdlog::warn("{} ROS 2 publishers on {} command {}. The latest command counts",
                 drive_reader_->writers(), topic, body_);
  }
  if (has_warned_of_type_) return;
  const std::string name = DdsTopicName(topic), type = DdsTypeName(drive_type_);
  const auto other = std::find_if(endpoints.begin(), endpoints.end(), [&](const auto& endpoint) {
    return endpoint.is_writer && endpoint.topic.name == name && endpoint.topic.type != type;
  });
  if (other == endpoints.end()) return;
  has_warned_of_type_ = true;
  const std::string found = RosTypeName(other->topic.type);
  spdlog::warn(
      "a ROS 2 node publishes {} on {}, but {} takes {}. Change the node, or --ros2-cmd-vel",
      found.empty() ? other->topic.type.substr(0, 200) : found, topic, body_, drive_type_);
}

}  // namespace gsv::ros2
