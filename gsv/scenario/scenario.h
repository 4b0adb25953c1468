// A scenario: a world, robots with their behaviours, and options. This header has the data and the
// short forms of the command line. scenario_file.h reads and writes YAML
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

// A robot of a scenario, or an avatar (a person in the world whom a user drives).
struct RobotEntry {
  // A file, a folder, or a name. Empty if the robot is in the world file.
  std::string model;
  std::string name;            // if empty, the robot gets the name of its model
  std::optional<Place> start;  // if not set, the robot starts at the first free place
  std::string behaviour;       // name and options of the behaviour; empty if the robot has none
  // A constraint of the OMG Trading Service, instead of a name in `behaviour`. The behaviour's
  // offer must satisfy it.
  std::string behaviour_constraint;
  std::optional<model::Movement> movement;  // if not set, the movement of the model is used
  // A text as in model/drive_choice.h. If it is empty, the drive of the model is used. A model
  // without a drive gets a guessed drive.
  std::string drive = {};

  friend bool operator==(const RobotEntry&, const RobotEntry&) = default;
};

// Options for publishing to ROS 2 nodes. An empty text means the default of the command line.
struct Ros2Settings {
  std::string range, cmd_vel, distro;             // the values of the keys with these names
  std::map<std::string, std::string> namespaces;  // namespace of each robot

  friend bool operator==(const Ros2Settings&, const Ros2Settings&) = default;
};

// A scenario. The program that runs the scenario chooses defaults for values that are not set.
struct Scenario {
  std::string world;  // a file, folder or name
  std::vector<RobotEntry> robots;
  std::vector<RobotEntry> avatars;  // avatars, which have no behaviour and no movement
  std::vector<model::PedestrianGroup> pedestrians;
  std::string name;  // name of the simulation
  std::optional<std::uint64_t> seed;
  std::optional<bool> lockstep;          // true for lockstep, false for real time
  std::optional<double> factor;          // target real-time factor, > 0
  std::optional<double> step, duration;  // simulated time, s
  std::optional<double> deadline;        // maximum wall-clock time of a behaviour's turn, s
  std::optional<double> stuck_after;     // see Specification::stuck_after, simulated time, s
  // whether a dead or unresponsive behaviour ends the run
  std::optional<bool> fails_with_behaviour;
  // whether behaviours run as plug-ins in this process, and not as programs
  std::optional<bool> in_process;
  std::vector<std::string> model_path;     // folders that are searched for models
  std::string record;                      // a file or folder; empty if the run is not recorded
  std::vector<std::string> record_topics;  // see recording::Selection; empty for all topics
  // rates in Hz of simulated time, by the kind of message
  std::map<std::string, double> record_rates;
  std::optional<bool> record_png;    // true for images as PNG, false for JPEG
  std::optional<Ros2Settings> ros2;  // not set if the run is not published to ROS 2 nodes
  std::vector<Fault> faults;         // faults to apply during the run
  std::vector<Expectation> expect;   // conditions that the run must satisfy

  friend bool operator==(const Scenario&, const Scenario&) = default;
};

// Parses "MODEL[@x,y[,yaw]]". Positions are in metres. The yaw is in radians, or in degrees if the
// text ends in "deg".
base::Result<RobotEntry> ParseRobot(const std::string& text);

// Parses "COUNT@x,y[,radius][:x,y[,radius]…]": the number of pedestrians, and the goals of their
// route.
base::Result<model::PedestrianGroup> ParsePedestrians(const std::string& text);

// Parses a text that is one finite number. Returns nullopt for other texts.
std::optional<double> ParseNumber(std::string_view text);
// Parses an angle in radians, or in degrees if the text ends in "deg".
std::optional<double> ParseAngle(std::string_view text);

// The default scenario: the built-in office with five robots of four models, each with a behaviour.
Scenario DefaultScenario();

}  // namespace gsv::scenario
