// Commands that list and control simulations in other processes.
#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <functional>
#include <map>
#include <memory>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include "apps/gsv/commands/commands.h"
#include "apps/gsv/commands/robot_listing.h"
#include "apps/gsv/commands/selection_options.h"
#include "apps/gsv/lost/server_note.h"
#include "apps/gsv/process/exit_code.h"
#include "apps/gsv/process/option_values.h"
#include "gsv/base/spelling.h"
#include "gsv/gateway/api/status_json.h"
#include "gsv/orb/errors.h"
#include "gsv/services/conversions.h"
#include "gsv/simulation/commands/argument_reader.h"
#include "gsv/simulation/commands/command_table.h"

namespace gsv::app {
namespace {

using simulation::Phase;

constexpr const char* kControlGroup = "Commands to control running simulations";

// Returns the JSON object that viewers get, with two more members: `server` at the start, and
// `state_hash` at the end.
std::string JsonText(const FoundSimulation& simulation) {
  const RemoteServer& server = simulation.server;
  nlohmann::ordered_json json = {{"server",
                                  {{"name", server.name},
                                   {"place", server.place},
                                   {"broker", server.broker},
                                   {"viewer_url", server.viewer_url}}}};
  json.update(nlohmann::ordered_json::parse(gateway::StatusJson(simulation.status)));
  const auto healths = HealthOf(simulation);
  for (auto& robot : json["robots"]) {
    // Only the server knows the robot's motion, so the health of StatusJson() is replaced by the
    // server's.
    robot.erase("health");
    const auto found = healths.find(robot.value("name", ""));
    if (found == healths.end()) continue;
    const RemoteHealth& health = found->second;
    robot["health"] = {{"state", health.state},
                       {"level", health.level},
                       {"since_s", base::ToSeconds(health.since)},
                       {"sentence", health.sentence}};
  }
  const auto hash = orb::Call(server.Describe(), [&] {
    return std::string(CORBA::String_var(simulation.reference->state_hash()));
  });
  json["state_hash"] = hash.value_or("");  // empty if the simulation has ended
  return json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

void Print(const FoundSimulation& simulation, bool lists_all) {
  const simulation::SimulationStatus& status = simulation.status;
  const std::string target = status.mode == simulation::Mode::kLockstep
                                 ? std::string("as fast as possible")
                                 : "target " + nlohmann::json(status.target_factor).dump();
  std::printf("%s on %s: %s at %.3f s, %s, real-time factor %.2f (%s), %" PRIu64 " late steps\n",
              status.name.c_str(), simulation.server.Describe().c_str(), ToString(status.phase),
              base::ToSeconds(status.time), ToString(status.mode), status.real_time_factor,
              target.c_str(), status.late_steps);
  std::fputs(RobotListing(status, HealthOf(simulation), lists_all).c_str(), stdout);
  if (!status.waiting_for.empty()) std::printf("  waiting for %s\n", status.waiting_for.c_str());
  if (!status.failure.empty()) std::printf("  failed: %s\n", status.failure.c_str());
}

struct Arguments {
  Selection selection;
  bool json = false, lists_all = false;
  std::uint64_t steps = 1;
  double factor = 1;
  std::map<std::string, std::string> texts;  // arguments of a command, by parameter
  std::string robot;                         // the robot whose output is printed; empty for all
};

// Lists the simulations that ran on killed servers of this user.
int ListLost(const Arguments& arguments) {
  int count = 0;
  for (const LostSimulation& lost : LostSimulationsNoted(arguments.selection.broker)) {
    const std::string& wanted = arguments.selection.simulation;
    if (!wanted.empty() && lost.name != wanted) continue;
    ++count;
    if (arguments.json) {
      std::puts(Describe(lost)
                    .dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)
                    .c_str());
    } else {
      std::printf("%s\n", Sentence(lost).c_str());
    }
  }
  return count;
}

int List(const Arguments& arguments) {
  std::vector<std::string> silent;
  const auto simulations = FindSimulations(arguments.selection, silent);
  if (!simulations) return PrintError(simulations.error());
  for (const std::string& sentence : silent)
    std::fprintf(stderr, "gsv: warning: %s\n", sentence.c_str());
  for (const FoundSimulation& simulation : *simulations) {
    if (arguments.json) {
      std::puts(JsonText(simulation).c_str());
    } else {
      Print(simulation, arguments.lists_all);
    }
  }
  const int lost = arguments.selection.server.empty() ? ListLost(arguments) : 0;
  if (!simulations->empty() || lost > 0) return kOk;
  if (!arguments.selection.simulation.empty()) {
    return PrintError(NoSuchSimulation(arguments.selection));
  }
  if (!arguments.json) std::fprintf(stderr, "gsv: no simulation is running\n");
  return kOk;
}

// Returns an error if the simulation has no robot of this name. An empty name stands for all.
base::Status CheckRobot(const simulation::SimulationStatus& status, const std::string& robot) {
  std::vector<std::string> names;
  for (const simulation::RobotStatus& each : status.robots) names.push_back(each.name);
  if (robot.empty() || std::find(names.begin(), names.end(), robot) != names.end()) return {};
  return base::Fail(
      base::ErrorCode::kInvalidArgument,
      "there is no robot of this name in " + status.name + base::DidYouMean(robot, names), robot);
}

// Prints the lines that behaviour programs have printed.
int PrintOutput(const Arguments& arguments) {
  const auto simulation = FindOneSimulation(arguments.selection);
  if (!simulation) return PrintError(simulation.error());
  if (auto ok = CheckRobot(simulation->status, arguments.robot); !ok) return PrintError(ok.error());
  const auto printed = orb::Call(simulation->server.Describe(), [&] {
    sba::OutputLines_var lines = simulation->reference->output(arguments.robot.c_str());
    if (lines->length() == 0 && !arguments.json) {
      const std::string none = arguments.robot.empty() ? "no behaviour has printed output"
                                                       : "the behaviour of " + arguments.robot +
                                                             " has printed no output";
      std::fprintf(stderr, "gsv: %s\n", none.c_str());
    }
    for (CORBA::ULong i = 0; i < lines->length(); ++i) {
      const sba::OutputLine& line = lines[i];
      const double time = static_cast<double>(line.time_ns) * 1e-9;
      if (arguments.json) {
        const nlohmann::ordered_json json{{"time_s", time},
                                          {"robot", std::string(line.robot)},
                                          {"stream", std::string(line.stream)},
                                          {"text", std::string(line.text)}};
        std::puts(json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace).c_str());
      } else {
        std::printf("%9.3f s  %s: %s\n", time, std::string(line.robot).c_str(),
                    std::string(line.text).c_str());
      }
    }
  });
  return printed ? kOk : PrintError(printed.error());
}

using Call = std::function<void(sba::Simulation_ptr, const Arguments&)>;

// Waits until the requested steps are done. Slow behaviours can make this wait arbitrarily long.
// Returns false if the user interrupts.
base::Result<bool> AwaitRest(const FoundSimulation& simulation, Signals& signals) {
  auto phase = sba::PHASE_STARTING;
  while (phase == sba::PHASE_STARTING || phase == sba::PHASE_RUNNING) {
    if (signals.WaitFor(0) != 0) return false;
    const auto known = phase;
    const auto next = orb::Call(simulation.server.Describe(),
                                [&] { return simulation.reference->await_change(known); });
    if (!next) return base::Fail(next.error());
    phase = *next;
  }
  return true;
}

int Steer(const Arguments& arguments, const Call& call, bool awaits_rest, Signals& signals) {
  auto simulation = FindOneSimulation(arguments.selection);
  if (!simulation) return PrintError(simulation.error());
  const auto done =
      orb::Call(simulation->server.Describe(), [&] { call(simulation->reference, arguments); });
  if (!done) return PrintError(done.error());
  if (awaits_rest) {
    const auto rested = AwaitRest(*simulation, signals);
    if (!rested) return PrintError(rested.error());
    if (!*rested) return kInterrupted;
  }
  // A `gsv run` without a viewer ends when its simulation is stopped. Then the last known status is
  // used.
  if (const auto status = StatusOf(*simulation)) {
    simulation->status = *status;
  } else {
    simulation->status.phase = Phase::kStopped;
  }
  if (arguments.json) {
    std::puts(JsonText(*simulation).c_str());
  } else {
    Print(*simulation, arguments.lists_all);
  }
  return kOk;
}

std::shared_ptr<Arguments> AddSelection(CLI::App& command) {
  auto arguments = std::make_shared<Arguments>();
  AddInstanceOptions(command, arguments->selection);
  command.add_flag("--json", arguments->json, "print one line per simulation, each a JSON object");
  return arguments;
}

// Adds a command. `add_value` adds the argument before the simulation's name.
void AddSteering(const CommandLine& line, const char* name, const char* description, Call call,
                 const std::function<void(CLI::App&, Arguments&)>& add_value = {},
                 bool awaits_rest = false) {
  CLI::App* command = line.app.add_subcommand(name, description);
  command->group(kControlGroup);
  auto arguments = AddSelection(*command);
  if (add_value) add_value(*command, *arguments);
  AddSimulationName(*command, arguments->selection);
  command->callback([arguments, line, call = std::move(call), awaits_rest] {
    line.exit_code = Steer(*arguments, call, awaits_rest, line.signals);
  });
}

void AddStepCount(CLI::App& command, Arguments& arguments) {
  command.add_option("count", arguments.steps, "number of steps")
      ->check(Between(std::uint64_t{1}, std::uint64_t{1'000'000'000}))
      ->capture_default_str();
}

void AddFactor(CLI::App& command, Arguments& arguments) {
  command
      .add_option("real_time_factor", arguments.factor,
                  "simulated seconds per second of wall-clock time, such as 0.5 or 10")
      ->required();
}

// Returns the name with dashes, such as set-gravity for set_gravity.
std::string Dashed(std::string_view name) {
  std::string text(name);
  std::replace(text.begin(), text.end(), '_', '-');
  return text;
}

void AddParameter(const simulation::Parameter& parameter, CLI::App& command, Arguments& arguments) {
  std::string help(parameter.summary);
  help += ": " + DescribeRange(parameter);
  if (parameter.default_value) {
    help += " (default: " + simulation::ToText(*parameter.default_value) + ")";
  } else if (!parameter.is_required()) {
    help += " (default: " + std::string(parameter.default_meaning) + ")";
  }
  const std::string name(parameter.name);
  const std::string type(ToString(parameter.type));
  const auto set = [&arguments, name](const std::string& text) { arguments.texts[name] = text; };
  command.add_option_function<std::string>("--" + Dashed(name), set, help)
      ->type_name(type)
      ->required(parameter.is_required());
}

// Adds a command of the table simulation::Commands, with its parameters as options.
void AddFromTable(const CommandLine& line, const simulation::Command& command) {
  const auto call = [&command](sba::Simulation_ptr simulation, const Arguments& given) {
    const model::Parameters texts(given.texts.begin(), given.texts.end());
    simulation->command(std::string(command.name).c_str(), services::ToIdl(texts));
  };
  const auto add_parameters = [&command](CLI::App& app, Arguments& arguments) {
    for (const simulation::Parameter& each : command.parameters) {
      AddParameter(each, app, arguments);
    }
  };
  AddSteering(line, Dashed(command.name).c_str(), std::string(command.summary).c_str(), call,
              add_parameters);
}

}  // namespace

void AddControlCommands(const CommandLine& line) {
  CLI::App* list = line.app.add_subcommand("ps", "List running simulations and their robots");
  list->group(kControlGroup);
  auto arguments = AddSelection(*list);
  list->add_option("simulation", arguments->selection.simulation,
                   "list only the simulations with this name");
  list->add_flag("-a,--all", arguments->lists_all,
                 "list all robots (default: the 20 with the most serious states)");
  list->callback([arguments, line] { line.exit_code = List(*arguments); });

  CLI::App* output = line.app.add_subcommand("output", "Print the last output lines of behaviours");
  output->group(kControlGroup);
  auto of_output = AddSelection(*output);
  output->get_option("--json")->description("print one JSON object per output line");
  output->add_option("--robot", of_output->robot, "only the output of this robot's behaviour")
      ->type_name("ROBOT");
  AddSimulationName(*output, of_output->selection);
  output->callback([of_output, line] { line.exit_code = PrintOutput(*of_output); });

  AddSteering(line, "pause", "Pause a running simulation",
              [](sba::Simulation_ptr simulation, const Arguments&) { simulation->pause(); });
  AddSteering(line, "resume", "Resume a paused simulation, or start one that was reset",
              [](sba::Simulation_ptr simulation, const Arguments&) {
                const sba::SimulationState_var state = simulation->state();
                if (state->phase == sba::PHASE_CREATED) {
                  simulation->start();
                } else {
                  simulation->resume();
                }
              });
  AddSteering(
      line, "step", "Advance a simulation that is paused or not started by a number of steps",
      [](sba::Simulation_ptr simulation, const Arguments& given) { simulation->step(given.steps); },
      &AddStepCount, true);
  AddSteering(
      line, "real-time-factor", "Set the target real-time factor of a simulation in real-time mode",
      [](sba::Simulation_ptr simulation, const Arguments& given) {
        simulation->set_factor(given.factor);
      },
      &AddFactor);
  line.app.get_subcommand("real-time-factor")->alias("factor");
  AddSteering(line, "stop", "Stop a simulation; then only a reset is possible",
              [](sba::Simulation_ptr simulation, const Arguments&) { simulation->stop(); });
  AddSteering(line, "reset", "Reset a simulation to its start; `gsv resume` starts it again",
              [](sba::Simulation_ptr simulation, const Arguments&) { simulation->reset(); });
  for (const simulation::Command& command : simulation::Commands()) {
    const std::string name = Dashed(command.name);
    const auto own =
        line.app.get_subcommands([&](const CLI::App* each) { return each->get_name() == name; });
    if (own.empty()) AddFromTable(line, command);
  }
}

}  // namespace gsv::app
