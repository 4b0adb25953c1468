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
    json.at("identity").get_to(identity);
    json.at("draws").get_to(campaign.draws);
    json.at("draw_seed").get_to(campaign.draw_seed);
    json.at("scenario").get_to(campaign.scenario);
    for (const auto& json_parameter : json.at("parameters")) {
      const int kind = json_parameter.at("kind").get<int>();
      if (kind < 0 || kind > 2)
        return base::Fail(base::ErrorCode::kCorrupt, "this file is not the plan of a campaign");
      Parameter& parameter = campaign.parameters.emplace_back();
      parameter.kind = static_cast<Parameter::Kind>(kind);
      json_parameter.at("path").get_to(parameter.path);
      json_parameter.at("values").get_to(parameter.values);
      json_parameter.at("a").get_to(parameter.a);
      json_parameter.at("b").get_to(parameter.b);
    }
  } catch (const nlohmann::json::exception&) {
    return base::Fail(base::ErrorCode::kCorrupt, "this file is not the plan of a campaign");
  }
  if (identity != campaign.Identity() || campaign.runs() > kMaxRuns)
    return base::Fail(base::ErrorCode::kCorrupt, "the plan was changed after it was written");
  return campaign;
}

}  // namespace gsv::campaign
