// What to run: a world, robots and their behaviours, and how. Plain data, and its short forms on
// the command line; scenario_file.h reads and writes it as YAML (docs/formats/scenario.md).
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/model.h"
#include "gsv/model/pedestrian_group.h"
#include "gsv/scenario/expectation.h"
#include "gsv/scenario/fault.h"

namespace gsv::scenario {

struct RobotEntry {
  std::string model;                        // a file, folder or name; empty: the world brings it
  std::string name;                         // empty: after its model
  std::optional<Place> start;               // without one a free place is looked for
  std::string behaviour;                    // its name and options; empty: none
  std::string behaviour_constraint;         // or what its offer must fulfil
  std::optional<model::Movement> movement;  // without one: as its model says
  // As model/drive_choice.h has it; empty: its model's own drive, else the guessed one.
  std::string drive = {};

  friend bool operator==(const RobotEntry&, const RobotEntry&) = default;
};

// What is not said is left to whoever runs it.
struct Scenario {
  std::string world;  // a file, folder or name
  std::vector<RobotEntry> robots;
  std::vector<RobotEntry> avatars;  // without behaviour and movement
  std::vector<model::PedestrianGroup> pedestrians;
  std::string name;  // of the simulation
  std::optional<std::uint64_t> seed;
  std::optional<bool> lockstep;          // else in real time
  std::optional<double> factor;          // simulated seconds a wall second, > 0
  std::optional<double> step, duration;  // s, simulated
  std::optional<double> deadline;        // s of wall time that a behaviour may run for
  std::optional<bool> fails_with_behaviour;
  std::optional<bool> in_process;  // behaviours are plug-ins, not programs
  std::vector<std::string> model_path;
  std::string record;  // a file or folder; empty: no recording
  std::vector<std::string> record_topics;
  std::map<std::string, double> record_rates;  // Hz of simulated time, by kind
  std::optional<bool> record_png;              // pictures, else JPEG
  std::vector<Fault> faults;
  std::vector<Expectation> expect;

  friend bool operator==(const Scenario&, const Scenario&) = default;
};

// Reads "MODEL[@x,y[,yaw]]": metres; yaw in radians, or in degrees when it ends in "deg".
base::Result<RobotEntry> ParseRobot(const std::string& text);

// Reads "COUNT@x,y[,radius][:x,y[,radius]…]": so many pedestrians, and the goals of their route.
base::Result<model::PedestrianGroup> ParsePedestrians(const std::string& text);

// A finite number, whole; nothing if the text is anything else.
std::optional<double> ParseNumber(std::string_view text);
// Radians, or degrees when it ends in "deg".
std::optional<double> ParseAngle(std::string_view text);

// Our own default world with five robots of four kinds, each with a behaviour.
Scenario DefaultScenario();

}  // namespace gsv::scenario
