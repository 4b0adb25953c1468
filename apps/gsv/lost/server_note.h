// A server's note: a small file that lists the server's simulations. After the server was killed, a
// later server reads the note and reports these simulations as lost. The file is in
// $XDG_STATE_HOME/gsv/servers (default of XDG_STATE_HOME: ~/.local/state). The server removes it at
// a regular end.
//
// Input    untrusted: a power failure, or another user, may have damaged a note.
// Threads  any.
#pragma once

#include <sys/types.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "gsv/base/error.h"

namespace gsv::app {

// A simulation that was running when its server was killed.
struct LostSimulation {
  std::string name, world, phase;  // `phase`: the phase at the last update
  double time_s = 0;               // simulated time at the last update
  std::int64_t noted = 0;          // time of the last update, s since 1970
  std::string recording;           // a file or folder; empty if it was not recorded
  // the time of the recording's last readable message; set after the file was read
  std::optional<double> whole_until_s;
  std::string server;  // the server that ran it, such as "gsv (process 123)"
};

// Returns a sentence such as "arena on gsv (process 123) was lost at about 12.3 s (running), when
// its server was killed; it was not recorded".
std::string Sentence(const LostSimulation& lost);
// Returns {name, world, phase: "lost", last_phase, time_s, noted, server, recording,
// whole_until_s?, sentence}.
nlohmann::ordered_json Describe(const LostSimulation& lost);

// The content of a server's note.
struct ServerNote {
  pid_t pid = 0;
  // start of the process, in clock ticks since the machine was booted; with `boot` it detects a
  // reused pid
  std::uint64_t started = 0;
  std::string boot, host;                   // id of the machine's boot; host name
  std::string server;                       // the name of the server
  std::string broker;                       // the reference of the server's broker
  std::string recordings;                   // the server's folder of recordings
  std::vector<LostSimulation> simulations;  // the simulations that the server runs
  std::vector<LostSimulation> lost;         // lost simulations of earlier servers
};

// Returns the note of this process.
ServerNote NewNote();
// Whether the process that wrote the note still runs. A process of another host counts as running.
bool IsProcessRunning(const ServerNote& note);

// Returns the folder of the notes, and creates it if it does not exist.
base::Result<std::filesystem::path> NotesFolder();
// Returns the path of this process's note.
std::filesystem::path NoteFile(const std::filesystem::path& folder, const ServerNote& note);

// Writes a temporary file and renames it, so that no reader sees a partly written note.
base::Status WriteNote(const std::filesystem::path& file, const ServerNote& note);

// A note and its file.
struct NoteFound {
  std::filesystem::path file;
  ServerNote note;
};
// The result of ReadNotes().
struct NotesFound {
  std::vector<NoteFound> notes;               // at most a thousand notes
  base::Problems problems;                    // problems of files, such as a file that is no note
  std::vector<std::filesystem::path> broken;  // the paths of files that are not notes
};
// Reads all notes in the folder.
NotesFound ReadNotes(const std::filesystem::path& folder);

// Returns all lost simulations in the notes: the simulations of ended processes, and the lost
// simulations that running processes have taken over. If `broker` is not empty, returns only
// simulations of servers at that broker.
std::vector<LostSimulation> LostSimulationsNoted(const std::string& broker);

}  // namespace gsv::app
