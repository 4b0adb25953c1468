#include "gsv/campaign/engine.h"

#include <algorithm>

#include "gsv/scenario/yaml_mapping.h"

namespace gsv::campaign {

EngineType SlurmEngine();
EngineType SshEngine();

namespace {

EngineType InProcessEngine() {
  EngineType type;
  type.name = "local";
  type.title = "this machine";
  type.help = "on this machine";
  return type;
}

std::string Names() {
  std::string names;
  const auto& types = EngineTypes();
  for (std::size_t i = 0; i < types.size(); ++i)
    names += (i == 0 ? "" : i + 1 == types.size() ? " or " : ", ") + types[i].name;
  return names;
}

// Returns the engine's mapping in the file, merged with the options of the command line.
YAML::Node WithOptions(YAML::Node node, const EngineType& type, const EngineRequest& request) {
  if (!node.IsMap()) return node;
  for (const EngineOption& option : type.options) {
    const auto found = request.options.find(option.flag);
    if (found == request.options.end()) continue;
    for (const std::string& value : found->second) {
      if (!option.is_list) {
        node[option.key] = value;
      } else if (!node[option.key] || node[option.key].IsSequence()) {
        node[option.key].push_back(value);
      }
    }
  }
  return node;
}

}  // namespace

const std::vector<EngineType>& EngineTypes() {
  static const std::vector<EngineType> types{InProcessEngine(), SlurmEngine(), SshEngine()};
  return types;
}

Engine ReadEngine(scenario::YamlMapping& campaign, const EngineRequest& request) {
  const auto& types = EngineTypes();
  const std::string in_file = campaign.Text("engine").value_or(types.front().name);
  const std::string& name = request.name.empty() ? in_file : request.name;
  Engine engine;
  for (const EngineType& type : types) {
    const bool is_chosen = type.name == name;
    if (is_chosen) engine.type = &type;
    if (!type.read) continue;
    auto node = campaign.Any(type.name);
    if (!node && !is_chosen) continue;
    if (!node) node = YAML::Node(YAML::NodeType::Map);
    if (is_chosen) node = WithOptions(*node, type, request);
    scenario::YamlMapping mapping(*node, type.name, campaign.place());
    MakeQueue make_queue = type.read(mapping);
    const double most_runs = static_cast<double>(kMaxRuns);
    const auto runs = mapping.Number("runs_per_task", 1, most_runs);
    const auto former = mapping.Number("runs_a_task", 1, most_runs);  // a former name of the key
    if (runs && former) {
      mapping.AddProblem("runs_a_task",
                         "runs_a_task is the former name of runs_per_task; give only one of them");
    }
    const auto runs_per_task = static_cast<std::size_t>(runs.value_or(former.value_or(0)));
    if (!is_chosen) continue;
    engine.make_queue = std::move(make_queue);
    engine.runs_per_task = request.runs_per_task > 0 ? request.runs_per_task : runs_per_task;
  }
  if (engine.type == nullptr)
    campaign.AddProblem("engine",
                        "there is no engine \"" + name + "\"; the engines are " + Names());
  return engine;
}

}  // namespace gsv::campaign
