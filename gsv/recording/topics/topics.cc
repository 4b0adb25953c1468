#include "gsv/recording/topics/topics.h"

#include <algorithm>

#include "gsv/base/sorting.h"
#include "gsv/presentation/sensor_messages.h"
#include "gsv/presentation/topics.h"
#include "gsv/recording/reading/selection.h"
#include "gsv/recording/topics/simulation_feed.h"

namespace gsv::recording {

std::vector<std::string> TopicsOf(const simulation::Simulation& simulation) {
  std::vector<std::string> names;
  for (const presentation::Topic& topic : presentation::Topics()) {
    const bool is_chosen = topic.name != presentation::topics::kEdits.name;
    if (topic.is_recorded && is_chosen) names.emplace_back(topic.name);
  }
  for (const auto& [robot, sensors] : SensorsOf(simulation, *simulation.snapshot()->layout)) {
    const auto its = presentation::SensorTopicNames(simulation, robot);
    names.insert(names.end(), its.begin(), its.end());
  }
  base::Sort(names);
  return names;
}

std::vector<std::string> UnmatchedPatterns(const std::vector<std::string>& topics,
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
