// Reads recordings of ROS 2 messages (MCAP) by GSV or by `ros2 bag record`.
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>

#include <fmt/format.h>

#include "gsv/geometry/constants.h"
#include "gsv/reality/logs/log_reader.h"
#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/recording/reading/decoded_messages.h"

namespace gsv::reality {
namespace {

using geometry::kInfinity;
using Json = nlohmann::ordered_json;

constexpr std::size_t kMaxScanBeams = 100'000, kMaxWarnings = 20;

// Returns a number in a message, or NaN if there is none. In the JSON, infinite numbers are
// texts.
double NumberIn(const Json& object, const char* key) {
  const auto it = object.find(key);
  if (it == object.end()) return std::nan("");
  if (it->is_number()) return it->get<double>();
  if (it->is_string()) return it->get<std::string>() == "-Infinity" ? -kInfinity : kInfinity;
  return std::nan("");
}

// Returns the member with that name, or null if there is none.
const Json& In(const Json& object, const char* key) {
  static const Json kNothing;
  const auto it = object.find(key);
  return it == object.end() ? kNothing : *it;
}

double YawOf(const Json& q) {
  const double x = NumberIn(q, "x"), y = NumberIn(q, "y"), z = NumberIn(q, "z"),
               w = NumberIn(q, "w");
  return std::atan2(2 * (w * z + x * y), 1 - 2 * (y * y + z * z));
}

class McapLog {
 public:
  McapLog(const std::filesystem::path& path, base::Problems& problems)
      : path_(path), problems_(problems) {}

  base::Result<Log> Read() {
    const auto reader = recording::McapReader::Open(path_.string());
    if (!reader) return base::Fail(reader.error());
    for (const base::Problem& problem : (*reader)->summary().problems) problems_.push_back(problem);
    auto messages = recording::DecodedMessages::Open(**reader, {});
    if (!messages) return base::Fail(messages.error());
    while (true) {
      auto next = messages->Next();
      if (!next) {
        Warn(next.error().Sentence());
        continue;
      }
      if (!*next) break;
      Add(**next);
    }
    ReportIgnoredTopics();
    if (warnings_ > kMaxWarnings) {
      Keep(fmt::format("{} more messages have problems", warnings_ - kMaxWarnings));
    }
    if (log_.duration() == 0 && log_.scans.empty()) {
      return base::Fail(
          base::ErrorCode::kCorrupt,
          "the recording has no LaserScan, Range, Odometry, PoseStamped, Twist or /tf",
          path_.string());
    }
    return std::move(log_);
  }

 private:
  // Returns whether the topic is the first one of its kind. Other topics are not read.
  bool IsOfFirstTopic(const std::string& kind, const std::string& topic) {
    const auto [known, is_new] = topics_.emplace(kind, topic);
    if (!is_new && known->second != topic) ignored_[kind].insert(topic);
    return known->second == topic;
  }

  // Adds one warning for each kind of data that several topics have.
  void ReportIgnoredTopics() {
    for (const auto& [kind, topics] : ignored_) {
      const std::string& first = *topics.begin();
      const std::string what = topics.size() == 1
                                   ? first + " is"
                                   : fmt::format("{} and {} other topic{} are", first,
                                                 topics.size() - 1, topics.size() == 2 ? "" : "s");
      Keep(fmt::format("{} not read: {} is used for the {}", what, topics_.at(kind), kind));
    }
  }

  // Reports a gap between two messages. Call it with ascending times.
  void ReportGap(double time) {
    constexpr double kReportedGap = 10;  // s
    if (last_time_ && time - *last_time_ > kReportedGap) {
      Keep(fmt::format("the clock jumps from {} to {} s; nothing is compared across the gap",
                       *last_time_, time));
    }
    last_time_ = time;
  }

  void Add(const recording::DecodedMessage& message) {
    const double time = base::ToSeconds(message.time);
    ReportGap(time);
    const Json& content = message.content;
    if (message.type == "sensor_msgs/msg/LaserScan") {
      if (IsOfFirstTopic("scans", message.topic)) AddScan(time, content);
    } else if (message.type == "sensor_msgs/msg/Range") {
      if (IsOfFirstTopic("scans", message.topic)) AddRange(time, content);
    } else if (message.type == "nav_msgs/msg/Odometry") {
      if (IsOfFirstTopic("odometry", message.topic)) {
        AddPose(time, In(In(content, "pose"), "pose"), log_.odometry);
      }
    } else if (message.type == "geometry_msgs/msg/PoseStamped") {
      if (IsOfFirstTopic("truth", message.topic)) AddPose(time, In(content, "pose"), log_.truth);
    } else if (message.type == "tf2_msgs/msg/TFMessage") {
      if (message.topic == "/tf") AddTransforms(time, content);
    } else if (message.type == "gsv_msgs/msg/Command") {
      AddCommand(time, content);
    } else if (message.type == "geometry_msgs/msg/TwistStamped" ||
               message.type == "geometry_msgs/msg/Twist") {
      if (!IsOfFirstTopic("commands", message.topic)) return;
      const Json& twist = content.contains("twist") ? In(content, "twist") : content;
      const double linear = NumberIn(In(twist, "linear"), "x");
      const double angular = NumberIn(In(twist, "angular"), "z");
      if (!std::isfinite(linear + angular)) return Warn(Where(time) + "the twist is not finite");
      log_.commands.push_back({time, linear, angular});
    }
  }

  // Adds poses of the robot's base: in the world (truth) and in the frame of its odometry. The
  // frames are recognised by their names in REP-105.
  void AddTransforms(double time, const Json& content) {
    const Json& transforms = In(content, "transforms");
    if (!transforms.is_array()) return;
    for (const Json& each : transforms) {
      const std::string parent = FrameIn(In(each, "header"), "frame_id");
      const std::string child = FrameIn(each, "child_frame_id");
      const std::string of = LastPart(child);
      if (of != "base_link" && of != "base_footprint") continue;
      const bool is_odometry = LastPart(parent) == "odom";
      if (!is_odometry && parent != "map" && parent != "world") continue;
      const std::string from = "the transform from " + parent + " to " + child;
      if (!IsOfFirstTopic(is_odometry ? "odometry" : "truth", from)) continue;
      const Json& transform = In(each, "transform");
      AddPose(time, In(transform, "translation"), In(transform, "rotation"),
              is_odometry ? log_.odometry : log_.truth);
    }
  }

  static std::string FrameIn(const Json& object, const char* key) {
    const Json& name = In(object, key);
    return name.is_string() ? name.get<std::string>() : "";
  }
  static std::string LastPart(const std::string& frame) {
    return frame.substr(frame.rfind('/') + 1);
  }

  // Adds a command from a recording that GSV wrote.
  void AddCommand(double time, const Json& command) {
    const std::string robot = FrameIn(command, "robot");
    if (!IsOfFirstTopic("commands", "/gsv/commands of " + robot)) return;
    const double linear = NumberIn(command, "linear_m_s");
    const double angular = NumberIn(command, "angular_rad_s");
    if (!std::isfinite(linear + angular)) return Warn(Where(time) + "the command is not finite");
    log_.commands.push_back({time, linear, angular});
  }

  void AddPose(double time, const Json& pose, std::vector<TimedPose>& poses) {
    AddPose(time, In(pose, "position"), In(pose, "orientation"), poses);
  }

  void AddPose(double time, const Json& position, const Json& orientation,
               std::vector<TimedPose>& poses) {
    const TimedPose read{time, NumberIn(position, "x"), NumberIn(position, "y"),
                         YawOf(orientation)};
    if (!std::isfinite(read.x + read.y + read.yaw)) {
      return Warn(Where(time) + "the pose is not finite");
    }
    poses.push_back(read);
  }

  void AddRange(double time, const Json& range) {
    log_.is_sonar = true;
    log_.beam_angles = {0};
    log_.max_range = NumberIn(range, "max_range");
    const double read = NumberIn(range, "range");
    if (std::isnan(read)) return Warn(Where(time) + "the range is not a number");
    log_.scans.push_back({time, {read >= log_.max_range ? kInfinity : read}, std::nullopt});
  }

  void AddScan(double time, const Json& scan) {
    const auto ranges = scan.find("ranges");
    if (ranges == scan.end() || !ranges->is_array()) {
      return Warn(Where(time) + "the scan has no ranges");
    }
    if (ranges->size() > kMaxScanBeams) {
      return Warn(Where(time) + fmt::format("the scan has {} ranges; the limit is {}",
                                            ranges->size(), kMaxScanBeams));
    }
    const double first = NumberIn(scan, "angle_min"), step = NumberIn(scan, "angle_increment");
    const double max = NumberIn(scan, "range_max"), min = NumberIn(scan, "range_min");
    if (!std::isfinite(first + step)) return Warn(Where(time) + "the angles are not finite");
    if (log_.beam_angles.empty()) {
      for (std::size_t i = 0; i < ranges->size(); ++i) {
        log_.beam_angles.push_back(first + static_cast<double>(i) * step);
      }
      log_.max_range = max;
    }
    if (log_.beam_angles.size() != ranges->size()) {
      return Warn(Where(time) + "the number of beams differs from that of the first scan");
    }
    RangeScan read;
    read.time = time;
    for (const Json& each : *ranges) {
      const double range = each.is_number() ? each.get<double>() : kInfinity;
      read.ranges.push_back(range < min || range >= max ? kInfinity : range);
    }
    log_.scans.push_back(std::move(read));
  }

  std::string Where(double time) const { return fmt::format("at {} s ", time); }
  void Warn(const std::string& what) {
    if (++warnings_ <= kMaxWarnings) Keep(what + "; it is ignored");
  }
  void Keep(const std::string& what) {
    problems_.push_back({base::Problem::Severity::kWarning, what, path_.string()});
  }

  const std::filesystem::path path_;
  base::Problems& problems_;
  Log log_;
  std::map<std::string, std::string> topics_;             // topics that are read, by kind of data
  std::map<std::string, std::set<std::string>> ignored_;  // ignored topics, by kind of data
  std::size_t warnings_ = 0;
  std::optional<double> last_time_;
};

}  // namespace

base::Result<Log> ReadMcap(const std::filesystem::path& path, base::Problems& problems) {
  auto log = McapLog(path, problems).Read();
  if (!log) return log;
  for (RangeScan& scan : log->scans) {
    scan.base = PoseAt(log->truth.empty() ? log->odometry : log->truth, scan.time);
  }
  return log;
}

}  // namespace gsv::reality
