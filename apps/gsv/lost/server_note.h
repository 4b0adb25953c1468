// What a server runs, noted in this user's state folder, so that whoever comes after one that was
// killed can tell what was lost: $XDG_STATE_HOME/gsv/servers (~/.local/state), one small file for
// each server, which goes with its clean end.
//
// Input    hostile: a note is as a power cut, or somebody else, left it.
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

struct LostSimulation {
  std::string name, world, phase;
  double time_s = 0;                    // simulated, when it was noted last
  std::int64_t noted = 0;               // that instant, s since 1970
  std::string recording;                // a file or folder; empty: it was not recorded
  std::optional<double> whole_until_s;  // the recording's last message, once it was looked at
  std::string server;                   // who ran it: "gsv (process 123)"
};

// "arena on gsv (process 123) was lost at about 12.3 s, when its server ended without a word;
// recording X.mcap, whole until 11.9 s"
std::string Sentence(const LostSimulation& lost);
// {name, world, phase: "lost", last_phase, time_s, noted, server, recording, whole_until_s?,
// sentence}
nlohmann::ordered_json Describe(const LostSimulation& lost);

struct ServerNote {
  pid_t pid = 0;
  std::uint64_t started =
      0;  // clock ticks after the machine's start; with `boot`, tells a reused pid
  std::string boot, host;
  std::string server;                       // its name
  std::string broker;                       // its reference
  std::string recordings;                   // its folder of recordings
  std::vector<LostSimulation> simulations;  // that it runs
  std::vector<LostSimulation> lost;         // by those before it
};

// Of this process.
ServerNote NewNote();
// Whether the process that wrote it still runs, as far as can be told from here: one of another
// host does.
bool IsOfTheLiving(const ServerNote& note);

// Made when it is not there.
base::Result<std::filesystem::path> NotesFolder();
// Where this process's note goes.
std::filesystem::path NoteFile(const std::filesystem::path& folder, const ServerNote& note);

// Renamed into place, so that nobody reads half of it.
base::Status WriteNote(const std::filesystem::path& file, const ServerNote& note);

struct NoteFound {
  std::filesystem::path file;
  ServerNote note;
};
struct NotesFound {
  std::vector<NoteFound> notes;               // at most a thousand
  base::Problems problems;                    // a file that is no note
  std::vector<std::filesystem::path> broken;  // those files
};
NotesFound ReadNotes(const std::filesystem::path& folder);

// What is lost, as the notes tell: all that those ran who are dead, and what the living have taken
// over from them. `broker`: only of servers at that one; empty: of all.
std::vector<LostSimulation> LostSimulationsNoted(const std::string& broker);

}  // namespace gsv::app
