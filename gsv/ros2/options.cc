#include "gsv/ros2/options.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <string_view>

#include "gsv/ros2/names.h"
#include "gsv/ros2/security.h"

namespace gsv::ros2 {
namespace {

constexpr std::uint32_t kMaxDomain = 232;
constexpr std::size_t kMaxPeers = 64;

base::Result<std::uint32_t> ParseDomain(const std::string& text) {
  std::uint32_t domain = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), domain);
  if (error == std::errc() && end == text.data() + text.size() && domain <= kMaxDomain)
    return domain;
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "must be a number from 0 to 232, found '" + text + "'", "ROS_DOMAIN_ID");
}

std::vector<std::string> SplitPeers(std::string_view text) {
  std::vector<std::string> peers;
  while (!text.empty()) {
    const std::string_view peer = text.substr(0, text.find(';'));
    if (!peer.empty()) peers.emplace_back(peer);
    text.remove_prefix(std::min(text.size(), peer.size() + 1));
  }
  return peers;
}

bool IsThisMachine(const std::string& peer) {
  return peer == "localhost" || peer.starts_with("127.");
}

// Returns nullopt if the environment does not set the range.
base::Result<std::optional<dds::Range>> RangeOf(const Environment& environment) {
  const std::string only = environment("ROS_LOCALHOST_ONLY");
  if (!only.empty() && only != "0" && only != "1") {
    return base::Fail(base::ErrorCode::kInvalidArgument, "must be 0 or 1, found '" + only + "'",
                      "ROS_LOCALHOST_ONLY");
  }
  if (only == "1") return dds::Range::kLocalhost;
  const std::string range = environment("ROS_AUTOMATIC_DISCOVERY_RANGE");
  if (range.empty()) return std::nullopt;
  if (range == "LOCALHOST") return dds::Range::kLocalhost;
  if (range == "SUBNET" || range == "SYSTEM_DEFAULT") return dds::Range::kSubnet;
  if (range == "OFF") {
    return base::Fail(
        base::ErrorCode::kInvalidArgument,
        "with OFF, gsv cannot communicate with ROS 2 nodes. Unset it, or use --ros2-range",
        "ROS_AUTOMATIC_DISCOVERY_RANGE");
  }
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "must be LOCALHOST, SUBNET, SYSTEM_DEFAULT or OFF, found '" + range + "'",
                    "ROS_AUTOMATIC_DISCOVERY_RANGE");
}

}  // namespace

base::Result<Distro> ParseDistro(const std::string& text) {
  if (text == "humble") return Distro::kHumble;
  if (text == "jazzy") return Distro::kJazzy;
  if (text == "kilted") return Distro::kKilted;
  if (text == "lyrical") return Distro::kLyrical;
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "must be humble, jazzy, kilted or lyrical, found '" + text + "'");
}

base::Result<dds::Range> ParseRange(const std::string& text) {
  if (text == "localhost") return dds::Range::kLocalhost;
  if (text == "subnet") return dds::Range::kSubnet;
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "must be localhost or subnet, found '" + text + "'");
}

base::Status ParseNamespace(const std::string& text,
                            std::map<std::string, std::string>& namespaces) {
  const std::size_t equals = text.rfind('=');
  const bool is_pair = equals != std::string::npos && equals > 0;
  if (!is_pair || !IsNamespace(std::string_view(text).substr(equals + 1))) {
    return base::Fail(
        base::ErrorCode::kInvalidArgument,
        "expected ROBOT=NAMESPACE, such as pebble=/ or pebble=/fleet/one, found '" + text + "'");
  }
  namespaces[text.substr(0, equals)] = text.substr(equals + 1);
  return {};
}

std::string ProcessEnvironment(const char* name) {
  const char* const value = std::getenv(name);
  return value == nullptr ? "" : value;
}

base::Result<dds::ParticipantOptions> ParticipantFor(const Options& options,
                                                     const Environment& environment) {
  dds::ParticipantOptions participant;
  if (auto ok = UseSecurity(environment, participant); !ok) return base::Fail(ok.error());
  if (const std::string domain = environment("ROS_DOMAIN_ID"); !domain.empty()) {
    const auto parsed = ParseDomain(domain);
    if (!parsed) return base::Fail(parsed.error());
    participant.domain = *parsed;
  }
  participant.peers = SplitPeers(environment("ROS_STATIC_PEERS"));
  if (participant.peers.size() > kMaxPeers) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "at most 64 peers, found " + std::to_string(participant.peers.size()),
                      "ROS_STATIC_PEERS");
  }
  if (options.range) {
    participant.range = *options.range;
    if (participant.range == dds::Range::kLocalhost) participant.peers.clear();
    return participant;
  }
  const auto range = RangeOf(environment);
  if (!range) return base::Fail(range.error());
  participant.range = range->value_or(dds::Range::kLocalhost);
  // As in rcl, this variable also excludes the peers of ROS_STATIC_PEERS.
  if (environment("ROS_LOCALHOST_ONLY") == "1") participant.peers.clear();
  std::erase_if(participant.peers, IsThisMachine);
  if (participant.range == dds::Range::kLocalhost && !participant.peers.empty()) {
    participant.range = dds::Range::kPeers;
  }
  return participant;
}

bool IsExposed(const dds::ParticipantOptions& options) {
  return options.range != dds::Range::kLocalhost;
}

}  // namespace gsv::ros2
