// What people did by hand in a recorded run, done once more.
#pragma once

#include <vector>

#include "apps/gsv/process/signals.h"
#include "apps/gsv/running/run_options.h"
#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/simulation/edit.h"

namespace gsv::app {

// What a recording tells of people's doings.
struct RecordedDoings {
  std::vector<simulation::Edit> edits;  // in the order in which they were made
  bool was_held_up = false;             // paused, resumed, ended early, or its pace changed
};

// Fails, naming `file`, where they cannot be repeated: what came before the recording is not known,
// an edit came while behaviours ran (with recorded commands, `by_commands`, that is no matter).
base::Result<RecordedDoings> ReadDoings(const recording::McapReader& reader,
                                        const std::string& file, bool by_commands);

// Starts a simulation that was just populated, halts it at each of `options.edits` to make it, and
// has it go on. An edit at or after its end is left out. Gives kOk, or kInterrupted after a signal,
// with the simulation stopped. Fails when an edit is refused or its model is gone.
base::Result<int> RunWithEdits(Runtime& runtime, simulation::Simulation& simulation,
                               const RunOptions& options, Signals& signals);

}  // namespace gsv::app
