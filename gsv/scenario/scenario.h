// A scenario: a world, robots with their behaviours, and options. This header has the data and the
// short forms of the command line; scenario_file.h reads and writes YAML
// (docs/formats/scenario.md).
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
  // A file, folder or name; empty: a robot of the world file.
  std::string model;
  std::string name;                         // empty: after its model
  std::optional<Place> start;               // default: the first free place
  std::string behaviour;                    // its name and options; empty: none
  std::string behaviour_constraint;         // or a constraint on its offer
  std::optional<model::Movement> movement;  // default: the model's
  // A text as in model/drive_choice.h; empty: the model's own drive, else the guessed one.
  std::string drive = {};

  friend bool operator==(const RobotEntry&, const RobotEntry&) = default;
};

// A scenario. The program that runs it chooses defaults for absent values.
struct Scenario {
  std::string world;  // a file, folder or name
  std::vector<RobotEntry> robots;
  std::vector<RobotEntry> avatars;  // without behaviour and movement
  std::vector<model::PedestrianGroup> pedestrians;
  std::string name;  // name of the simulation
  std::optional<std::uint64_t> seed;
  std::optional<bool> lockstep;          // false: real time
  std::optional<double> factor;          // target real-time factor, > 0
  std::optional<double> step, duration;  // s, simulated
  std::optional<double> deadline;        // s of wall-clock time that a behaviour may run
  std::optional<bool> fails_with_behaviour;
  std::optional<bool> in_process;  // behaviours are plug-ins, not programs
  std::vector<std::string> model_path;
  std::string record;  // a file or folder; empty: no recording
  std::vector<std::string> record_topics;
  std::map<std::string, double> record_rates;  // Hz of simulated time, by kind
  std::optional<bool> record_png;              // images as PNG; false: JPEG
  std::vector<Fault> faults;
  std::vector<Expectation> expect;

  friend bool operator==(const Scenario&, const Scenario&) = default;
};

// Reads "MODEL[@x,y[,yaw]]": metres; yaw in radians, or in degrees when it ends in "deg".
base::Result<RobotEntry> ParseRobot(const std::string& text);

// Reads "COUNT@x,y[,radius][:x,y[,radius]…]": the number of pedestrians, and the goals of their
// route.
base::Result<model::PedestrianGroup> ParsePedestrians(const std::string& text);

// Reads a text that is one finite number; nothing for other texts.
std::optional<double> ParseNumber(std::string_view text);
// Reads an angle: radians, or degrees if the text ends in "deg".
std::optional<double> ParseAngle(std::string_view text);

// The default scenario: the built-in office with five robots of four models, each with a behaviour.
Scenario DefaultScenario();

}  // namespace gsv::scenario
