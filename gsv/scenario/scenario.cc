#include "gsv/scenario/scenario.h"

#include <charconv>
#include <cmath>
#include <numbers>

namespace gsv::scenario {
namespace {

std::vector<std::string_view> SplitAtCommas(std::string_view text) {
  std::vector<std::string_view> parts;
  for (;;) {
    const std::size_t comma = text.find(',');
    parts.push_back(text.substr(0, comma));
    if (comma == std::string_view::npos) return parts;
    text.remove_prefix(comma + 1);
  }
}

RobotEntry Robot(const char* model, double x, double y, double yaw, const char* behaviour) {
  return {.model = model, .start = Place{x, y, {}, yaw}, .behaviour = behaviour};
}

}  // namespace

std::optional<double> ParseNumber(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = error == std::errc() && end == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

std::optional<double> ParseAngle(std::string_view text) {
  constexpr std::string_view kDegrees = "deg";
  if (!text.ends_with(kDegrees)) return ParseNumber(text);
  text.remove_suffix(kDegrees.size());
  const auto degrees = ParseNumber(text);
  return degrees ? std::optional(*degrees * std::numbers::pi / 180) : std::nullopt;
}

base::Result<RobotEntry> ParseRobot(const std::string& text) {
  const auto refuse = [&](const std::string& why) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      why + "; expected MODEL[@x,y[,yaw]], such as turtlebot3_burger@1,-2,90deg",
                      text);
  };
  const std::size_t at = text.rfind('@');
  RobotEntry robot;
  robot.model = text.substr(0, at);
  if (robot.model.empty()) return refuse("the model is missing");
  if (at == std::string::npos) return robot;
  const auto parts = SplitAtCommas(std::string_view(text).substr(at + 1));
  if (parts.size() < 2 || parts.size() > 3) return refuse("a place has two or three numbers");
  const auto x = ParseNumber(parts[0]);
  const auto y = ParseNumber(parts[1]);
  const auto yaw = parts.size() == 3 ? ParseAngle(parts[2]) : 0.0;
  if (!x || !y || !yaw) return refuse("the place must consist of numbers");
  robot.start = Place{*x, *y, {}, *yaw};
  return robot;
}

base::Result<model::PedestrianGroup> ParsePedestrians(const std::string& text) {
  const auto refuse = [&](const std::string& why) {
    return base::Fail(
        base::ErrorCode::kInvalidArgument,
        why + "; expected COUNT@x,y[,radius][:x,y[,radius]...], such as 20@-4,0,1:4,0,1", text);
  };
  model::PedestrianGroup group;
  const std::size_t at = text.find('@');
  const auto count = ParseNumber(std::string_view(text).substr(0, at));
  if (!count || *count != std::floor(*count) || *count < 1 || *count > model::kMaxPedestrians) {
    return refuse("the count must be a whole number from 1 to 100,000");
  }
  group.count = static_cast<int>(*count);
  if (at == std::string::npos) return refuse("there is no route");
  std::string_view rest = std::string_view(text).substr(at + 1);
  while (true) {
    const std::size_t end = rest.find(':');
    const auto parts = SplitAtCommas(rest.substr(0, end));
    if (parts.size() < 2 || parts.size() > 3) return refuse("a goal has two or three numbers");
    const auto x = ParseNumber(parts[0]), y = ParseNumber(parts[1]);
    const auto radius = parts.size() == 3 ? ParseNumber(parts[2]) : 0.0;
    if (!x || !y || !radius) return refuse("a goal must consist of numbers");
    group.route.push_back({*x, *y, *radius});
    if (end == std::string_view::npos) break;
    rest.remove_prefix(end + 1);
  }
  if (auto ok = model::Check(group); !ok) return refuse(ok.error().message);
  return group;
}

Scenario DefaultScenario() {
  constexpr double kQuarter = std::numbers::pi / 2;
  return {.world = "office",
          .robots = {Robot("b21r", -3.0, 0.0, 0.0, "wander"),
                     Robot("b21r", 0.0, -3.0, kQuarter, "wander"),
                     Robot("pebble", 2.5, 0.0, 2 * kQuarter, "follow-wall"),
                     Robot("pebble", -5.0, 3.0, -kQuarter, "wander"),
                     Robot("rover4", 4.8, 3.5, 0.0, "wander")}};
}

}  // namespace gsv::scenario
