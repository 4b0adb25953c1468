// A change of a simulated world or its bodies by a user, with all data to repeat it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "gsv/base/sim_time.h"
#include "gsv/geometry/pose.h"
#include "gsv/model/model.h"

namespace gsv::simulation {

struct Edit {
  enum class Kind { kAddRobot, kAddAvatar, kAddObject, kRemove, kPlace, kCommand };
  // The moment between two steps, relative to the turns of behaviours.
  enum class Moment {
    kBeforeTurns,  // behaviours that wake at this instant find the world changed
    kAfterTurns,   // behaviours have had their turn; the next step finds the world changed
    kAmidTurns,    // some behaviours may have had their turn; which ones is unknown
  };

  std::int64_t step = 0;  // taken so far
  base::SimTime time{0};
  Kind kind = Kind::kPlace;
  Moment moment = Moment::kBeforeTurns;
  std::uint64_t halt = 0;  // edits with the same number were made during one pause
  std::string body;
  // For added bodies: the file of the model, or the body that is copied.
  std::string model;
  std::string copy_of;
  std::string behaviour;  // its name; empty: none
  std::optional<model::Movement> movement;
  std::string drive;  // as model/drive_choice.h has it; empty: the model's or the guessed one
  // For added or placed bodies: the requested pose.
  geometry::Pose world_from_body;
  bool on_ground = true;
  // A command of simulation/commands/command_table.h and its arguments, for ReadArguments().
  std::string command;
  std::map<std::string, std::string> arguments;
};

const char* ToString(Edit::Kind kind);
const char* ToString(Edit::Moment moment);

}  // namespace gsv::simulation
