#include "gsv/recording/recording_difference.h"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "gsv/presentation/topics.h"
#include "gsv/recording/attachments/scenario_attachment.h"
#include "gsv/recording/attachments/scene_attachments.h"

namespace gsv::recording {
namespace {

constexpr std::size_t kMaxLines = 20;
constexpr std::size_t kMaxValueLength = 300;
constexpr std::size_t kNumbersAPose = 7;  // count of numbers in one pose of gsv_msgs/Poses

// Returns the content of the last attachment with that name up to `time`, or else of the first one.
// Empty if there is none.
std::string AttachmentOf(const McapReader& reader, std::string_view name, base::SimTime time) {
  const AttachmentIndexRecord* chosen = nullptr;
  for (const auto& each : reader.summary().attachments) {
    if (each.name != name) continue;
    if (chosen == nullptr || each.log_time <= time) chosen = &each;
  }
  if (chosen == nullptr) return {};
  const auto attachment = reader.Read(*chosen);
  if (!attachment) return {};
  return {reinterpret_cast<const char*>(attachment->data.data()), attachment->data.size()};
}

std::vector<std::string> LinesOfText(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> Without(const std::vector<std::string>& lines,
                                 const std::vector<std::string>& others) {
  std::vector<std::string> alone;
  for (const std::string& line : lines) {
    if (alone.size() == kMaxLines) break;
    if (std::find(others.begin(), others.end(), line) == others.end()) {
      alone.push_back(line.substr(0, kMaxValueLength));
    }
  }
  return alone;
}

// Returns the name of the body whose pose contains a number of a gsv_msgs/Poses message; empty if
// it is unknown. `index` is the index of the number. Each pose has seven numbers.
std::string BodyOfPose(const McapReader& reader, base::SimTime time, std::size_t index) {
  const auto scene =
      nlohmann::json::parse(AttachmentOf(reader, kSceneAttachment, time), nullptr, false);
  if (!scene.is_object() || !scene.contains("poses") || !scene.contains("bodies")) return {};
  const auto& poses = scene["poses"];
  const std::size_t entry = index / kNumbersAPose;
  if (!poses.is_array() || entry >= poses.size() || !poses[entry].is_object()) return {};
  const std::size_t body = poses[entry].value("body", std::size_t{0});
  const auto& bodies = scene["bodies"];
  if (!bodies.is_array() || body >= bodies.size() || !bodies[body].is_object()) return {};
  return bodies[body].value("name", "");
}

// Returns the name in the message, or in the element that contains the field:
// "transforms.3.transform" is in element 3 of transforms.
std::string NameInMessage(const nlohmann::ordered_json& message, const std::string& field) {
  const nlohmann::ordered_json* at = &message;
  std::string name;
  std::istringstream path(field);
  for (std::string key; at != nullptr;) {
    for (const char* naming : {"robot", "name", "child_frame_id", "first", "ns"}) {
      if (at->is_object() && at->contains(naming) && (*at)[naming].is_string()) {
        name = (*at)[naming].get<std::string>();
        break;
      }
    }
    if (!std::getline(path, key, '.')) break;
    std::size_t index = 0;
    const bool is_index =
        std::from_chars(key.data(), key.data() + key.size(), index).ec == std::errc();
    if (at->is_array() && is_index && index < at->size()) {
      at = &(*at)[index];
    } else {
      at = at->is_object() && at->contains(key) ? &(*at)[key] : nullptr;
    }
  }
  return name.substr(0, name.find('/'));
}

std::string RobotOf(const McapReader& reader, const Difference& difference) {
  const std::string& topic = difference.topic;
  constexpr std::string_view kPoses = "poses.";
  if (topic == presentation::topics::kPoses.name && difference.field.starts_with(kPoses)) {
    return BodyOfPose(reader, difference.time,
                      std::strtoul(difference.field.c_str() + kPoses.size(), nullptr, 10));
  }
  // All topics that FindTopic() does not know are topics of sensors: /ROBOT/SENSOR.
  if (presentation::FindTopic(topic) == nullptr) {
    return topic.substr(1, topic.find('/', 1) - 1);
  }
  return NameInMessage(difference.message, difference.field);
}

std::string Shortened(const std::string& text) {
  return text.size() <= kMaxValueLength ? text : text.substr(0, kMaxValueLength) + "…";
}

}  // namespace

base::Result<RecordingDifference> CompareRecordings(const McapReader& first,
                                                    const McapReader& second) {
  RecordingDifference difference;
  const auto scenario_of = [](const McapReader& reader) {
    return LinesOfText(AttachmentOf(reader, kScenarioAttachment, reader.summary().start));
  };
  const auto scenario_a = scenario_of(first), scenario_b = scenario_of(second);
  difference.only_in_first = Without(scenario_a, scenario_b);
  difference.only_in_second = Without(scenario_b, scenario_a);
  const auto messages = FirstDifference(first, second);
  if (!messages) return base::Fail(messages.error());
  difference.messages = *messages;
  if (difference.messages) difference.robot = RobotOf(first, *difference.messages);
  return difference;
}

std::string RecordingDifference::Text() const {
  std::string text;
  if (!only_in_first.empty() || !only_in_second.empty()) {
    text += "the scenarios differ:\n";
    for (const std::string& line : only_in_first) text += "  first:  " + line + "\n";
    for (const std::string& line : only_in_second) text += "  second: " + line + "\n";
  }
  if (!messages) {
    return text + (text.empty() ? "the recordings are equal\n" : "the messages are equal\n");
  }
  Difference shown = *messages;
  shown.in_first = Shortened(shown.in_first);
  shown.in_second = Shortened(shown.in_second);
  return text + (robot.empty() ? "" : robot + ": ") + shown.Sentence() + "\n";
}

nlohmann::ordered_json RecordingDifference::Json() const {
  nlohmann::ordered_json json{{"equal", !messages.has_value()},
                              {"scenario",
                               {{"equal", only_in_first.empty() && only_in_second.empty()},
                                {"first", only_in_first},
                                {"second", only_in_second}}}};
  if (!messages) return json;
  json.update(ToJson(*messages));
  json["robot"] = robot;
  return json;
}

}  // namespace gsv::recording
