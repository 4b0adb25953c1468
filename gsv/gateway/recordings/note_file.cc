#include "gsv/gateway/recordings/note_file.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <optional>
#include <sstream>

#include <nlohmann/json.hpp>

#include "gsv/base/sorting.h"

namespace gsv::gateway::recordings {
namespace {

namespace fs = std::filesystem;

constexpr int kVersion = 1;
constexpr std::uintmax_t kMaxFileSize = 4 << 20;
constexpr std::size_t kMaxTextLength = 4096;

std::optional<Note> NoteOf(const nlohmann::json& json) {
  if (!json.is_object()) return std::nullopt;
  const auto text = [&](const char* name) {
    return json.contains(name) && json[name].is_string() ? json[name].get<std::string>() : "";
  };
  const bool is_valid = json.contains("id") && json["id"].is_number_integer() &&
                        json.contains("time_s") && json["time_s"].is_number();
  if (!is_valid) return std::nullopt;
  Note note{json["id"].get<std::int64_t>(), json["time_s"].get<double>(), text("text"),
            text("created")};
  if (note.id <= 0 || !std::isfinite(note.time_s) || note.text.size() > kMaxTextLength) {
    return std::nullopt;
  }
  return note;
}

std::string ErrorOfSystem() { return std::strerror(errno); }

}  // namespace

base::Result<std::vector<Note>> NoteFile::Read() const {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(path_, error);
  if (!fs::exists(status)) return std::vector<Note>();
  const auto fail = [&](const std::string& why) {
    return base::Fail(base::ErrorCode::kCorrupt,
                      "the notes cannot be read: " + why + ". Correct the file or remove it",
                      path_);
  };
  if (!fs::is_regular_file(status)) return fail("it is not a file");
  if (fs::file_size(path_, error) > kMaxFileSize || error) return fail("it has more than 4 MiB");
  std::ifstream file(path_);
  std::stringstream text;
  text << file.rdbuf();
  const nlohmann::json json = nlohmann::json::parse(text.str(), nullptr, false);
  if (!json.is_object() || !json.contains("version") || !json.contains("notes") ||
      !json["notes"].is_array()) {
    return fail("it is not a JSON object with version and notes");
  }
  if (json["version"] != kVersion) return fail("its version is not 1");
  std::vector<Note> notes;
  for (const nlohmann::json& each : json["notes"]) {
    if (notes.size() == kMaxNotes) {
      return fail("it has more than " + std::to_string(kMaxNotes) + " notes");
    }
    const std::optional<Note> note = NoteOf(each);
    if (!note) {
      return fail("note " + std::to_string(notes.size() + 1) +
                  " needs 'id' (an integer above 0), 'time_s' (a number), and 'text' (at most " +
                  std::to_string(kMaxTextLength) + " bytes)");
    }
    notes.push_back(*note);
  }
  base::Sort(notes, [](const Note& a, const Note& b) { return a.time_s < b.time_s; });
  return notes;
}

base::Result<std::int64_t> NoteFile::Add(double time_s, const std::string& text,
                                         const std::string& created) const {
  auto notes = Read();
  if (!notes) return base::Fail(notes.error());
  if (notes->size() == kMaxNotes) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "a recording can have at most 1,000 notes; remove some");
  }
  std::int64_t id = 1;
  for (const Note& note : *notes) id = std::max(id, note.id + 1);
  notes->push_back({id, time_s, text, created});
  if (base::Status written = Write(*notes); !written) return base::Fail(written.error());
  return id;
}

base::Status NoteFile::Remove(std::int64_t id) const {
  auto notes = Read();
  if (!notes) return base::Fail(notes.error());
  const auto removed = std::erase_if(*notes, [id](const Note& note) { return note.id == id; });
  if (removed == 0) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "there is no note " + std::to_string(id) + "; it was removed already");
  }
  return Write(*notes);
}

// Writes a new file, and then replaces the old file by the new file. So if the program crashes in
// the meantime, one complete version of the notes remains: the old or the new one.
base::Status NoteFile::Write(const std::vector<Note>& notes) const {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const Note& note : notes) {
    list.push_back(
        {{"id", note.id}, {"time_s", note.time_s}, {"text", note.text}, {"created", note.created}});
  }
  const nlohmann::ordered_json json{{"version", kVersion}, {"notes", std::move(list)}};
  const std::string text =
      json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
  if (text.size() > kMaxFileSize) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the file with the notes of a recording can have at most 4 MiB; shorten or "
                      "remove some notes",
                      path_);
  }
  const std::string temporary = path_ + ".new";
  {
    std::ofstream file(temporary, std::ios::trunc);
    file << text;
    file.close();
    if (!file) {
      return base::Fail(base::ErrorCode::kUnavailable, "cannot write the notes: " + ErrorOfSystem(),
                        temporary);
    }
  }
  std::error_code error;
  fs::rename(temporary, path_, error);
  if (!error) return {};
  return base::Fail(base::ErrorCode::kUnavailable, "cannot write the notes: " + error.message(),
                    path_);
}

}  // namespace gsv::gateway::recordings
