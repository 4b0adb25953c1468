#include "gsv/gateway/access/viewers_api.h"

#include <optional>

#include <nlohmann/json.hpp>

namespace gsv::gateway::access {
namespace {

using ViewersJson = nlohmann::ordered_json;
using Clock = std::chrono::steady_clock;

std::string Text(const ViewersJson& json) {
  return json.dump(-1, ' ', false, ViewersJson::error_handler_t::replace);
}

// A simulation's name is no longer than an address that it stands in.
constexpr std::size_t kLongestSimulation = 1024;

template <typename T>
std::optional<T> MemberOf(const std::string& body, const char* name) {
  const nlohmann::json json = nlohmann::json::parse(body, nullptr, false);
  if (!json.is_object() || !json.contains(name)) return std::nullopt;
  const nlohmann::json& member = json[name];
  const bool fits = std::is_same_v<T, bool> ? member.is_boolean() : member.is_string();
  return fits ? std::optional<T>(member.get<T>()) : std::nullopt;
}

Response Expected(const char* body) {
  return ErrorResponse(400, std::string("this address takes ") + body);
}

}  // namespace

Response ViewersApi::Handle(const Request& request) {
  const std::vector<std::string>& path = request.target.segments;
  if (path.size() == 2) {
    if (request.method == "GET") return Standing(request.viewer);
    return request.method == "POST" ? Enter(request) : MethodNotAllowed("GET, POST");
  }
  if (path[2] != "me" || path.size() > 4) {
    return ErrorResponse(404,
                         "there is nothing at this address; docs/api.yaml lists what there is");
  }
  return OfMe(request);
}

Response ViewersApi::Enter(const Request& request) {
  const auto name = MemberOf<std::string>(request.body, "name");
  const std::string simulation = MemberOf<std::string>(request.body, "simulation").value_or("");
  if (!name || simulation.size() > kLongestSimulation) {
    return Expected(R"({"name": text, "simulation": its name})");
  }
  const auto admission = desk_.Enter(*name, simulation, Clock::now());
  if (!admission) return ErrorResponse(admission.error());
  return JsonResponse(201, Text({{"number", admission->number}, {"key", admission->key}}));
}

base::Status ViewersApi::Change(const Request& request) {
  const auto name = MemberOf<std::string>(request.body, "name");
  const auto simulation = MemberOf<std::string>(request.body, "simulation");
  if ((!name && !simulation) || (simulation && simulation->size() > kLongestSimulation)) {
    return base::Fail(
        base::ErrorCode::kInvalidArgument,
        R"(this address takes {"name": text, "simulation": its name}, or one of both)");
  }
  const auto now = Clock::now();
  if (name) {
    if (base::Status done = desk_.Rename(request.viewer, *name, now); !done) return done;
  }
  return simulation ? desk_.Turn(request.viewer, *simulation, now) : base::Status();
}

Response ViewersApi::OfMe(const Request& request) {
  const std::vector<std::string>& path = request.target.segments;
  const std::string what = path.size() == 4 ? path[3] : "";
  const auto now = Clock::now();
  base::Status done;
  if (request.method == "DELETE" && what.empty()) {
    done = desk_.Leave(request.viewer, now);
  } else if (request.method != "POST") {
    return MethodNotAllowed(what.empty() ? "POST, DELETE" : "POST");
  } else if (what.empty()) {
    done = Change(request);
  } else if (what == "control") {
    const auto wants = MemberOf<bool>(request.body, "wants");
    if (!wants) return Expected(R"({"wants": true or false})");
    done = *wants ? desk_.Ask(request.viewer, now) : desk_.Release(request.viewer, now);
  } else if (what == "answer") {
    const auto grants = MemberOf<bool>(request.body, "grants");
    if (!grants) return Expected(R"({"grants": true or false})");
    done = desk_.Answer(request.viewer, *grants, now);
  } else {
    return ErrorResponse(404, "there is nothing at this address");
  }
  return done ? Standing(request.viewer) : ErrorResponse(done.error());
}

Response ViewersApi::Standing(const std::string& viewer) {
  return JsonResponse(200, StandingJson(desk_.See(viewer, Clock::now())));
}

std::string StandingJson(const ControlDesk::Standing& standing) {
  ViewersJson viewers = ViewersJson::array();
  for (const ControlDesk::Person& person : standing.viewers) {
    viewers.push_back({{"number", person.number},
                       {"name", person.name},
                       {"simulation", person.simulation},
                       {"holds_control", person.holds},
                       {"asks", person.asks},
                       {"passes_in_s", static_cast<double>(person.left.count()) / 1000}});
  }
  return Text({{"viewers", std::move(viewers)}, {"you", standing.you}});
}

}  // namespace gsv::gateway::access
