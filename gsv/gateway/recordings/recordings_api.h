// RecordingsApi is the part of the HTTP API that lists and compares recordings, opens replays, and
// stores notes.
//
// Threads  any.
#pragma once

#include <vector>

#include "gsv/gateway/http/route.h"
#include "gsv/gateway/recordings/recording_folder.h"
#include "gsv/gateway/recordings/replay_sessions.h"

namespace gsv::gateway::recordings {

// The part of the HTTP API about recordings.
class RecordingsApi {
 public:
  explicit RecordingsApi(std::filesystem::path folder, std::string only = {},
                         const SessionLimits& limits = {})
      : folder_(std::move(folder), std::move(only)), sessions_(limits) {}

  // Returns the routes about recordings and those of the open replays. `drawer` draws the images of
  // the replays. The handlers are valid during the lifetime of this object and of the drawer.
  std::vector<Route> Routes(drawing::ViewDrawer& drawer);

  ReplaySessions& sessions() { return sessions_; }
  const RecordingFolder& folder() const { return folder_; }

 private:
  // Responds with the list of recordings.
  Response List();
  // Opens a replay of a recording.
  Response Open(const std::string& name);
  // Responds with the first difference from another recording.
  Response Difference(const std::string& name, const Request& request);
  // Opens the file with the notes of the recording `name`, and returns the response that `use`
  // makes from it. `use` is a function with a parameter of type NoteFile.
  template <typename Use>
  Response OfNotes(const std::string& name, Use use);
  // Adds a note to a recording.
  Response AddNote(const std::string& name, const std::string& body);
  // Removes a note from a recording.
  Response RemoveNote(const std::string& name, const std::string& id);

  RecordingFolder folder_;
  ReplaySessions sessions_;
  base::Mutex notes_mutex_;  // held while a file of notes is read or written
};

}  // namespace gsv::gateway::recordings
