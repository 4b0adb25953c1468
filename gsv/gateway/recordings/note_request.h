// Parses requests to add a note to an instant of a run or of a recording.
//
// Input  untrusted.
#pragma once

#include <optional>
#include <string>

#include "gsv/base/error.h"

namespace gsv::gateway::recordings {

// Maximum length of a note's text in bytes.
inline constexpr std::size_t kMaxNoteLength = 1000;

// A request for a note, from the body {"text": TEXT, "time_s": T, "author": NAME}.
struct NoteRequest {
  std::string text;              // the text; with an author, it is "NAME: TEXT"
  std::optional<double> time_s;  // nullopt: the present time
};
// Parses the body of a request to add a note.
base::Result<NoteRequest> ParseNoteRequest(const std::string& body);

}  // namespace gsv::gateway::recordings
