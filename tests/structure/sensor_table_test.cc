// Tests that docs/sensors.md lists every registered sensor type.
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <gtest/gtest.h>

#include "gsv/rendering/cameras/camera_sensor.h"
#include "gsv/rendering/cameras/ground_truth_sensors.h"
#include "gsv/sensing/devices/built_in.h"

namespace gsv {
namespace {

std::vector<std::string> LinesOfPage() {
  const char* const source = std::getenv("GSV_SOURCE_DIR");
  std::ifstream page(std::filesystem::path(source == nullptr ? "." : source) / "docs/sensors.md");
  std::vector<std::string> lines;
  for (std::string line; std::getline(page, line);) lines.push_back(line);
  return lines;
}

std::string NamesOf(const sensing::SensorType& type) {
  std::string names = "`" + type.name + "`";
  for (const std::string& alias : type.aliases) {
    names += (alias == type.aliases.front() ? " (`" : ", `") + alias + "`";
  }
  return type.aliases.empty() ? names : names + ")";
}

// Returns the name in the form "sensor_msgs/Range".
std::string MessageOf(const sensing::SensorType& type) {
  std::string name(type.schema->name);
  const std::size_t at = name.find("/msg/");
  return name.replace(at, 5, "/");
}

const char* ShownAs(sensing::Overlay overlay) {
  switch (overlay) {
    case sensing::Overlay::kNone:
      return "";
    case sensing::Overlay::kLines:
      return "lines";
    case sensing::Overlay::kPoints:
      return "points";
    case sensing::Overlay::kImage:
      return "image";
  }
  return "";
}

std::string RowOf(const sensing::SensorType& type) {
  const std::string shown = ShownAs(type.overlay);
  return "| " + NamesOf(type) + " | " + type.layout.Text() + " | `" + MessageOf(type) + "` | " +
         shown + (shown.empty() ? "|" : " |");
}

TEST(SensorTable, ListsEveryTypeWithItsReadingMessageAndOverlay) {
  sensing::SensorRegistry registry;
  sensing::AddBuiltInSensors(registry);
  ASSERT_TRUE(rendering::AddCameraSensor(registry, nullptr));
  ASSERT_TRUE(rendering::AddGroundTruthSensors(registry, nullptr));
  const std::vector<std::string> lines = LinesOfPage();
  ASSERT_FALSE(lines.empty());
  for (const std::string& name : registry.names()) {
    const std::string row = RowOf(*registry.Find(name));
    EXPECT_TRUE(std::any_of(lines.begin(), lines.end(),
                            [&](const std::string& line) { return line.starts_with(row); }))
        << "docs/sensors.md lacks a row that begins with\n"
        << row;
  }
}

}  // namespace
}  // namespace gsv
