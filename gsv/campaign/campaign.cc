#include "gsv/campaign/campaign.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstring>
#include <fstream>

#include <fmt/format.h>

#include "gsv/base/hash.h"
#include "gsv/base/random.h"
#include "gsv/campaign/engine.h"
#include "gsv/scenario/scenario_file.h"
#include "gsv/scenario/test_keys.h"
#include "gsv/scenario/yaml_mapping.h"

namespace gsv::campaign {
namespace {

using scenario::YamlMapping;
using scenario::YamlPlace;

constexpr double kMaxNumber = 1e9;
constexpr std::size_t kMaxParameters = 64, kMaxValues = 100'000;

// Sets the value at a path such as "robots[0].x". If only the last key of the path does not exist,
// adds it. Returns false if any other part of the path does not exist.
bool SetAt(YAML::Node node, const std::string& path, const std::string& value) {
  std::size_t at = 0;
  for (;;) {
    if (path[at] == '[') {
      const std::size_t end = path.find(']', at);
      std::size_t index = 0;
      if (end == std::string::npos) return false;
      const auto [stop, error] = std::from_chars(&path[at + 1], &path[end], index);
      if (error != std::errc() || stop != &path[end]) return false;
      if (!node.IsSequence() || index >= node.size()) return false;
      node.reset(node[index]);
      at = end + 1;
    } else {
      const std::size_t end = std::min(path.find_first_of(".[", at), path.size());
      const std::string key = path.substr(at, end - at);
      if (key.empty() || !node.IsMap()) return false;
      const bool is_last = end == path.size();
      if (!is_last && !node[key]) return false;
      if (is_last) {
        node[key] = YAML::Load(value);
        return true;
      }
      node.reset(node[key]);
      at = end;
    }
    if (at == path.size()) {
      node = YAML::Load(value);
      return true;
    }
    if (path[at] == '.') ++at;
  }
}

class ParameterReader {
 public:
  explicit ParameterReader(const YamlPlace& place) : place_(place) {}

  std::vector<Parameter> Read(const YAML::Node& node) {
    std::vector<Parameter> parameters;
    if (!node.IsMap() || node.size() > kMaxParameters) {
      place_.AddProblem(
          node.Mark(), "parameters",
          "parameters must be a mapping with at most 64 keys, which are paths in the scenario");
      return parameters;
    }
    for (const auto& entry : node) {
      Parameter parameter;
      parameter.path = entry.first.IsScalar() ? entry.first.Scalar() : "";
      if (entry.second.IsSequence()) {
        ReadList(entry.second, parameter);
      } else {
        ReadRule(entry.second, parameter);
      }
      parameters.push_back(std::move(parameter));
    }
    return parameters;
  }

 private:
  void ReadList(const YAML::Node& list, Parameter& parameter) const {
    for (const YAML::Node& value : list) {
      if (value.IsScalar()) {
        const bool is_quoted = value.Tag() == "!";
        parameter.values.push_back(is_quoted ? scenario::OneLineYaml(value) : value.Scalar());
      } else {
        place_.AddProblem(value.Mark(), parameter.path, "a value must be a number or a text");
      }
    }
    if (list.size() == 0) place_.AddProblem(list.Mark(), parameter.path, "the list is empty");
  }

  void ReadRule(const YAML::Node& node, Parameter& parameter) const {
    YamlMapping mapping(node, parameter.path, place_);
    const auto from = mapping.Number("from", -kMaxNumber, kMaxNumber);
    const auto to = mapping.Number("to", -kMaxNumber, kMaxNumber);
    const auto step = mapping.Number("step", 1e-9, kMaxNumber);
    const bool is_uniform = ReadPair(mapping, "uniform", parameter);
    const bool is_normal = ReadPair(mapping, "normal", parameter);
    const bool is_range = mapping.Has("from") || mapping.Has("to") || mapping.Has("step");
    if (mapping.is_mapping() && is_range + is_uniform + is_normal != 1) {
      mapping.AddProblem(
          "a parameter must be a list, {from, to, step}, {uniform: [A, B]} or {normal: [MEAN, "
          "DEVIATION]}");
      return;
    }
    if (is_uniform) parameter.kind = Parameter::Kind::kUniform;
    if (is_normal) parameter.kind = Parameter::Kind::kNormal;
    if (!is_range) return;
    const double stride = step.value_or(1);
    if (!from || !to) {
      mapping.AddProblem("a range needs the keys \"from\" and \"to\"");
      return;
    }
    if (*from > *to) {
      mapping.AddProblem(
          "from", fmt::format("\"from\" is {}, but must not be larger than \"to\", which is {}",
                              *from, *to));
      return;
    }
    if ((*to - *from) / stride >= kMaxValues) {
      mapping.AddProblem(
          "step", fmt::format("the range has more than {} values; use a larger step", kMaxValues));
      return;
    }
    // The tolerance allows for rounding, so that the range includes its end.
    const auto count = static_cast<int>(std::floor((*to - *from) / stride + 1e-9)) + 1;
    for (int i = 0; i < count; ++i)
      parameter.values.push_back(fmt::format("{}", *from + i * stride));
  }

  static bool ReadPair(YamlMapping& mapping, const char* key, Parameter& parameter) {
    const std::vector<std::string> ends = mapping.Texts(key);
    if (!mapping.Has(key)) return false;
    const auto a = ends.size() == 2 ? scenario::ParseNumber(ends[0]) : std::nullopt;
    const auto b = ends.size() == 2 ? scenario::ParseNumber(ends[1]) : std::nullopt;
    if (!a || !b) mapping.AddProblem(key, std::string(key) + " must be two numbers");
    parameter.a = a.value_or(0);
    parameter.b = b.value_or(0);
    return true;
  }

  const YamlPlace& place_;
};

std::string Drawn(std::uint64_t seed, const Parameter& parameter, std::size_t run) {
  base::Noise noise(seed, base::StableId(parameter.path), run);
  const double value = parameter.kind == Parameter::Kind::kUniform
                           ? parameter.a + noise.Uniform() * (parameter.b - parameter.a)
                           : parameter.a + parameter.b * noise.Gaussian();
  return fmt::format("{}", value);
}

// Checks the scenario with each value of a parameter separately, so that errors are reported before
// any run begins.
void TryValues(const Campaign& campaign, const std::string& file, base::Problems& problems) {
  Campaign alone = campaign;
  for (const Parameter& parameter : campaign.parameters) {
    std::vector<std::string> values = parameter.values;
    if (values.empty()) values.push_back(Drawn(campaign.draw_seed, parameter, 0));
    alone.parameters = {parameter};
    for (const std::string& value : values) {
      const std::string where = file + ": " + parameter.path + " = " + value;
      const auto text = alone.ScenarioWith({value});
      base::Problems found;
      if (!text) {
        problems.push_back({base::Problem::Severity::kError, text.error().message, where});
      } else if (auto read = scenario::ParseScenario(*text, "scenario", found); !read) {
        problems.push_back({base::Problem::Severity::kError, read.error().Sentence(), where});
      } else if (!found.empty()) {
        problems.push_back({base::Problem::Severity::kError, found.front().message, where});
      }
      if (problems.size() >= scenario::kMaxProblems) return;
    }
  }
}

}  // namespace

std::size_t Campaign::runs() const {
  std::size_t runs = draws;
  for (const Parameter& parameter : parameters) {
    if (parameter.kind != Parameter::Kind::kList) continue;
    runs = std::min(kMaxRuns + 1, runs * parameter.values.size());
  }
  return runs;
}

std::vector<std::string> Campaign::ValuesOf(std::size_t run) const {
  std::vector<std::string> values(parameters.size());
  std::size_t left = run;
  for (std::size_t i = parameters.size(); i-- > 0;) {
    const Parameter& parameter = parameters[i];
    if (parameter.kind != Parameter::Kind::kList) continue;
    values[i] = parameter.values[left % parameter.values.size()];
    left /= parameter.values.size();
  }
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    if (parameters[i].kind == Parameter::Kind::kList) continue;
    values[i] = Drawn(draw_seed, parameters[i], run);
  }
  return values;
}

base::Result<std::string> Campaign::ScenarioWith(const std::vector<std::string>& values) const {
  try {
    YAML::Node node = YAML::Load(scenario);
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (SetAt(node, parameters[i].path, values[i])) continue;
      return base::Fail(base::ErrorCode::kBadModel,
                        "the scenario has no such key; a path has the form robots[0].x",
                        parameters[i].path);
    }
    return YAML::Dump(node) + "\n";
  } catch (const YAML::Exception& error) {
    return base::Fail(base::ErrorCode::kBadModel, "a value is not valid YAML: " + error.msg);
  }
}

std::string Campaign::Definition() const {
  std::string text = fmt::format("{}\ndraws {} seed {}\n", scenario, draws, draw_seed);
  for (const Parameter& p : parameters) {
    text += fmt::format("{} {} {} {}", p.path, static_cast<int>(p.kind), p.a, p.b);
    for (const std::string& value : p.values) text += " " + value;
    text += "\n";
  }
  return text;
}

std::string Campaign::Identity() const {
  base::Hash hash;
  hash.Add(std::string_view(Definition()));
  return hash.Hex();
}

base::Result<Campaign> ReadCampaign(const std::filesystem::path& file, base::Problems& problems) {
  Engine ignored;
  return ReadCampaign(file, problems, {}, ignored);
}

base::Result<Campaign> ReadCampaign(const std::filesystem::path& file, base::Problems& problems,
                                    const EngineRequest& request, Engine& engine) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) {
    return base::Fail(base::ErrorCode::kNotFound,
                      std::string("cannot open the campaign file: ") + std::strerror(errno), file);
  }
  std::string text(scenario::kMaxScenarioBytes + 1, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  const YamlPlace place(YamlPlace::Naming::kLines, file, problems);
  Campaign campaign;
  std::string scenario_file;
  try {
    if (text.size() > scenario::kMaxScenarioBytes)
      return base::Fail(base::ErrorCode::kBadModel,
                        "the campaign file is too large; at most 4 MiB are allowed", file);
    YamlMapping mapping(YAML::Load(text), "", place);
    scenario_file = mapping.Text("scenario").value_or("");
    if (mapping.is_mapping() && scenario_file.empty())
      mapping.AddProblem("scenario",
                         "the key scenario is required; it names the file that each run varies");
    if (const auto node = mapping.Any("parameters"))
      campaign.parameters = ParameterReader(place).Read(*node);
    campaign.draws = static_cast<std::size_t>(mapping.Number("draws", 1, kMaxRuns).value_or(1));
    campaign.draw_seed = mapping.Count("draw_seed").value_or(0);
    engine = ReadEngine(mapping, request);
  } catch (const YAML::Exception& error) {
    return base::Fail(base::ErrorCode::kBadModel, "it is not valid YAML: " + error.msg,
                      place.Of(error.mark, ""));
  }
  if (!problems.empty()) return campaign;
  auto scenario = scenario::ReadScenario(file.parent_path() / scenario_file, problems);
  if (!scenario) return base::Fail(scenario.error());
  if (scenario->duration.value_or(0) <= 0) {
    return base::Fail(base::ErrorCode::kBadModel, "a run needs an end: set duration, in seconds",
                      scenario_file);
  }
  campaign.scenario = scenario::ToYaml(*scenario);
  if (campaign.runs() > kMaxRuns) {
    return base::Fail(base::ErrorCode::kBadModel, "too many runs; a campaign has at most 1,000,000",
                      file);
  }
  if (problems.empty()) TryValues(campaign, file, problems);
  return campaign;
}

}  // namespace gsv::campaign
