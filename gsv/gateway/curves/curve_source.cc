#include "gsv/gateway/curves/curve_source.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "gsv/gateway/curves/field_value.h"
#include "gsv/messages/definition.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/presentation/topics.h"

namespace gsv::gateway::curves {
namespace {

using recording::MessageRecord;

constexpr base::SimTime kMaxGap = std::chrono::seconds(1);  // maximum time between two poses from
                                                            // which a speed is computed
constexpr std::size_t kMaxKeyLength = 200;

using ChannelIds = std::set<std::uint16_t>;

ChannelIds ChannelsNamed(const recording::McapReader& reader, const std::string& topic) {
  ChannelIds ids;
  for (const auto& [id, channel] : reader.summary().channels) {
    if (channel.topic == topic && channel.message_encoding == "cdr") ids.insert(id);
  }
  return ids;
}

auto NoSuchTopic(const std::string& topic) {
  return base::Fail(base::ErrorCode::kNotFound,
                    "the recording has no topic '" + topic.substr(0, kMaxKeyLength) +
                        "' that can be plotted; `gsv rec info` lists the topics");
}

class FieldSource final : public CurveSource {
 public:
  FieldSource(std::map<std::uint16_t, messages::Definition> definitions, std::string key)
      : definitions_(std::move(definitions)), key_(std::move(key)) {}

  std::optional<double> SampleIn(const MessageRecord& message) override {
    const auto definition = definitions_.find(message.channel_id);
    if (definition == definitions_.end()) return std::nullopt;
    const auto content = definition->second.Decode(message.data);
    return content ? FieldValue(*content, key_) : std::nullopt;
  }

 private:
  const std::map<std::uint16_t, messages::Definition> definitions_;
  const std::string key_;
};

base::Result<std::unique_ptr<CurveSource>> MakeFieldSource(const recording::McapReader& reader,
                                                           const CurveRequest& request) {
  std::map<std::uint16_t, messages::Definition> definitions;
  for (const std::uint16_t id : ChannelsNamed(reader, request.topic)) {
    const auto& summary = reader.summary();
    const auto schema = summary.schemas.find(summary.channels.at(id).schema_id);
    if (schema == summary.schemas.end() || schema->second.encoding != "ros2msg") continue;
    auto definition = messages::Definition::Parse(schema->second.name, schema->second.data);
    if (definition) definitions.emplace(id, *std::move(definition));
  }
  if (definitions.empty()) return NoSuchTopic(request.topic);
  return std::make_unique<FieldSource>(std::move(definitions), request.key);
}

// Values of a robot, or of the simulation, in /gsv/status.
class StatusSource final : public CurveSource {
 public:
  StatusSource(ChannelIds channels, const CurveRequest& request)
      : channels_(std::move(channels)), robot_(request.robot), key_(request.key) {}

  std::optional<double> SampleIn(const MessageRecord& message) override {
    if (!channels_.contains(message.channel_id)) return std::nullopt;
    const auto status = messages::Decode<messages::gsv_msgs::SimulationStatus>(message.data);
    if (!status) return std::nullopt;
    if (key_ == "real_time_factor") return status->real_time_factor;
    if (key_ == "late_steps") return static_cast<double>(status->late_steps);
    const auto robot = std::find_if(status->robots.begin(), status->robots.end(),
                                    [&](const auto& each) { return each.name == robot_; });
    if (robot == status->robots.end()) return std::nullopt;
    return key_ == "distance" ? robot->distance_m : static_cast<double>(robot->collisions);
  }

 private:
  const ChannelIds channels_;
  const std::string robot_, key_;
};

class PoseSource final : public CurveSource {
 public:
  PoseSource(ChannelIds channels, const RecordedScene& scene, const CurveRequest& request)
      : channels_(std::move(channels)), scene_(scene), robot_(request.robot), key_(request.key) {}

  std::optional<double> SampleIn(const MessageRecord& message) override {
    if (!channels_.contains(message.channel_id)) return std::nullopt;
    const auto poses = messages::Decode<messages::gsv_msgs::Poses>(message.data);
    if (!poses) return std::nullopt;
    const auto& places = scene_.BodyPoses(poses->layout_version);
    const auto place = places.find(robot_);
    if (place == places.end() || place->second >= poses->poses.size() / 7) return std::nullopt;
    Numbers now;
    std::copy_n(poses->poses.begin() + static_cast<std::ptrdiff_t>(7 * place->second), 7,
                now.begin());
    return Value(message.log_time, now);
  }

 private:
  using Numbers = std::array<double, 7>;  // the seven numbers x y z qx qy qz qw

  std::optional<double> Value(base::SimTime time, const Numbers& now) {
    if (key_ == "x") return now[0];
    if (key_ == "y") return now[1];
    if (key_ == "z") return now[2];
    const bool is_rate = key_ == "speed" || key_ == "turn_rate";
    if (!is_rate) return AngleOf(now[3], now[4], now[5], now[6], key_);
    const base::SimTime elapsed = time - time_;
    const auto before = std::exchange(before_, now);
    time_ = time;
    if (!before || elapsed <= base::SimTime(0) || elapsed >= kMaxGap) return std::nullopt;
    return Rate(*before, now) / base::ToSeconds(elapsed);
  }

  // Returns the change between two poses: a distance in metres, or the smaller angle in radians.
  double Rate(const Numbers& before, const Numbers& now) const {
    if (key_ == "speed") {
      return std::hypot(now[0] - before[0], now[1] - before[1], now[2] - before[2]);
    }
    const auto yaw = [](const Numbers& pose) {
      return *AngleOf(pose[3], pose[4], pose[5], pose[6], "yaw");
    };
    return std::remainder(yaw(now) - yaw(before), 2 * std::numbers::pi);
  }

  const ChannelIds channels_;
  const RecordedScene& scene_;
  const std::string robot_, key_;
  std::optional<Numbers> before_;
  base::SimTime time_{};
};

base::Result<std::unique_ptr<CurveSource>> MakeRobotSource(const recording::McapReader& reader,
                                                           const RecordedScene& scene,
                                                           const CurveRequest& request) {
  static const std::set<std::string> kOfPoses{"x",     "y",   "z",     "roll",
                                              "pitch", "yaw", "speed", "turn_rate"};
  static const std::set<std::string> kOfStatus{"distance", "collisions"};
  const bool is_of_poses = kOfPoses.contains(request.key);
  if (!is_of_poses && !kOfStatus.contains(request.key)) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "a robot's 'key' is x, y, z, roll, pitch, yaw, speed, turn_rate, distance "
                      "or collisions");
  }
  if (!scene.HasBody(request.robot)) {
    return base::Fail(base::ErrorCode::kNotFound, "the recording has no robot '" +
                                                      request.robot.substr(0, kMaxKeyLength) + "'");
  }
  const std::string topic =
      is_of_poses ? presentation::topics::kPoses.name : presentation::topics::kStatus.name;
  ChannelIds channels = ChannelsNamed(reader, topic);
  if (channels.empty()) return NoSuchTopic(topic);
  if (is_of_poses) return std::make_unique<PoseSource>(std::move(channels), scene, request);
  return std::make_unique<StatusSource>(std::move(channels), request);
}

}  // namespace

base::Result<std::unique_ptr<CurveSource>> MakeCurveSource(const recording::McapReader& reader,
                                                           const RecordedScene& scene,
                                                           const CurveRequest& request) {
  if (!request.topic.empty() && !request.robot.empty()) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "a curve has 'topic' or 'robot', not both; remove one of them");
  }
  if (request.key.empty() || request.key.size() > kMaxKeyLength) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "a curve needs 'key', with 1 to 200 characters, but it has " +
                          std::to_string(request.key.size()));
  }
  if (!request.topic.empty()) return MakeFieldSource(reader, request);
  if (!request.robot.empty()) return MakeRobotSource(reader, scene, request);
  if (request.key != "real_time_factor" && request.key != "late_steps") {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the simulation's 'key' is real_time_factor or late_steps; give 'robot' or "
                      "'topic' for other curves");
  }
  ChannelIds channels = ChannelsNamed(reader, presentation::topics::kStatus.name);
  if (channels.empty()) return NoSuchTopic(presentation::topics::kStatus.name);
  return std::make_unique<StatusSource>(std::move(channels), request);
}

}  // namespace gsv::gateway::curves
