// A NoteFile stores the notes of a recording in a file beside it: RECORDING.mcap.notes.json
// (docs/formats/notes.md).
//
// Input   an untrusted file.
// Errors  kCorrupt if the file is not valid, kUnavailable if it cannot be written.
// Threads any; calls for one file must not overlap.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::gateway::recordings {

// Maximum number of notes of a recording.
inline constexpr std::size_t kMaxNotes = 1000;

// A note of a viewer on an instant of a recording.
struct Note {
  std::int64_t id = 0;  // positive, unique in the file
  double time_s = 0;    // simulated time
  std::string text;
  std::string created;  // time of creation by RFC 3339, in UTC
};

// The file with the notes of a recording.
class NoteFile {
 public:
  // `recording` is the path of the MCAP file.
  explicit NoteFile(const std::string& recording) : path_(recording + ".notes.json") {}

  // Returns the notes ordered by time; empty if there is no file.
  base::Result<std::vector<Note>> Read() const;
  // Adds a note and returns its identifier. kInvalidArgument: there are kMaxNotes already, or the
  // file would have more than 4 MiB.
  base::Result<std::int64_t> Add(double time_s, const std::string& text,
                                 const std::string& created) const;
  // Removes a note. kNotFound: there is no note with this identifier.
  base::Status Remove(std::int64_t id) const;

 private:
  // Replaces the content of the file. kInvalidArgument: it would have more than 4 MiB.
  base::Status Write(const std::vector<Note>& notes) const;

  const std::string path_;
};

}  // namespace gsv::gateway::recordings
