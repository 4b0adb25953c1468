#include "gsv/reality/logs/log_reader.h"

#include <algorithm>

#include <fmt/format.h>

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

// Times count from the first of the log.
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

}  // namespace

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
    if (log) StartAtZero(*log);
    return log;
  }
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    fmt::format("there is no log format \"{}\"; the formats are {}", format,
                                fmt::join(LogFormats(), ", ")));
}

}  // namespace gsv::reality
