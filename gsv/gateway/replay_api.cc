#include "gsv/gateway/replay_api.h"

#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include "gsv/gateway/command_json.h"
#include "gsv/gateway/status_json.h"

namespace gsv::gateway {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kLatest = 9e9;  // s: what nanoseconds can hold

using Action = std::function<base::Status(ReplayPlayer& player, const std::string& body)>;

base::Status StepBy(ReplayPlayer& player, const std::string& body) {
  const base::Result<std::int64_t> count = ParseStepCount(body);
  if (!count) return base::Fail(count.error());
  return player.Step(*count);
}

base::Status SeekTo(ReplayPlayer& player, const std::string& body) {
  const base::Result<base::SimTime> time = ParseSeekTime(body);
  if (!time) return base::Fail(time.error());
  player.Seek(*time);
  return {};
}

base::Status Rewind(ReplayPlayer& player, const std::string&) {
  player.Rewind();
  return {};
}

const std::map<std::string, Action>& Actions() {
  static const std::map<std::string, Action> kActions{
      {"start", [](ReplayPlayer& p, const std::string&) { return p.Start(); }},
      {"pause", [](ReplayPlayer& p, const std::string&) { return p.Pause(); }},
      {"resume", [](ReplayPlayer& p, const std::string&) { return p.Resume(); }},
      {"stop", &Rewind},
      {"reset", &Rewind},
      {"step", &StepBy},
      {"seek", &SeekTo},
  };
  return kActions;
}

Response NoSuchAddress() {
  return ErrorResponse(404, "there is nothing at this address; docs/api.yaml lists what there is");
}

Response JsonOr(const base::Result<SharedBytes>& json) {
  if (!json) return ErrorResponse(json.error());
  Response response;
  response.content_type = "application/json";
  response.body = *json;
  return response;
}

}  // namespace

base::Result<base::SimTime> ParseSeekTime(std::string_view body) {
  const nlohmann::json json = nlohmann::json::parse(body, nullptr, false);
  const auto time = json.is_object() ? json.find("time_s") : json.end();
  const bool is_number = json.is_object() && time != json.end() && time->is_number();
  const double seconds = is_number ? time->get<double>() : NAN;
  if (!(std::abs(seconds) < kLatest)) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "to seek, give {\"time_s\": T} with simulated seconds since the start");
  }
  return base::FromSeconds(seconds);
}

Response ReplayApi::Handle(const Request& request) {
  const std::vector<std::string>& path = request.target.segments;
  if (path.size() < 2) return NoSuchAddress();
  const bool is_get = request.method == "GET";
  if (path[1] == "models") return is_get ? Model(request) : MethodNotAllowed("GET");
  if (path[1] != "simulations") return NoSuchAddress();
  if (path.size() > 2) return OfSimulation(request);
  if (!is_get) return MethodNotAllowed("GET");
  return JsonResponse(200, SimulationListJson({player_.status()}));
}

Response ReplayApi::OfSimulation(const Request& request) {
  const std::vector<std::string>& path = request.target.segments;
  if (path[2] != player_.name()) {
    return ErrorResponse(404, "there is no simulation '" + path[2] + "'; this is a replay of '" +
                                  player_.name() + "'");
  }
  const bool is_get = request.method == "GET";
  if (path.size() == 3) {
    return is_get ? JsonResponse(200, StatusJson(player_.status())) : MethodNotAllowed("GET");
  }
  if (path.size() > 4) {
    return ErrorResponse(409, "this is a replay: what the robots did cannot be changed");
  }
  if (path[3] == "scene") return is_get ? JsonOr(player_.SceneNow()) : MethodNotAllowed("GET");
  if (path[3] == "replay") return is_get ? Timeline() : MethodNotAllowed("GET");
  if (!Actions().contains(path[3])) return NoSuchAddress();
  return is_get ? MethodNotAllowed("POST") : Act(path[3], request.body);
}

Response ReplayApi::Act(const std::string& action, const std::string& body) {
  const base::Status done = Actions().at(action)(player_, body);
  if (!done) return ErrorResponse(done.error());
  return JsonResponse(200, StatusJson(player_.status()));
}

Response ReplayApi::Timeline() const {
  const ReplayClock clock = player_.clock();
  const Json json{{"start_s", base::ToSeconds(clock.start())},
                  {"end_s", base::ToSeconds(clock.end())},
                  {"time_s", base::ToSeconds(clock.position())},
                  {"speed", clock.speed()},
                  {"loop", clock.loop()}};
  return JsonResponse(200, json.dump());
}

// /api/models/ID.glb
Response ReplayApi::Model(const Request& request) const {
  const std::vector<std::string>& path = request.target.segments;
  static constexpr std::string_view kEnding = ".glb";
  if (path.size() != 3 || !path[2].ends_with(kEnding)) return NoSuchAddress();
  const std::string id = path[2].substr(0, path[2].size() - kEnding.size());
  const base::Result<SharedBytes> glb = player_.scene().Model(id);
  if (!glb) return ErrorResponse(glb.error());
  Response response;
  response.content_type = "model/gltf-binary";
  response.etag = '"' + id + '"';
  response.cache_control = "public, max-age=31536000, immutable";
  if (Matches(request.if_none_match, response.etag)) {
    response.status = 304;
  } else {
    response.body = *glb;
  }
  return response;
}

}  // namespace gsv::gateway
