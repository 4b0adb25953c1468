// The options of ROS 2, and ROS's own environment variables.
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

// These distributions differ in the data that discovery exchanges.
enum class Distro { kHumble, kJazzy, kKilted, kLyrical };

struct Options {
  std::optional<dds::Range> range{};  // if empty, from the environment, or else localhost
  Distro distro = Distro::kJazzy;
  // namespaces by robot; a robot that is not listed has "/ROBOT"
  std::map<std::string, std::string> namespaces{};
  bool is_cmd_vel_stamped = false;     // true for TwistStamped, false for Twist
  std::shared_ptr<NodeSteps> steps{};  // the robots that nodes step; null if there are none
};

base::Result<Distro> ParseDistro(const std::string& text);
base::Result<dds::Range> ParseRange(const std::string& text);
// ROBOT=NAMESPACE.
base::Status ParseNamespace(const std::string& text,
                            std::map<std::string, std::string>& namespaces);

// Returns the value of an environment variable, or an empty text if it is not set.
using Environment = std::function<std::string(const char* name)>;
std::string ProcessEnvironment(const char* name);

// Reads ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY, ROS_AUTOMATIC_DISCOVERY_RANGE, ROS_STATIC_PEERS and the variables of
// security.h.
base::Result<dds::ParticipantOptions> ParticipantFor(const Options& options,
                                                     const Environment& environment);

// Whether other machines can send and receive data.
bool IsExposed(const dds::ParticipantOptions& options);

}  // namespace gsv::ros2
