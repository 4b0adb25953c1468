// A note of a server's simulations in this user's state folder, by which a later server reports
// what a killed one has lost: $XDG_STATE_HOME/gsv/servers (~/.local/state), one small file per
// server, which is removed at a regular end.
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

struct LostSimulation {
  std::string name, world, phase;
  double time_s = 0;                    // simulated, at the last update
  std::int64_t noted = 0;               // time of the last update, s since 1970
  std::string recording;                // a file or folder; empty: it was not recorded
  std::optional<double> whole_until_s;  // the recording's last message, after it was read
  std::string server;                   // the server that ran it: "gsv (process 123)"
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

// The note of this process.
ServerNote NewNote();
// Whether the process that wrote it still runs. A process of another host counts as running.
bool IsOfTheLiving(const ServerNote& note);

// Created if it does not exist.
base::Result<std::filesystem::path> NotesFolder();
// The path of this process's note.
std::filesystem::path NoteFile(const std::filesystem::path& folder, const ServerNote& note);

// Written to a temporary file and renamed, so that no reader gets a part of it.
base::Status WriteNote(const std::filesystem::path& file, const ServerNote& note);

struct NoteFound {
  std::filesystem::path file;
  ServerNote note;
};
struct NotesFound {
  std::vector<NoteFound> notes;               // at most a thousand
  base::Problems problems;                    // for example a file that is not a note
  std::vector<std::filesystem::path> broken;  // those files
};
NotesFound ReadNotes(const std::filesystem::path& folder);

// All lost simulations in the notes: those of ended processes, and those that running processes
// have taken over from them. `broker`: only of servers at that broker; empty: of all.
std::vector<LostSimulation> LostSimulationsNoted(const std::string& broker);

}  // namespace gsv::app
