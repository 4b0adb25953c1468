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

// Maximum length of a simulation's name in bytes. The name is a part of URLs, and the length of a
// URL is limited.
constexpr std::size_t kMaxSimulationNameLength = 1024;

template <typename T>
std::optional<T> MemberOf(const std::string& body, const char* name) {
  const nlohmann::json json = nlohmann::json::parse(body, nullptr, false);
  if (!json.is_object() || !json.contains(name)) return std::nullopt;
  const nlohmann::json& member = json[name];
  const bool fits = std::is_same_v<T, bool> ? member.is_boolean() : member.is_string();
  return fits ? std::optional<T>(member.get<T>()) : std::nullopt;
}

base::Error Expected(const std::string& body) {
  return {base::ErrorCode::kInvalidArgument, "the body of this request must be " + body};
}

}  // namespace

std::vector<Route> ViewersApi::Routes() {
  using enum Permission;
  using enum Pool;
  // Changes the viewer that sends the request, and returns its new state.
  const auto changing = [this](base::Status (ViewersApi::*change)(const Request&)) {
    return [this, change](const Request& request) {
      const base::Status done = (this->*change)(request);
      return done ? ViewerList(request.viewer) : ErrorResponse(done.error());
    };
  };
  return {
      {"GET", "/api/viewers", kWatch, false, kReaders,
       [this](const Request& request) { return ViewerList(request.viewer); },
       "List the viewers, and show which one has control and which one asks for it"},
      {"POST", "/api/viewers", kWatch, false, kReaders,
       [this](const Request& request) { return Enter(request); },
       "Register as a viewer, with a name"},
      {"POST", "/api/viewers/me", kWatch, false, kReaders, changing(&ViewersApi::Change),
       "Change the name, or open another simulation (this releases control)"},
      {"DELETE", "/api/viewers/me", kWatch, false, kReaders, changing(&ViewersApi::Leave),
       "Leave as a viewer, and release control"},
      {"POST", "/api/viewers/me/control", kControl, false, kReaders,
       changing(&ViewersApi::SetControlRequest),
       "Ask for control of the open simulation, release it, or cancel the request"},
      {"POST", "/api/viewers/me/answer", kControl, false, kReaders,
       changing(&ViewersApi::AnswerFirst), "Answer the first viewer that asks for control"},
  };
}

Response ViewersApi::Enter(const Request& request) {
  const auto name = MemberOf<std::string>(request.body, "name");
  const std::string simulation = MemberOf<std::string>(request.body, "simulation").value_or("");
  if (!name || simulation.size() > kMaxSimulationNameLength) {
    return ErrorResponse(Expected(R"({"name": text, "simulation": its name})"));
  }
  const auto admission = registry_.Enter(*name, simulation, Clock::now());
  if (!admission) return ErrorResponse(admission.error());
  return JsonResponse(201, Text({{"number", admission->number}, {"key", admission->key}}));
}

base::Status ViewersApi::Change(const Request& request) {
  const auto name = MemberOf<std::string>(request.body, "name");
  const auto simulation = MemberOf<std::string>(request.body, "simulation");
  if ((!name && !simulation) || (simulation && simulation->size() > kMaxSimulationNameLength)) {
    return base::Fail(
        Expected(R"({"name": TEXT, "simulation": NAME}; one of the two may be missing)"));
  }
  const auto now = Clock::now();
  if (name) {
    if (base::Status done = registry_.Rename(request.viewer, *name, now); !done) return done;
  }
  return simulation ? registry_.SelectSimulation(request.viewer, *simulation, now) : base::Status();
}

base::Status ViewersApi::Leave(const Request& request) {
  return registry_.Leave(request.viewer, Clock::now());
}

base::Status ViewersApi::SetControlRequest(const Request& request) {
  const auto wants = MemberOf<bool>(request.body, "wants");
  if (!wants) return base::Fail(Expected(R"({"wants": true or false})"));
  return *wants ? registry_.RequestControl(request.viewer, Clock::now())
                : registry_.Release(request.viewer, Clock::now());
}

base::Status ViewersApi::AnswerFirst(const Request& request) {
  const auto grants = MemberOf<bool>(request.body, "grants");
  if (!grants) return base::Fail(Expected(R"({"grants": true or false})"));
  return registry_.Answer(request.viewer, *grants, Clock::now());
}

Response ViewersApi::ViewerList(const std::string& viewer) {
  return JsonResponse(200, ViewerListJson(registry_.List(viewer, Clock::now())));
}

std::string ViewerListJson(const ViewerRegistry::ViewerList& standing) {
  ViewersJson viewers = ViewersJson::array();
  for (const ViewerRegistry::ViewerState& person : standing.viewers) {
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
