// A campaign: a scenario, and parameters of it that are varied (docs/campaigns.md).
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

inline constexpr std::size_t kMaxRuns = 1'000'000;

struct Engine;
struct EngineRequest;

struct Parameter {
  enum class Kind { kList, kUniform, kNormal };
  std::string path;  // into the scenario, as in robots[0].x
  Kind kind = Kind::kList;
  std::vector<std::string> values;  // kList
  double a = 0, b = 0;              // kUniform: from, to; kNormal: mean, standard deviation
};

struct Campaign {
  std::string scenario;  // the scenario that the runs vary, as YAML with absolute paths
  std::vector<Parameter> parameters;
  std::size_t draws = 1;  // of random parameters, for each point of the grid of lists
  std::uint64_t draw_seed = 0;

  std::size_t runs() const;  // at most kMaxRuns
  // The values of a run, from 0 on, in the order of the parameters. The last list varies fastest,
  // and the draws before it.
  std::vector<std::string> ValuesOf(std::size_t run) const;
  // The scenario with these values, as YAML. Fails when the scenario lacks a path.
  base::Result<std::string> ScenarioWith(const std::vector<std::string>& values) const;
  // Everything that affects the runs: equal texts mean equal runs.
  std::string Definition() const;
  std::string Identity() const;  // a hash of the definition, 16 hexadecimal digits
};

// Checks each value alone in the scenario and adds the errors to `problems`.
base::Result<Campaign> ReadCampaign(const std::filesystem::path& file, base::Problems& problems);
// Also sets `engine` to the one that `request` names, else the one that the file names (engine.h).
base::Result<Campaign> ReadCampaign(const std::filesystem::path& file, base::Problems& problems,
                                    const EngineRequest& request, Engine& engine);

// The whole campaign as one text, for the machines that execute its runs.
std::string ToJson(const Campaign& campaign);
base::Result<Campaign> CampaignInJson(const std::string& text);

}  // namespace gsv::campaign
