#include "gsv/gateway/recordings/recordings_api.h"

#include <charconv>
#include <ctime>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "gsv/gateway/recordings/note_file.h"
#include "gsv/gateway/recordings/note_request.h"
#include "gsv/recording/recording_difference.h"

namespace gsv::gateway::recordings {
namespace {

using RecordingsJson = nlohmann::ordered_json;

std::string Text(const RecordingsJson& json) {
  return json.dump(-1, ' ', false, RecordingsJson::error_handler_t::replace);
}

// Returns the time by RFC 3339, to the second: "2026-01-31T23:59:59Z".
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

std::string NotesJson(const std::vector<Note>& notes) {
  RecordingsJson list = RecordingsJson::array();
  for (const Note& note : notes) {
    list.push_back(
        {{"id", note.id}, {"time_s", note.time_s}, {"text", note.text}, {"created", note.created}});
  }
  return Text(list);
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
      {"GET", "/api/recordings/{recording}/difference", kWatch, false, kCommanders,
       [this](const Request& request) {
         return Difference(request.Parameter("recording"), request);
       },
       "Get where two recordings first differ"},
      {"GET", "/api/recordings/{recording}/notes", kWatch, false, kReaders,
       [this](const Request& request) {
         return OfNotes(request.Parameter("recording"), [](const NoteFile& file) {
           const auto notes = file.Read();
           return notes ? JsonResponse(200, NotesJson(*notes)) : ErrorResponse(notes.error());
         });
       },
       "List the notes of a recording"},
      {"POST", "/api/recordings/{recording}/notes", kControl, false, kCommanders,
       [this](const Request& request) {
         return AddNote(request.Parameter("recording"), request.body);
       },
       "Add a note to an instant of a recording"},
      {"DELETE", "/api/recordings/{recording}/notes/{note}", kControl, false, kCommanders,
       [this](const Request& request) {
         return RemoveNote(request.Parameter("recording"), request.Parameter("note"));
       },
       "Remove a note of a recording"},
  };
  Append(routes, sessions_.Routes(drawer));
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

Response RecordingsApi::Difference(const std::string& name, const Request& request) {
  const auto with = request.target.query.find("with");
  if (with == request.target.query.end()) {
    return ErrorResponse(400, "the query must name the second recording: ?with=NAME");
  }
  std::vector<std::unique_ptr<recording::McapReader>> readers;
  for (const std::string& each : {name, with->second}) {
    const base::Result<std::string> path = folder_.Find(each);
    if (!path) return ErrorResponse(path.error());
    auto reader = recording::McapReader::Open(*path);
    if (!reader) return ErrorResponse(reader.error());
    readers.push_back(*std::move(reader));
  }
  const auto difference = recording::CompareRecordings(*readers[0], *readers[1]);
  if (!difference) return ErrorResponse(difference.error());
  RecordingsJson json = difference->Json();
  json["text"] = difference->Text();
  return JsonResponse(200, Text(json));
}

template <typename Use>
Response RecordingsApi::OfNotes(const std::string& name, Use use) {
  const base::Result<std::string> path = folder_.Find(name);
  if (!path) return ErrorResponse(path.error());
  const base::MutexLock lock(notes_mutex_);
  return use(NoteFile(*path));
}

Response RecordingsApi::AddNote(const std::string& name, const std::string& body) {
  const auto note = ParseNoteRequest(body);
  if (!note) return ErrorResponse(note.error());
  if (!note->time_s) {
    return ErrorResponse(400,
                         "a note of a recording needs its time: \"time_s\", in simulated seconds");
  }
  return OfNotes(name, [&](const NoteFile& file) {
    const auto id = file.Add(*note->time_s, note->text, DateText(std::chrono::system_clock::now()));
    if (!id) return ErrorResponse(id.error());
    return JsonResponse(201, Text({{"id", *id}}));
  });
}

Response RecordingsApi::RemoveNote(const std::string& name, const std::string& id) {
  std::int64_t number = 0;
  const auto parsed = std::from_chars(id.data(), id.data() + id.size(), number);
  if (parsed.ec != std::errc() || parsed.ptr != id.data() + id.size()) number = 0;
  return OfNotes(name, [&](const NoteFile& file) {
    const base::Status removed = file.Remove(number);
    return removed ? JsonResponse(200, "{}") : ErrorResponse(removed.error());
  });
}

Response RecordingsApi::Open(const std::string& name) {
  const base::Result<std::string> path = folder_.Find(name);
  if (!path) return ErrorResponse(path.error());
  const base::Result<std::string> session = sessions_.Open(*path, name);
  if (!session) return ErrorResponse(session.error());
  return JsonResponse(201, Text({{"recording", name}, {"base", "replays/" + *session + "/"}}));
}

}  // namespace gsv::gateway::recordings
