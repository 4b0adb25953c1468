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

// An edit of a simulated world.
struct Edit {
  // kPlace: a body is moved to a pose. kCommand: a command of the command table is applied.
  enum class Kind { kAddRobot, kAddAvatar, kAddObject, kRemove, kPlace, kCommand };
  // Between two steps, each behaviour that wakes has a turn: it reads sensors and sends commands. A
  // Moment states whether the edit was made before, after or during these turns.
  enum class Moment {
    kBeforeTurns,  // before the turns: behaviours that wake at this instant see the changed world
    kAfterTurns,   // after the turns: only the next step uses the changed world
    kAmidTurns,  // during the turns: it is unknown which behaviours had their turn before the edit
  };

  std::int64_t step = 0;  // number of steps taken before the edit
  base::SimTime time{0};  // simulated time of the edit
  Kind kind = Kind::kPlace;
  Moment moment = Moment::kBeforeTurns;
  std::uint64_t halt = 0;  // number of the pause; edits during one pause have the same number
  std::string body;        // the body that is added, removed or moved
  // Only for added bodies: the file of the model, or the body that is copied.
  std::string model;
  std::string copy_of;
  std::string behaviour;                    // name of the robot's behaviour; empty if it has none
  std::optional<model::Movement> movement;  // for an added robot; not set: as in the model
  // the drive in the form of model/drive_choice.h; empty means the model's own drive, or a guessed
  // drive
  std::string drive;
  // Only for bodies that are added or moved: the requested pose.
  geometry::Pose world_from_body;
  bool on_ground = true;  // whether the body is put on the floor, see RobotSpecification
  // A command of simulation/commands/command_table.h and its arguments, for ReadArguments().
  std::string command;
  std::map<std::string, std::string> arguments;
};

const char* ToString(Edit::Kind kind);
const char* ToString(Edit::Moment moment);

}  // namespace gsv::simulation
