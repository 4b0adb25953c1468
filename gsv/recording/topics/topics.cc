#include "gsv/recording/topics/topics.h"

#include <algorithm>

#include "gsv/presentation/state_messages.h"
#include "gsv/recording/reading/selection.h"
#include "gsv/recording/topics/simulation_feed.h"

namespace gsv::recording {
namespace {

// Those of StateTopics and SensorTopics that are there whatever stands in the world.
constexpr const char* kTopicsOfAll[]{
    "/clock",        "/diagnostics",    "/gsv/actuators", "/gsv/beams",
    "/gsv/commands", "/gsv/contacts",   "/gsv/events",    "/gsv/poses",
    "/gsv/radio",    "/gsv/state_hash", "/gsv/status",    "/rosout",
    "/tf",           "/tf_static"};

}  // namespace

std::vector<std::string> TopicsOf(const simulation::Simulation& simulation) {
  std::vector<std::string> topics(std::begin(kTopicsOfAll), std::end(kTopicsOfAll));
  for (const auto& [robot, sensors] : SensorsOf(simulation, *simulation.snapshot()->layout)) {
    for (const model::SensorDescription& sensor : sensors) {
      const sensing::SensorType* type = simulation.sensor_types().Find(sensor.type);
      if (type == nullptr || type->schema == nullptr) continue;
      const std::string topic = "/" + presentation::FrameOf(robot, sensor.name);
      topics.push_back(topic);
      if (type->companion) topics.push_back(topic + "/" + type->companion->topic);
    }
  }
  std::sort(topics.begin(), topics.end());
  return topics;
}

std::vector<std::string> PatternsWithout(const std::vector<std::string>& topics,
                                         const std::vector<std::string>& patterns) {
  std::vector<std::string> without;
  for (const std::string& pattern : patterns) {
    const Selection selection{.topics = {pattern}};
    const bool stands_for_one =
        std::any_of(topics.begin(), topics.end(),
                    [&](const std::string& topic) { return selection.Has(topic); });
    if (!stands_for_one) without.push_back(pattern);
  }
  return without;
}

}  // namespace gsv::recording
