#include "gsv/gateway/recordings/recordings_api.h"

#include <ctime>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace gsv::gateway::recordings {
namespace {

using RecordingsJson = nlohmann::ordered_json;

std::string Text(const RecordingsJson& json) {
  return json.dump(-1, ' ', false, RecordingsJson::error_handler_t::replace);
}

// The time by RFC 3339, to the second: "2026-01-31T23:59:59Z".
std::string DateText(std::chrono::system_clock::time_point time) {
  const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
  std::tm utc{};
  gmtime_r(&seconds, &utc);
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", utc.tm_year + 1900, utc.tm_mon + 1,
                     utc.tm_mday, utc.tm_hour, utc.tm_min, utc.tm_sec);
}

const char* NameOf(RecordingLine::State state) {
  switch (state) {
    case RecordingLine::State::kComplete:
      return "complete";
    case RecordingLine::State::kUnfinished:
      return "unfinished";
    case RecordingLine::State::kUnreadable:
      return "unreadable";
  }
  return "unreadable";
}

RecordingsJson LineJson(const RecordingLine& line) {
  RecordingsJson json{{"name", line.name},
                      {"size_bytes", line.size},
                      {"modified", DateText(line.modified)},
                      {"state", NameOf(line.state)},
                      {"problem", line.problem}};
  if (line.state == RecordingLine::State::kComplete) {
    json["start_s"] = base::ToSeconds(line.start);
    json["duration_s"] = base::ToSeconds(line.end - line.start);
    json["messages"] = line.messages;
    if (!line.world.empty()) json["world"] = line.world;
    if (line.robots) json["robots"] = *line.robots;
    if (!line.verdict.empty()) json["verdict"] = line.verdict;
    if (!line.sentence.empty()) json["sentence"] = line.sentence;
    if (line.violation_s) json["violation_s"] = *line.violation_s;
  }
  return json;
}

}  // namespace

std::vector<Route> RecordingsApi::Routes(drawing::ViewDrawer& drawer) {
  using enum Permission;
  using enum Pool;
  std::vector<Route> routes{
      {"GET", "/api/recordings", kWatch, false, kReaders, [this](const Request&) { return List(); },
       "List the recordings in the server's folder, newest first"},
      {"POST", "/api/recordings/{recording}/replay", kWatch, false, kCommanders,
       [this](const Request& request) { return Open(request.Parameter("recording")); },
       "Open a recording as your own replay"},
  };
  Append(routes, sessions_.Routes());
  Append(routes, drawing::ViewRoutes("/replays/{session}", drawer, [this](const Request& request) {
           return sessions_.FindViewed(request.Parameter("session"));
         }));
  return routes;
}

Response RecordingsApi::List() {
  const RecordingFolder::Listing listing = folder_.List();
  RecordingsJson lines = RecordingsJson::array();
  for (const RecordingLine& line : listing.lines) lines.push_back(LineJson(line));
  return JsonResponse(200, Text({{"folder", folder_.path().string()},
                                 {"left_out", listing.left_out},
                                 {"recordings", std::move(lines)}}));
}

Response RecordingsApi::Open(const std::string& name) {
  const base::Result<std::string> path = folder_.Find(name);
  if (!path) return ErrorResponse(path.error());
  const base::Result<std::string> session = sessions_.Open(*path, name);
  if (!session) return ErrorResponse(session.error());
  return JsonResponse(201, Text({{"recording", name}, {"base", "replays/" + *session + "/"}}));
}

}  // namespace gsv::gateway::recordings
