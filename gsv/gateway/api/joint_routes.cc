#include "gsv/gateway/api/joint_routes.h"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "gsv/base/spelling.h"
#include "gsv/gateway/api/command_json.h"

namespace gsv::gateway {
namespace {

using OrderedJson = nlohmann::ordered_json;
using SimulationPointer = std::shared_ptr<simulation::Simulation>;
using Kind = world::JointCommand::Kind;

const char* NameOfCommand(Kind kind) {
  switch (kind) {
    case Kind::kPosition:
      return "position";
    case Kind::kVelocity:
      return "velocity";
    case Kind::kEffort:
      return "effort";
    case Kind::kNone:
      break;
  }
  return "";
}

// Adds a limit. Infinite limits are left out.
void AddFinite(OrderedJson& json, const char* key, double value) {
  if (std::isfinite(value)) json[key] = value;
}

// Whether the joint is listed: a fixed joint has no position, and the position of a ball joint is
// not a single number.
bool IsListed(const model::Joint& joint) { return model::TakesCommands(joint.kind); }

OrderedJson JointJson(const world::Snapshot& snapshot, const world::Body& body, int number) {
  const model::Joint& joint = body.model->joints[static_cast<std::size_t>(number)];
  const auto index = static_cast<std::size_t>(body.first_joint + number);
  const world::State& state = snapshot.state;
  OrderedJson json{{"name", joint.name},
                   {"kind", model::NameOf(joint.kind)},
                   {"unit", joint.kind == model::JointKind::kPrismatic ? "m" : "rad"},
                   {"position", state.joint_positions[index]},
                   {"velocity", state.joint_velocities[index]}};
  AddFinite(json, "minimum", joint.position_limits.min);
  AddFinite(json, "maximum", joint.position_limits.max);
  AddFinite(json, "max_velocity", joint.velocity_limit);
  AddFinite(json, "max_effort", joint.effort_limit);
  if (index < state.joint_commands.size()) {
    const world::JointCommand& command = state.joint_commands[index];
    const char* const kind = NameOfCommand(command.kind);
    if (*kind != '\0') json["command"] = {{kind, command.value}};
  }
  // This check does not move the joint: it returns why the joint accepts no commands.
  const auto takes = world::CheckJointCommand(body, number, {Kind::kPosition, 0});
  if (!takes) json["refusal"] = takes.error().message;
  return json;
}

Response ListJoints(const SimulationPointer& simulation, const Request& request) {
  const std::string& name = request.Parameter("body");
  const std::shared_ptr<const world::Snapshot> snapshot = simulation->snapshot();
  const int index = snapshot->layout->Find(name);
  if (index < 0) return ErrorResponse(404, "there is no body '" + name + "'");
  const world::Body& body = snapshot->layout->bodies[static_cast<std::size_t>(index)];
  OrderedJson joints = OrderedJson::array();
  for (std::size_t i = 0; i < body.model->joints.size(); ++i) {
    if (!IsListed(body.model->joints[i])) continue;
    joints.push_back(JointJson(*snapshot, body, static_cast<int>(i)));
  }
  OrderedJson json{{"body", name},
                   {"time_s", base::ToSeconds(snapshot->state.time)},
                   {"joints", std::move(joints)}};
  if (auto reason = ControlledByBehaviour(*simulation, name)) json["refusal"] = *std::move(reason);
  return JsonResponse(200, json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace));
}

base::Status CommandJoint(simulation::Simulation& simulation, const std::string& body,
                          const std::string& joint, const world::JointCommand& command) {
  const std::shared_ptr<simulation::Agent> agent = simulation.agent(body);
  if (!agent) return simulation.CommandJoint(body, joint, command);
  const int number = model::FindJoint(agent->Joints(), joint);
  if (number >= 0) return agent->CommandJoint(number, command);
  std::vector<std::string> names;
  for (const model::Joint& each : agent->Joints()) names.push_back(each.name);
  return base::Fail(base::ErrorCode::kNotFound,
                    "there is no joint '" + joint + "'" + base::DidYouMean(joint, names), body);
}

Response HandleCommand(const SimulationPointer& simulation, const Request& request) {
  const std::string& body = request.Parameter("body");
  if (simulation->snapshot()->layout->Find(body) < 0) {
    return ErrorResponse(404, "there is no body '" + body + "'");
  }
  const base::Result<world::JointCommand> command = ParseJointCommand(request.body);
  if (!command) return ErrorResponse(command.error());
  if (const auto reason = ControlledByBehaviour(*simulation, body)) {
    return ErrorResponse(409, *reason);
  }
  const auto done = CommandJoint(*simulation, body, request.Parameter("joint"), *command);
  return done ? JsonResponse(200, "{}") : ErrorResponse(done.error());
}

}  // namespace

std::optional<std::string> ControlledByBehaviour(const simulation::Simulation& simulation,
                                                 const std::string& robot) {
  const simulation::SimulationStatus status = simulation.status();
  const auto found = std::find_if(status.robots.begin(), status.robots.end(),
                                  [&](const auto& each) { return each.name == robot; });
  if (found == status.robots.end() || found->is_avatar || found->behaviour.empty() ||
      found->phase == simulation::AgentPhase::kFinished) {
    return {};
  }
  return "'" + robot + "' is controlled by its behaviour '" + found->behaviour +
         "'. Add a robot without a behaviour to control it yourself.";
}

std::vector<Route> JointRoutes(const std::shared_ptr<SimulationDirectory>& directory) {
  const std::string joints = "/api/simulations/{name}/bodies/{body}/joints";
  return {
      {"GET", joints, Permission::kWatch, false, Pool::kReaders,
       OfSimulation(directory, &ListJoints), "List the joints of a body with their state"},
      {"POST", joints + "/{joint}", Permission::kControl, true, Pool::kCommanders,
       OfSimulation(directory, &HandleCommand), "Command a joint"},
  };
}

}  // namespace gsv::gateway
