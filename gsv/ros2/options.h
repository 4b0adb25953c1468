// The options of the ROS 2 bridge, and the ROS environment variables that GSV reads.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

#include "gsv/ros2/dds/participant.h"
#include "gsv/ros2/node_steps.h"

namespace gsv::ros2 {

// The period of /clock, in simulated time.
inline constexpr base::SimTime kClockPeriod = std::chrono::milliseconds(10);

// The supported ROS 2 distributions. Their discovery data differ.
enum class Distro { kHumble, kJazzy, kKilted, kLyrical };

// The options of a bridge.
struct Options {
  std::optional<dds::Range> range{};  // if not set: the range from the environment, else localhost
  Distro distro = Distro::kJazzy;
  // Namespace of a robot, by the robot's name (default: "/ROBOT").
  std::map<std::string, std::string> namespaces{};
  bool is_cmd_vel_stamped = false;     // true for TwistStamped, false for Twist
  std::shared_ptr<NodeSteps> steps{};  // robots that ROS 2 nodes step; null if there are none
};

base::Result<Distro> ParseDistro(const std::string& text);
base::Result<dds::Range> ParseRange(const std::string& text);
// Parses "ROBOT=NAMESPACE" and adds it to `namespaces`.
base::Status ParseNamespace(const std::string& text,
                            std::map<std::string, std::string>& namespaces);

// Returns the value of an environment variable, or an empty text if it is not set.
using Environment = std::function<std::string(const char* name)>;
std::string ProcessEnvironment(const char* name);

// Reads ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY, ROS_AUTOMATIC_DISCOVERY_RANGE, ROS_STATIC_PEERS and the
// variables that security.h lists.
base::Result<dds::ParticipantOptions> ParticipantFor(const Options& options,
                                                     const Environment& environment);

// Whether other machines can send data to the participant and receive its data.
bool IsExposed(const dds::ParticipantOptions& options);

}  // namespace gsv::ros2
