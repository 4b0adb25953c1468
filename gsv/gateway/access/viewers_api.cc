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
  if (!name) return Expected(R"({"name": text})");
  const auto admission = desk_.Enter(*name, Clock::now());
  if (!admission) return ErrorResponse(admission.error());
  return JsonResponse(201, Text({{"number", admission->number}, {"key", admission->key}}));
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
    const auto name = MemberOf<std::string>(request.body, "name");
    if (!name) return Expected(R"({"name": text})");
    done = desk_.Rename(request.viewer, *name, now);
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
  const ControlDesk::Standing standing = desk_.See(viewer, Clock::now());
  ViewersJson viewers = ViewersJson::array();
  for (const ControlDesk::Person& person : standing.viewers) {
    viewers.push_back({{"number", person.number}, {"name", person.name}});
  }
  return JsonResponse(200,
                      Text({{"viewers", std::move(viewers)},
                            {"you", standing.you},
                            {"holder", standing.holder},
                            {"asking", standing.asking},
                            {"passes_in_s", static_cast<double>(standing.left.count()) / 1000}}));
}

}  // namespace gsv::gateway::access
