// Repeats the edits that users made during a recorded run.
#pragma once

#include <vector>

#include "apps/gsv/process/signals.h"
#include "apps/gsv/running/run_options.h"
#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/simulation/edit.h"

namespace gsv::app {

// The actions of users in a recording.
struct RecordedUserActions {
  std::vector<simulation::Edit> edits;  // in the order in which they were made
  // whether the run was paused or resumed, ended early, or got another real-time factor
  bool was_interrupted = false;
  bool has_verdicts = false;  // whether there are events about expectations
};

// Reads the actions of users from a recording. Fails if the recording does not contain the edits,
// or if an edit was made while behaviours were running. With `by_commands`, the robots repeat
// recorded commands instead of running behaviours, so edits at any time are allowed. Errors contain
// `file`.
base::Result<RecordedUserActions> ReadUserActions(const recording::McapReader& reader,
                                                  const std::string& file, bool by_commands);

// Starts a populated simulation, pauses it at each of `options.edits` to make the edit, and resumes
// it. Edits at or after the simulation's end are skipped. Returns kOk. After a signal, stops the
// simulation and returns kInterrupted. Fails if an edit is refused, or if the model of an edit is
// missing.
base::Result<int> RunWithEdits(Runtime& runtime, simulation::Simulation& simulation,
                               const RunOptions& options, Signals& signals);

}  // namespace gsv::app
