#include "gsv/gateway/api/replay_api.h"

#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

#include <nlohmann/json.hpp>

#include "gsv/gateway/api/answers.h"
#include "gsv/gateway/api/command_json.h"
#include "gsv/gateway/api/status_json.h"
#include "gsv/simulation/commands/command_table.h"

namespace gsv::gateway {
namespace {

using OrderedJson = nlohmann::ordered_json;

constexpr std::size_t kDefaultCurvePoints = 4000;
constexpr double kMaxTime = 9e9;  // limit of a time that is converted to nanoseconds, s

std::string JsonText(const OrderedJson& json) {
  return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

// Steps the replay. The body is {"poses": N} for N recorded poses, or {"count": N} for N steps of
// the simulation.
base::Status StepBy(ReplayPlayer& player, const std::string& body) {
  const nlohmann::json json = nlohmann::json::parse(body, nullptr, false);
  if (json.is_object() && json.contains("poses")) {
    const nlohmann::json& poses = json["poses"];
    const bool is_huge = poses.is_number_unsigned() &&
                         poses.get<std::uint64_t>() > std::numeric_limits<std::int64_t>::max();
    return player.StepPoses(poses.is_number_integer() && !is_huge ? poses.get<std::int64_t>() : 0);
  }
  const auto arguments = ParseArguments(*simulation::FindCommand("step"), body);
  if (!arguments) return base::Fail(arguments.error());
  return player.Step(arguments->Get<std::int64_t>("count"));
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

struct ReplayCommand {
  std::string_view name;
  std::string_view summary;
  base::Status (*apply)(ReplayPlayer& player, const std::string& body);
};
constexpr ReplayCommand kReplayCommands[]{
    {"start", "Start a simulation",
     [](ReplayPlayer& player, const std::string&) { return player.Start(); }},
    {"pause", "Pause a simulation",
     [](ReplayPlayer& player, const std::string&) { return player.Pause(); }},
    {"resume", "Resume a paused simulation",
     [](ReplayPlayer& player, const std::string&) { return player.Resume(); }},
    {"stop", "Stop a simulation; then only a reset is possible", &Rewind},
    {"reset", "Reset a simulation to its start", &Rewind},
    {"step", "Take some steps, then pause", &StepBy},
    {"seek", "Go to a time of the recording (replays only)", &SeekTo},
};

Response JsonOr(const base::Result<SharedBytes>& json) {
  if (!json) return ErrorResponse(json.error());
  Response response;
  response.content_type = "application/json";
  response.body = *json;
  return response;
}

curves::CurveRequest CurveRequestOf(const Target& target) {
  curves::CurveRequest request{.max_points = kDefaultCurvePoints};
  for (const auto& [name, value] : target.query) {
    if (name == "topic") request.topic = value;
    if (name == "robot") request.robot = value;
    if (name == "key") request.key = value;
    if (name != "most") continue;
    const auto parsed =
        std::from_chars(value.data(), value.data() + value.size(), request.max_points);
    const bool is_number = parsed.ec == std::errc() && parsed.ptr == value.data() + value.size();
    // 0 is out of range, so the request is refused later.
    if (!is_number) request.max_points = 0;
  }
  return request;
}

Response StatusOf(const Replay& replay, const Request&) {
  return JsonResponse(200, StatusJson(replay.player->status(), replay.player->clock()));
}

Response ServerOf(const Replay& replay, const Request&) {
  return JsonResponse(200, JsonText({{"creates", false},
                                     {"records", false},
                                     {"recordings", !replay.recording.empty()},
                                     {"recording", replay.recording}}));
}

Response ListOf(const Replay& replay, const Request&) {
  return JsonResponse(200, SimulationListJson({replay.player->status()}));
}

Response ModelOf(const Replay& replay, const Request& request) {
  const std::string& id = request.Parameter("id");
  return ModelAnswer(request, id, replay.player->scene().Model(id));
}

Response SceneOf(const Replay& replay, const Request&) { return JsonOr(replay.player->SceneNow()); }

Response PlaybackOf(const Replay& replay, const Request&) {
  return JsonResponse(200, ReplayJson(replay.player->clock()));
}

Response ChangePlayback(const Replay& replay, const Request& request) {
  const base::Result<ReplayChange> change = ParseReplayChange(request.body);
  if (!change) return ErrorResponse(change.error());
  if (change->speed) {
    if (const base::Status done = replay.player->SetSpeed(*change->speed); !done) {
      return ErrorResponse(done.error());
    }
  }
  if (change->loop) replay.player->SetLoop(*change->loop);
  return PlaybackOf(replay, request);
}

Response TopicsOf(const Replay& replay, const Request& request) {
  const std::string& robot = request.Parameter("robot");
  const std::vector<std::string> topics = replay.player->ListTopicsOf(robot);
  if (!topics.empty()) return JsonResponse(200, TopicsJson(topics));
  return ErrorResponse(404, "the recording has no sensors of a robot '" + robot + "'");
}

Response EventsOf(const Replay& replay, const Request&) {
  OrderedJson list = OrderedJson::array();
  for (const RecordedEvent& event : replay.player->timeline().Events()) {
    list.push_back({{"time_s", base::ToSeconds(event.time)},
                    {"event", event.event},
                    {"robot", event.robot},
                    {"detail", event.detail}});
  }
  return JsonResponse(200, JsonText(list));
}

Response LogOf(const Replay& replay, const Request&) {
  OrderedJson list = OrderedJson::array();
  for (const RecordedLine& line : replay.player->timeline().Log()) {
    list.push_back({{"time_s", base::ToSeconds(line.time)},
                    {"level", line.level},
                    {"name", line.name},
                    {"text", line.text}});
  }
  return JsonResponse(200, JsonText(list));
}

Response CurveOf(const Replay& replay, const Request& request) {
  const base::Result<curves::Curve> curve =
      replay.player->curves().Get(CurveRequestOf(request.target));
  if (!curve) return ErrorResponse(curve.error());
  OrderedJson times = OrderedJson::array(), values = OrderedJson::array();
  for (const curves::Point& point : curve->points) {
    times.push_back(base::ToSeconds(point.time));
    values.push_back(point.value);  // non-finite values become null
  }
  return JsonResponse(200, JsonText({{"time_s", std::move(times)},
                                     {"values", std::move(values)},
                                     {"samples", curve->samples},
                                     {"is_whole", curve->is_whole},
                                     {"done", curve->is_done},
                                     {"read_to_s", base::ToSeconds(curve->read_to)},
                                     {"problem", curve->problem}}));
}

Response RefuseFactor(const Replay&, const Request&) {
  return ErrorResponse(409,
                       "a replay has no real-time factor; set its speed with POST to .../replay");
}

Response RefuseEdit(const Replay&, const Request&) {
  return ErrorResponse(409, "a replay cannot be edited");
}

using ReplayHandler = std::function<Response(const Replay&, const Request&)>;

// Returns a handler that finds the replay of the request and calls `handler` with it. It responds
// with 404 if the path has a parameter {name} that is not the name of the recorded simulation.
Route::Handler OfReplay(const FindReplay& find, ReplayHandler handler) {
  return [find, handler = std::move(handler)](const Request& request) {
    const base::Result<Replay> replay = find(request);
    if (!replay) return ErrorResponse(replay.error());
    const std::string& recorded = replay->player->name();
    const auto name = request.parameters.find("name");
    if (name == request.parameters.end() || name->second == recorded) {
      return handler(*replay, request);
    }
    return ErrorResponse(404, "there is no simulation '" + name->second +
                                  "'; this is a replay of '" + recorded + "'");
  };
}

// A request that simulations accept and a replay refuses.
struct RefusedRequest {
  const char* method;
  const char* below;  // the path after /api/simulations/{name}
  Response (*refuse)(const Replay&, const Request&);
};
constexpr RefusedRequest kRefused[]{
    {"POST", "/real_time_factor", &RefuseFactor},
    {"POST", "/factor", &RefuseFactor},
    {"POST", "/set_gravity", &RefuseEdit},
    {"POST", "/robots", &RefuseEdit},
    {"POST", "/objects", &RefuseEdit},
    {"DELETE", "/robots/{robot}", &RefuseEdit},
    {"POST", "/robots/{robot}/drive", &RefuseEdit},
    {"DELETE", "/objects/{object}", &RefuseEdit},
    {"POST", "/bodies/{body}/place", &RefuseEdit},
    {"POST", "/bodies/{body}/joints/{joint}", &RefuseEdit},
};

}  // namespace

std::vector<Route> ReplayRoutes(const FindReplay& find) {
  using Reading = Response (*)(const Replay&, const Request&);
  const std::string simulation = "/api/simulations/{name}";
  std::vector<Route> routes;
  const auto read = [&](std::string pattern, Reading handler, std::string summary) {
    routes.push_back({"GET", std::move(pattern), Permission::kWatch, false, Pool::kReaders,
                      OfReplay(find, handler), std::move(summary)});
  };
  // These requests change a replay. They run on the threads for readers, because none takes long.
  const auto change = [&](std::string method, std::string_view below, ReplayHandler handler,
                          std::string_view summary) {
    routes.push_back({std::move(method), simulation + std::string(below), Permission::kControl,
                      true, Pool::kReaders, OfReplay(find, std::move(handler)),
                      std::string(summary)});
  };
  read("/api/server", &ServerOf, "List the capabilities of the server");
  read("/api/simulations", &ListOf, "List the simulations");
  read("/api/models/{id}.glb", &ModelOf, "Get a model as glTF");
  read(simulation, &StatusOf, "Get the status of a simulation");
  read(simulation + "/scene", &SceneOf,
       "Get the scene of a simulation, with bodies and their appearance");
  read(simulation + "/robots/{robot}/topics", &TopicsOf, "List the topics of a robot's sensors");
  read(simulation + "/replay", &PlaybackOf,
       "Get the time, speed and state of a replay (replays only)");
  read(simulation + "/events", &EventsOf, "List the events of a simulation or of a recording");
  read(simulation + "/log", &LogOf, "List the log messages of a recording, /rosout (replays only)");
  read(simulation + "/curve", &CurveOf, "Get a value over the whole recording (replays only)");
  change("POST", "/replay", &ChangePlayback,
         "Set the speed and the loop of a replay (replays only)");
  for (const ReplayCommand& command : kReplayCommands) {
    const auto handler = [apply = command.apply](const Replay& replay, const Request& request) {
      const base::Status done = apply(*replay.player, request.body);
      return done ? StatusOf(replay, request) : ErrorResponse(done.error());
    };
    change("POST", "/" + std::string(command.name), handler, command.summary);
  }
  for (const auto& [method, below, handler] : kRefused) {
    change(method, below, handler, "Always refused, because a replay cannot be changed");
  }
  return routes;
}

base::Result<ReplayChange> ParseReplayChange(std::string_view body) {
  const nlohmann::json json = nlohmann::json::parse(body, nullptr, false);
  const auto fail = [] {
    return base::Fail(
        base::ErrorCode::kInvalidArgument,
        "the body of the request must be {\"speed\": NUMBER, \"loop\": true or false}");
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
  if (!(std::abs(seconds) < kMaxTime)) {
    return base::Fail(
        base::ErrorCode::kInvalidArgument,
        "the body of the request must be {\"time_s\": T}, in simulated seconds since the start");
  }
  return base::FromSeconds(seconds);
}

}  // namespace gsv::gateway
