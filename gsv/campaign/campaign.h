// A campaign: a scenario, and the parameters of the scenario that vary from run to run
// (docs/campaigns.md).
//
// Determinism  the runs, their numbers and their random draws depend only on the file.
// Errors       name the file, the line and the column.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::campaign {

inline constexpr std::size_t kMaxRuns = 1'000'000;  // maximum number of runs of a campaign

struct Engine;
struct EngineRequest;

// A parameter of the scenario that varies from run to run.
struct Parameter {
  enum class Kind { kList, kUniform, kNormal };
  std::string path;         // the path of the parameter in the scenario, such as robots[0].x
  Kind kind = Kind::kList;  // a list of values, or a random number: uniform or normal
  std::vector<std::string> values;  // the values of a kList parameter
  double a = 0, b = 0;  // for kUniform the bounds; for kNormal the mean and the standard deviation
};

// A campaign that was read from its file.
struct Campaign {
  std::string scenario;  // the scenario that the runs vary, as YAML with absolute paths
  std::vector<Parameter> parameters;
  // number of runs for each combination of the values in the lists
  std::size_t draws = 1;
  std::uint64_t draw_seed = 0;  // seed of the random parameters

  std::size_t runs() const;  // The number of runs, at most kMaxRuns.
  // Returns the values of run `run` in the order of the parameters. Runs are counted from 0. The
  // runs go through all combinations of the lists, and do so `draws` times. The value of the last
  // list changes with each run. Each run has its own random values.
  std::vector<std::string> ValuesOf(std::size_t run) const;
  // Returns the scenario with these values, as YAML. Adds the last key of a path if it does not
  // exist. Fails if the scenario does not have the other parts of the path.
  base::Result<std::string> ScenarioWith(const std::vector<std::string>& values) const;
  // Returns a text of all properties that affect the runs. Equal texts mean equal runs.
  std::string Definition() const;
  std::string Identity() const;  // a hash of the definition, 16 hexadecimal digits
};

// Reads a campaign. Inserts each value separately into the scenario, checks the result, and adds
// the errors to `problems`.
base::Result<Campaign> ReadCampaign(const std::filesystem::path& file, base::Problems& problems);
// Reads a campaign. Sets `engine` to the engine that `request` names, or else to the engine in the
// file (engine.h).
base::Result<Campaign> ReadCampaign(const std::filesystem::path& file, base::Problems& problems,
                                    const EngineRequest& request, Engine& engine);

// Returns the whole campaign as one text, for the machines that execute its runs.
std::string ToJson(const Campaign& campaign);
// Reads the output of ToJson().
base::Result<Campaign> CampaignInJson(const std::string& text);

}  // namespace gsv::campaign
