#include "gsv/gateway/api/replay_api.h"

#include <charconv>
#include <cmath>
#include <functional>
#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include "gsv/gateway/api/answers.h"
#include "gsv/gateway/api/command_json.h"
#include "gsv/gateway/api/status_json.h"

namespace gsv::gateway {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::size_t kUsualCurvePoints = 4000;
constexpr double kLatest = 9e9;  // s: what nanoseconds can hold

using Action = std::function<base::Status(ReplayPlayer& player, const std::string& body)>;

// {"poses": N} steps over recorded poses, {"count": N} over steps of the simulation.
base::Status StepBy(ReplayPlayer& player, const std::string& body) {
  const nlohmann::json json = nlohmann::json::parse(body, nullptr, false);
  if (json.is_object() && json.contains("poses")) {
    const bool is_whole = json["poses"].is_number_integer();
    return player.StepPoses(is_whole ? json["poses"].get<std::int64_t>() : 0);
  }
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

Response JsonOr(const base::Result<SharedBytes>& json) {
  if (!json) return ErrorResponse(json.error());
  Response response;
  response.content_type = "application/json";
  response.body = *json;
  return response;
}

curves::CurveWish CurveWishOf(const Target& target) {
  curves::CurveWish wish{.most = kUsualCurvePoints};
  for (const auto& [name, value] : target.query) {
    if (name == "topic") wish.topic = value;
    if (name == "robot") wish.robot = value;
    if (name == "key") wish.key = value;
    if (name != "most") continue;
    const auto parsed = std::from_chars(value.data(), value.data() + value.size(), wish.most);
    const bool is_number = parsed.ec == std::errc() && parsed.ptr == value.data() + value.size();
    if (!is_number) wish.most = 0;  // is refused with the others that are out of range
  }
  return wish;
}

}  // namespace

base::Result<ReplayChange> ParseReplayChange(std::string_view body) {
  const nlohmann::json json = nlohmann::json::parse(body, nullptr, false);
  const auto fail = [] {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "to change a replay, give {\"speed\": number, \"loop\": true or false}");
  };
  if (!json.is_object()) return fail();
  ReplayChange change;
  if (const auto speed = json.find("speed"); speed != json.end()) {
    if (!speed->is_number()) return fail();
    change.speed = speed->get<double>();
  }
  if (const auto loop = json.find("loop"); loop != json.end()) {
    if (!loop->is_boolean()) return fail();
    change.loop = loop->get<bool>();
  }
  return change;
}

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
  if (path[1] == "models") {
    return ModelAnswer(request,
                       [this](const std::string& id) { return player_.scene().Model(id); });
  }
  if (path[1] == "server" && path.size() == 2) {
    return is_get ? Server() : MethodNotAllowed("GET");
  }
  if (path[1] != "simulations") return NoSuchAddress();
  if (path.size() > 2) return OfSimulation(request);
  if (!is_get) return MethodNotAllowed("GET");
  return JsonResponse(200, SimulationListJson({player_.status()}));
}

Response ReplayApi::Server() const {
  const OrderedJson json{{"creates", false},
                         {"records", false},
                         {"recordings", !recording_.empty()},
                         {"recording", recording_}};
  return JsonResponse(200, json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace));
}

Response ReplayApi::OfSimulation(const Request& request) {
  const std::vector<std::string>& path = request.target.segments;
  if (path[2] != player_.name()) {
    return ErrorResponse(404, "there is no simulation '" + path[2] + "'; this is a replay of '" +
                                  player_.name() + "'");
  }
  const bool is_get = request.method == "GET";
  if (path.size() == 3) {
    return is_get ? Status() : MethodNotAllowed("GET");
  }
  if (path.size() == 6 && path[3] == "robots" && path[5] == "topics") {
    return is_get ? Topics(path[4]) : MethodNotAllowed("GET");
  }
  if (path.size() > 4) {
    return ErrorResponse(409, "this is a replay: what the robots did cannot be changed");
  }
  if (path[3] == "scene") return is_get ? JsonOr(player_.SceneNow()) : MethodNotAllowed("GET");
  if (path[3] == "replay") return Replay(request);
  if (path[3] == "events") return is_get ? Events() : MethodNotAllowed("GET");
  if (path[3] == "log") return is_get ? Log() : MethodNotAllowed("GET");
  if (path[3] == "factor") {
    return ErrorResponse(409, "this is a replay: its speed is set by POST to .../replay");
  }
  if (path[3] == "curve") return is_get ? Curve(request.target) : MethodNotAllowed("GET");
  if (!Actions().contains(path[3])) return NoSuchAddress();
  return is_get ? MethodNotAllowed("POST") : Act(path[3], request.body);
}

Response ReplayApi::Act(const std::string& action, const std::string& body) {
  const base::Status done = Actions().at(action)(player_, body);
  if (!done) return ErrorResponse(done.error());
  return Status();
}

Response ReplayApi::Status() const {
  return JsonResponse(200, StatusJson(player_.status(), player_.clock()));
}

Response ReplayApi::Replay(const Request& request) {
  if (request.method == "POST") {
    const base::Result<ReplayChange> change = ParseReplayChange(request.body);
    if (!change) return ErrorResponse(change.error());
    if (change->speed) {
      if (const base::Status done = player_.SetSpeed(*change->speed); !done) {
        return ErrorResponse(done.error());
      }
    }
    if (change->loop) player_.SetLoop(*change->loop);
  } else if (request.method != "GET") {
    return MethodNotAllowed("GET, POST");
  }
  return JsonResponse(200, ReplayJson(player_.clock()));
}

Response ReplayApi::Topics(const std::string& robot) {
  const std::vector<std::string> topics = player_.ListTopicsOf(robot);
  if (!topics.empty()) return JsonResponse(200, TopicsJson(topics));
  return ErrorResponse(404, "no sensors of a robot '" + robot + "' are recorded");
}

Response ReplayApi::Events() const {
  OrderedJson list = OrderedJson::array();
  for (const RecordedEvent& event : player_.timeline().Events()) {
    list.push_back({{"time_s", base::ToSeconds(event.time)},
                    {"event", event.event},
                    {"robot", event.robot},
                    {"detail", event.detail}});
  }
  return JsonResponse(200, list.dump(-1, ' ', false, OrderedJson::error_handler_t::replace));
}

Response ReplayApi::Log() const {
  OrderedJson list = OrderedJson::array();
  for (const RecordedLine& line : player_.timeline().Log()) {
    list.push_back({{"time_s", base::ToSeconds(line.time)},
                    {"level", line.level},
                    {"name", line.name},
                    {"text", line.text}});
  }
  return JsonResponse(200, list.dump(-1, ' ', false, OrderedJson::error_handler_t::replace));
}

Response ReplayApi::Curve(const Target& target) const {
  const base::Result<curves::Curve> curve = player_.curves().Get(CurveWishOf(target));
  if (!curve) return ErrorResponse(curve.error());
  OrderedJson times = OrderedJson::array(), values = OrderedJson::array();
  for (const curves::Point& point : curve->points) {
    times.push_back(base::ToSeconds(point.time));
    values.push_back(point.value);  // what is not finite becomes null
  }
  const OrderedJson json{
      {"time_s", std::move(times)}, {"values", std::move(values)},
      {"samples", curve->samples},  {"is_whole", curve->is_whole},
      {"done", curve->is_done},     {"read_to_s", base::ToSeconds(curve->read_to)},
      {"problem", curve->problem}};
  return JsonResponse(200, json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace));
}

}  // namespace gsv::gateway
