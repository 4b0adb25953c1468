// Converts a campaign to JSON and back. A campaign that is submitted to a job queue is stored so in
// the spool. Later changes of the campaign's file do not affect this copy.
#include <nlohmann/json.hpp>

#include "gsv/campaign/campaign.h"

namespace gsv::campaign {

std::string ToJson(const Campaign& campaign) {
  auto parameters = nlohmann::ordered_json::array();
  for (const Parameter& parameter : campaign.parameters) {
    parameters.push_back({{"path", parameter.path},
                          {"kind", static_cast<int>(parameter.kind)},
                          {"values", parameter.values},
                          {"a", parameter.a},
                          {"b", parameter.b}});
  }
  const nlohmann::ordered_json json{{"identity", campaign.Identity()},
                                    {"draws", campaign.draws},
                                    {"draw_seed", campaign.draw_seed},
                                    {"parameters", parameters},
                                    {"scenario", campaign.scenario}};
  return json.dump(1) + "\n";
}

base::Result<Campaign> CampaignInJson(const std::string& text) {
  Campaign campaign;
  std::string identity;
  try {
    const auto json = nlohmann::json::parse(text);
    identity = json.at("identity");
    campaign.draws = json.at("draws");
    campaign.draw_seed = json.at("draw_seed");
    campaign.scenario = json.at("scenario");
    for (const auto& parameter : json.at("parameters")) {
      const int kind = parameter.at("kind");
      if (kind < 0 || kind > 2)
        return base::Fail(base::ErrorCode::kCorrupt, "this file is not the plan of a campaign");
      campaign.parameters.push_back({parameter.at("path"), static_cast<Parameter::Kind>(kind),
                                     parameter.at("values"), parameter.at("a"), parameter.at("b")});
    }
  } catch (const nlohmann::json::exception&) {
    return base::Fail(base::ErrorCode::kCorrupt, "this file is not the plan of a campaign");
  }
  if (identity != campaign.Identity() || campaign.runs() > kMaxRuns)
    return base::Fail(base::ErrorCode::kCorrupt, "the plan was changed after it was written");
  return campaign;
}

}  // namespace gsv::campaign
