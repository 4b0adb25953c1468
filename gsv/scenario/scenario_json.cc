#include "gsv/scenario/scenario_json.h"

#include "gsv/scenario/scenario_file.h"
#include "gsv/scenario/scenario_keys.h"

namespace gsv::scenario {
namespace {

// Reads JSON with the YAML reader. YAML accepts nearly every JSON text. It refuses only a few, such
// as an object with a key of a thousand letters.
template <typename Read>
auto ReadJson(const std::string& json, base::Problems& problems, const Read& read) {
  const YamlPlace place(YamlPlace::Naming::kFields, "", problems);
  const auto refuse = [&](const std::string& message) { place.AddProblem({}, "", message); };
  YAML::Node node(YAML::NodeType::Map);
  if (json.size() > kMaxScenarioBytes) {
    refuse("a scenario has at most " + std::to_string(kMaxScenarioBytes) + " bytes");
  } else {
    try {
      node = YAML::Load(json);
    } catch (const YAML::Exception& error) {
      refuse("it cannot be read: " + error.msg);
    }
  }
  return read(node, place);
}

}  // namespace

Scenario ParseScenarioJson(const std::string& json, base::Problems& problems) {
  return ReadJson(json, problems, &ReadScenarioKeys);
}

RobotEntry ParseRobotJson(const std::string& json, bool is_avatar, base::Problems& problems) {
  return ReadJson(json, problems, [&](const YAML::Node& node, const YamlPlace& place) {
    YamlMapping mapping(node, "", place);
    return ReadRobotKeys(mapping, is_avatar);
  });
}

Place ParsePlaceJson(const std::string& json, base::Problems& problems) {
  return ReadJson(json, problems, [](const YAML::Node& node, const YamlPlace& place) {
    YamlMapping mapping(node, "", place);
    const auto read = ReadPlaceKeys(mapping);
    if (!mapping.Has("x") && !mapping.Has("y")) mapping.AddProblem("x", "it is missing");
    return read.value_or(Place());
  });
}

}  // namespace gsv::scenario
