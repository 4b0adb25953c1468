#include "gsv/gateway/recordings/note_request.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace gsv::gateway::recordings {
namespace {

constexpr std::size_t kMaxAuthorLength = 100;

}  // namespace

base::Result<NoteRequest> ParseNoteRequest(const std::string& body) {
  const nlohmann::json json = nlohmann::json::parse(body, nullptr, false);
  const auto text = [&](const char* name) {
    const bool has = json.is_object() && json.contains(name) && json[name].is_string();
    return has ? json[name].get<std::string>() : std::string();
  };
  NoteRequest note{text("text"), std::nullopt};
  const std::string author = text("author");
  const bool has_time = json.is_object() && json.contains("time_s");
  const double time = has_time && json["time_s"].is_number() ? json["time_s"].get<double>() : -1;
  const bool is_valid = !note.text.empty() && note.text.size() <= kMaxNoteLength &&
                        author.size() <= kMaxAuthorLength &&
                        (!has_time || (time >= 0 && time < 9e9));
  if (!is_valid) {
    return base::Fail(
        base::ErrorCode::kInvalidArgument,
        "the body of the request must be {\"text\": 1 to 1000 bytes, \"time_s\": "
        "simulated seconds, \"author\": at most 100 bytes}; only the text is required");
  }
  std::replace_if(
      note.text.begin(), note.text.end(), [](unsigned char c) { return c < ' '; }, ' ');
  if (!author.empty()) note.text = author + ": " + note.text;
  if (has_time) note.time_s = time;
  return note;
}

}  // namespace gsv::gateway::recordings
