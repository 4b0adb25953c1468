#include "gsv/reality/logs/log_reader.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include <fmt/format.h>

#include "gsv/base/counted.h"
#include "gsv/geometry/constants.h"

namespace gsv::reality {
namespace {

using Reader = base::Result<Log> (*)(const std::filesystem::path&, base::Problems&);

struct Format {
  const char* name;
  Reader read;
};

constexpr Format kFormats[] = {
    {"sonar-ring", ReadSonarRing},
    {"arena", ReadArena},
    {"mrclam", ReadMrclam},
    {"robotdata", ReadRobotData},
    {"carmen", ReadCarmen},
    {"uwb", ReadUwb},
    {"mcap", ReadMcap},
};

// Makes all times relative to the first time of the log.
void StartAtZero(Log& log) {
  double start = geometry::kInfinity;
  const auto each_series = [&](const auto& use) {
    use(log.truth), use(log.odometry), use(log.commands), use(log.wheels), use(log.scans),
        use(log.radio);
  };
  each_series([&](const auto& series) {
    if (!series.empty()) start = std::min(start, series.front().time);
  });
  each_series([&](auto& series) {
    for (auto& each : series) each.time -= start;
  });
  for (RangeScan& scan : log.scans) {
    if (scan.base) scan.base->time = scan.time;
  }
}

// The first scan must have a pose, because localization starts there. Removes the scans before the
// first pose.
void RemoveScansBeforeTheFirstPose(Log& log, const std::filesystem::path& path,
                                   base::Problems& problems) {
  const auto first = std::find_if(log.scans.begin(), log.scans.end(),
                                  [](const RangeScan& scan) { return scan.base.has_value(); });
  if (first == log.scans.begin() || first == log.scans.end()) return;
  problems.push_back(
      {base::Problem::Severity::kWarning,
       "ignored " + base::Counted(static_cast<std::size_t>(first - log.scans.begin()), "scan") +
           " before the first pose",
       path.string()});
  log.scans.erase(log.scans.begin(), first);
}

// Detects one of two formats, by message names at the beginning of the first 64 lines. Returns an
// empty text if no line begins with such a name.
std::string FormatOfTextLog(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::array<char, 1 << 16> start{};
  file.read(start.data(), start.size());
  std::string_view text(start.data(), static_cast<std::size_t>(file.gcount()));
  for (int line = 0; line < 64 && !text.empty(); ++line) {
    const std::string_view word = text.substr(0, text.find_first_of(" \t\r\n"));
    if (word == "L" || word == "O") return "robotdata";
    for (const std::string_view known :
         {"PARAM", "ODOM", "FLASER", "RLASER", "ROBOTLASER1", "RAWLASER1", "TRUEPOS"}) {
      if (word == known) return "carmen";
    }
    const std::size_t end = text.find('\n');
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return {};
}

}  // namespace

base::Result<std::string> GuessLogFormat(const std::filesystem::path& path) {
  const std::string name = path.filename().string();
  std::error_code error;
  if (path.extension() == ".mcap" || std::filesystem::is_directory(path, error)) return "mcap";
  if (name == "measurement.txt") return "sonar-ring";
  if (name.ends_with("_scan.txt")) return "arena";
  if (name.ends_with("_Odometry.dat")) return "mrclam";
  if (name.ends_with("_Input.txt")) return "uwb";
  if (std::string format = FormatOfTextLog(path); !format.empty()) return format;
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    fmt::format("cannot guess the format of this log. Use --as with one of {}",
                                fmt::join(LogFormats(), ", ")),
                    path.string());
}

std::vector<std::string> LogFormats() {
  std::vector<std::string> names;
  for (const Format& format : kFormats) names.emplace_back(format.name);
  return names;
}

base::Result<Log> ReadLog(const std::filesystem::path& path, const std::string& format,
                          base::Problems& problems) {
  for (const Format& each : kFormats) {
    if (format != each.name) continue;
    auto log = each.read(path, problems);
    if (log) RemoveScansBeforeTheFirstPose(*log, path, problems);
    if (log) StartAtZero(*log);
    return log;
  }
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    fmt::format("there is no log format \"{}\"; the formats are {}", format,
                                fmt::join(LogFormats(), ", ")));
}

}  // namespace gsv::reality
