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

// Distributions differ in what discovery carries.
enum class Distro { kHumble, kJazzy, kKilted, kLyrical };

struct Options {
  std::optional<dds::Range> range{};  // empty: as the environment says, else localhost
  Distro distro = Distro::kJazzy;
  // namespaces by robot; a robot that is not listed has "/ROBOT"
  std::map<std::string, std::string> namespaces{};
  bool is_cmd_vel_stamped = false;     // TwistStamped, else Twist
  std::shared_ptr<NodeSteps> steps{};  // nodes step the robots that are open in it; null: none
};

base::Result<Distro> ParseDistro(const std::string& text);
base::Result<dds::Range> ParseRange(const std::string& text);
// ROBOT=NAMESPACE.
base::Status ParseNamespace(const std::string& text,
                            std::map<std::string, std::string>& namespaces);

// The value of an environment variable; empty: it is not set.
using Environment = std::function<std::string(const char* name)>;
std::string ProcessEnvironment(const char* name);

// Reads ROS_DOMAIN_ID, ROS_LOCALHOST_ONLY, ROS_AUTOMATIC_DISCOVERY_RANGE, ROS_STATIC_PEERS and the variables of
// security.h.
base::Result<dds::ParticipantOptions> ParticipantFor(const Options& options,
                                                     const Environment& environment);

// Others than this machine can send and receive.
bool IsExposed(const dds::ParticipantOptions& options);

}  // namespace gsv::ros2
