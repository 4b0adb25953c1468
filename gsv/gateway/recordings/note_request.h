// Requests for notes on an instant of a run or of a recording.
//
// Input  untrusted.
#pragma once

#include <optional>
#include <string>

#include "gsv/base/error.h"

namespace gsv::gateway::recordings {

// Limit of the text of a note, in bytes.
inline constexpr std::size_t kMaxNoteLength = 1000;

// The body of a request for a note: {"text": TEXT, "time_s": T, "author": NAME}.
struct NoteRequest {
  std::string text;              // with the author, if there is one: "NAME: TEXT"
  std::optional<double> time_s;  // nothing: now
};
base::Result<NoteRequest> ParseNoteRequest(const std::string& body);

}  // namespace gsv::gateway::recordings
