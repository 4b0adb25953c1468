// The options of `gsv run`.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "apps/gsv/serving/runtime.h"
#include "apps/gsv/simulations/population.h"
#include "apps/gsv/simulations/recordings.h"
#include "gsv/scenario/scenario.h"
#include "gsv/simulation/behaviour_port.h"
#include "gsv/simulation/types.h"

namespace CLI {
class App;
}

namespace gsv::app {

// A world that was read before its run, and the problems of its files.
struct PreparedWorld {
  std::shared_ptr<const model::WorldDescription> description;
  base::Problems problems;
};

// The options of a run, after they were parsed.
struct RunOptions {
  RuntimeOptions runtime;       // options of the process that runs the simulation
  scenario::Scenario scenario;  // the scenario with the options that override it
  base::Problems problems;      // problems of the scenario's file
  std::string behaviour;        // the behaviour of all robots without a behaviour of their own
  std::map<std::string, std::string> behaviour_of;     // behaviours by robot
  std::map<std::string, model::Movement> movement_of;  // movements by robot
  std::map<std::string, std::string> drive_of;         // drives by robot, see model/drive_choice.h
  bool in_process = false;  // whether behaviours are plug-ins, and not programs
  Placing placing;          // how to place robots without a pose
  // If this function is set, it makes the behaviour of each robot, and programs of the name
  // `behaviour` are not used. `from` is the time at which the robot is added.
  std::function<std::shared_ptr<simulation::BehaviourPort>(
      const std::string& robot, const std::string& behaviour, base::SimTime from)>
      make_behaviour;
  std::vector<simulation::Edit> edits;      // edits to make during the run, in this order
  simulation::Specification specification;  // the parameters of the simulation
  std::shared_ptr<const PreparedWorld> prepared_world;  // null if the run reads the world itself
  std::string record;                                   // a file; empty if the run is not recorded
  RecordingChoice recording;                            // topics and rates of the recording
  double wall_timeout = 0;    // limit of the wall-clock time, s; 0 for none
  std::string failure_image;  // the file for an image of the first violation; may be empty
  bool open_browser = false;  // whether to open the viewer's page
  bool json = false;          // whether to print the result as JSON
  bool is_strict = false;     // whether to refuse the run if files have warnings
};

// The values of the options as the user wrote them, before they are parsed.
struct RunArguments {
  std::string world, place;
  std::vector<std::string> robots, avatars, pedestrians, behaviours, movements, drives, model_path,
      sensor_plugins;
  formats::ReadLimits limits;
  ServerLimits server_limits;
  std::string broker, name, mode_on_failure, record, record_images, failure_image;
  std::vector<std::string> record_topics, record_rates;
  // Options that may also be in a scenario file are empty if the user did not give them.
  std::optional<double> duration, step, factor, deadline, stuck_after;
  std::optional<std::uint64_t> seed;
  double wall_timeout = 0;
  int threads = 0;
  ViewerOptions web;
  Ros2Arguments ros2;
  bool lockstep = false, real_time = false, headless = false, json = false, open = false,
       in_process = false, strict = false;
};

void AddRunOptions(CLI::App& command, RunArguments& arguments);
base::Result<RunOptions> ParseArguments(const RunArguments& arguments);

}  // namespace gsv::app
