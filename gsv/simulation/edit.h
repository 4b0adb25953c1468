// A change by hand of a simulated world or of who stands in it: all that is needed to make it once more.
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
  // Where between two steps, as behaviours see it.
  enum class Moment {
    kBeforeTurns,  // those that wake at this instant find the world changed
    kAfterTurns,   // they have had their turn; the next step finds it changed
    kAmidTurns,    // some may have, and some not: which, nobody knows
  };

  std::int64_t step = 0;  // taken so far
  base::SimTime time{0};
  Kind kind = Kind::kPlace;
  Moment moment = Moment::kBeforeTurns;
  std::uint64_t halt = 0;  // edits with the same number were made without going on between them
  std::string body;
  // Of what is added: the file of its model, or the body that it is a copy of.
  std::string model;
  std::string copy_of;
  std::string behaviour;  // its name; empty: none
  std::optional<model::Movement> movement;
  std::string drive;  // as model/drive_choice.h has it; empty: the model's or the guessed one
  // Of what is added or placed: as it was asked for.
  geometry::Pose world_from_body;
  bool on_ground = true;
  // A command of simulation/commands/command_table.h and its arguments, which the reader of
  // arguments understands.
  std::string command;
  std::map<std::string, std::string> arguments;
};

const char* ToString(Edit::Kind kind);
const char* ToString(Edit::Moment moment);

}  // namespace gsv::simulation
