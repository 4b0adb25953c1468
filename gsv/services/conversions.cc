#include "gsv/services/conversions.h"

#include "gsv/base/spelling.h"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <cstring>

namespace gsv::services {
namespace {

model::ParameterValue ValueOf(const std::string& text) {
  if (text == "true") return true;
  if (text == "false") return false;
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error == std::errc() && end == text.data() + text.size() && !text.empty()) return number;
  return text;
}

std::string TextOf(const model::ParameterValue& value) {
  if (const bool* flag = std::get_if<bool>(&value)) return *flag ? "true" : "false";
  if (const double* number = std::get_if<double>(&value)) {
    char text[32];
    const auto [end, error] = std::to_chars(text, text + sizeof text, *number);
    return std::string(text, error == std::errc() ? end : text);
  }
  return std::get<std::string>(value);
}

sba::AgentPhase AgentPhaseOf(simulation::AgentPhase phase) {
  switch (phase) {
    case simulation::AgentPhase::kNone:
      return sba::AGENT_NONE;
    case simulation::AgentPhase::kInitialised:
      return sba::AGENT_INITIALISED;
    case simulation::AgentPhase::kRunning:
      return sba::AGENT_RUNNING;
    case simulation::AgentPhase::kWaiting:
      return sba::AGENT_WAITING;
    case simulation::AgentPhase::kFinished:
      return sba::AGENT_FINISHED;
    case simulation::AgentPhase::kUnresponsive:
      return sba::AGENT_UNRESPONSIVE;
    case simulation::AgentPhase::kDead:
      return sba::AGENT_DEAD;
  }
  return sba::AGENT_NONE;
}

simulation::AgentPhase AgentPhaseOf(sba::AgentPhase phase) {
  switch (phase) {
    case sba::AGENT_NONE:
      return simulation::AgentPhase::kNone;
    case sba::AGENT_INITIALISED:
      return simulation::AgentPhase::kInitialised;
    case sba::AGENT_RUNNING:
      return simulation::AgentPhase::kRunning;
    case sba::AGENT_WAITING:
      return simulation::AgentPhase::kWaiting;
    case sba::AGENT_FINISHED:
      return simulation::AgentPhase::kFinished;
    case sba::AGENT_UNRESPONSIVE:
      return simulation::AgentPhase::kUnresponsive;
    default:
      return simulation::AgentPhase::kDead;
  }
}

}  // namespace

sba::Placement ToIdl(const geometry::Pose& pose) {
  const auto angles = geometry::ToRollPitchYaw(pose.orientation);
  return {pose.position.x, pose.position.y, pose.position.z, angles.roll, angles.pitch, angles.yaw};
}

geometry::Pose FromIdl(const sba::Placement& p) {
  return {{p.x_m, p.y_m, p.z_m}, geometry::FromRollPitchYaw({p.roll_rad, p.pitch_rad, p.yaw_rad})};
}

sba::SensorTraits ToIdl(const model::SensorDescription& description,
                        const geometry::Pose& robot_from_link) {
  sba::SensorTraits traits;
  traits.name = description.name.c_str();
  traits.type = description.type.c_str();
  traits.mounting = ToIdl(robot_from_link * description.link_from_sensor);
  traits.update_rate_hz = description.update_rate;
  traits.parameters = ToIdl(description.parameters);
  return traits;
}

model::Parameters FromIdl(const sba::NameValues& values) {
  model::Parameters parameters;
  for (CORBA::ULong i = 0; i < values.length(); ++i) {
    parameters[std::string(values[i].name)] = ValueOf(std::string(values[i].value));
  }
  return parameters;
}

sba::NameValues ToIdl(const model::Parameters& parameters) {
  sba::NameValues values;
  values.length(static_cast<CORBA::ULong>(parameters.size()));
  CORBA::ULong i = 0;
  for (const auto& [name, value] : parameters) {
    values[i].name = name.c_str();
    values[i].value = TextOf(value).c_str();
    ++i;
  }
  return values;
}

std::map<std::string, std::string> TextsOf(const sba::NameValues& values) {
  std::map<std::string, std::string> texts;
  for (CORBA::ULong i = 0; i < values.length(); ++i) {
    texts[std::string(values[i].name)] = std::string(values[i].value);
  }
  return texts;
}

sba::CommandDescription ToIdl(const simulation::Command& command) {
  constexpr sba::CommandParameterType kTypes[]{sba::COMMAND_NUMBER, sba::COMMAND_INTEGER,
                                               sba::COMMAND_FLAG, sba::COMMAND_TEXT};
  sba::CommandDescription idl;
  idl.name = std::string(command.name).c_str();
  idl.summary = std::string(command.summary).c_str();
  idl.parameters.length(static_cast<CORBA::ULong>(command.parameters.size()));
  CORBA::ULong i = 0;
  for (const simulation::Parameter& parameter : command.parameters) {
    sba::CommandParameter& out = idl.parameters[i++];
    out.name = std::string(parameter.name).c_str();
    out.type = kTypes[static_cast<std::size_t>(parameter.type)];
    out.unit = std::string(parameter.unit).c_str();
    out.summary = std::string(parameter.summary).c_str();
    out.required = parameter.is_required();
    out.minimum = parameter.minimum;
    out.maximum = parameter.maximum;
    if (parameter.default_value) {
      out.default_value = simulation::ToText(*parameter.default_value).c_str();
    }
    out.default_meaning = std::string(parameter.default_meaning).c_str();
  }
  return idl;
}

void RefuseUnknown(const model::Parameters& options,
                   std::initializer_list<std::string_view> known) {
  for (const auto& [name, value] : options) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    std::string reason = name + ": there is no such option; the options are:";
    for (const std::string_view each : known) {
      reason += (each == *known.begin() ? " " : ", ") + std::string(each);
    }
    reason += base::DidYouMean(name, {known.begin(), known.end()});
    throw sba::Refused(reason.c_str());
  }
}

sba::Measurement ToIdl(const std::string& sensor, const sensing::Reading& reading) {
  sba::Measurement measurement;
  measurement.sensor_name = sensor.c_str();
  measurement.time_ns = reading.time.count();
  measurement.values.length(static_cast<CORBA::ULong>(reading.values.size()));
  std::copy(reading.values.begin(), reading.values.end(), measurement.values.get_buffer());
  if (reading.labels != nullptr) {
    measurement.labels.length(static_cast<CORBA::ULong>(reading.labels->size()));
    for (CORBA::ULong i = 0; i < measurement.labels.length(); ++i) {
      measurement.labels[i] = (*reading.labels)[i].c_str();
    }
  }
  measurement.image_width = measurement.image_height = 0;
  if (reading.image != nullptr) {
    const model::Image& image = *reading.image;
    measurement.image_width = static_cast<CORBA::ULong>(image.width);
    measurement.image_height = static_cast<CORBA::ULong>(image.height);
    measurement.image.length(static_cast<CORBA::ULong>(image.pixels.size()));
    std::memcpy(measurement.image.get_buffer(), image.pixels.data(), image.pixels.size());
  }
  return measurement;
}

sba::RobotHealths ToIdl(const health::Report& report) {
  sba::RobotHealths robots;
  robots.length(static_cast<CORBA::ULong>(report.robots.size()));
  for (CORBA::ULong i = 0; i < robots.length(); ++i) {
    const health::RobotHealth& health = report.robots[i];
    robots[i].name = health.robot.c_str();
    robots[i].state = health::ToString(health.state);
    robots[i].level = static_cast<CORBA::UShort>(health.level);
    robots[i].since_ns = static_cast<sba::TimeNs>(health.since.count());
    robots[i].sentence = health::Sentence(health, report.time).c_str();
  }
  return robots;
}

sba::OutputLines OutputToIdl(const std::vector<simulation::Event>& lines, std::string_view robot) {
  sba::OutputLines out;
  for (const simulation::Event& line : lines) {
    if (!robot.empty() && line.robot != robot) continue;
    const CORBA::ULong i = out.length();
    out.length(i + 1);
    out[i].time_ns = static_cast<sba::TimeNs>(line.time.count());
    out[i].robot = line.robot.c_str();
    out[i].stream = line.kind == simulation::kProgramEndedEvent ? "" : line.kind.c_str();
    out[i].text = line.detail.c_str();
  }
  return out;
}

sba::SimulationPhase ToIdl(simulation::Phase phase) {
  switch (phase) {
    case simulation::Phase::kCreated:
      return sba::PHASE_CREATED;
    case simulation::Phase::kStarting:
      return sba::PHASE_STARTING;
    case simulation::Phase::kRunning:
      return sba::PHASE_RUNNING;
    case simulation::Phase::kPaused:
      return sba::PHASE_PAUSED;
    case simulation::Phase::kStopped:
      return sba::PHASE_STOPPED;
    case simulation::Phase::kFinished:
      return sba::PHASE_FINISHED;
    case simulation::Phase::kFailed:
      return sba::PHASE_FAILED;
  }
  return sba::PHASE_FAILED;
}

simulation::Phase FromIdl(sba::SimulationPhase phase) {
  switch (phase) {
    case sba::PHASE_CREATED:
      return simulation::Phase::kCreated;
    case sba::PHASE_STARTING:
      return simulation::Phase::kStarting;
    case sba::PHASE_RUNNING:
      return simulation::Phase::kRunning;
    case sba::PHASE_PAUSED:
      return simulation::Phase::kPaused;
    case sba::PHASE_STOPPED:
      return simulation::Phase::kStopped;
    case sba::PHASE_FINISHED:
      return simulation::Phase::kFinished;
    default:
      return simulation::Phase::kFailed;
  }
}

sba::SimulationState ToIdl(const simulation::SimulationStatus& status) {
  sba::SimulationState state;
  state.name = status.name.c_str();
  state.phase = ToIdl(status.phase);
  state.pacing = status.mode == simulation::Mode::kLockstep ? sba::LOCKSTEP : sba::REAL_TIME;
  state.step = static_cast<CORBA::ULongLong>(status.step);
  state.time_ns = status.time.count();
  state.step_ns = status.step_size.count();
  state.target_factor = status.target_factor;
  state.real_time_factor = status.real_time_factor;
  state.late_steps = status.late_steps;
  state.waiting_for = status.waiting_for.c_str();
  state.failure = status.failure.c_str();
  state.robots.length(static_cast<CORBA::ULong>(status.robots.size()));
  for (CORBA::ULong i = 0; i < state.robots.length(); ++i) {
    const simulation::RobotStatus& robot = status.robots[i];
    sba::RobotState& out = state.robots[i];
    out.name = robot.name.c_str();
    out.model = robot.model.c_str();
    out.behaviour = robot.behaviour.c_str();
    out.phase = AgentPhaseOf(robot.phase);
    out.detail = robot.detail.c_str();
    out.place = ToIdl(robot.world_from_robot);
    out.distance_m = robot.distance;
    out.collisions = robot.collisions;
  }
  return state;
}

simulation::SimulationStatus FromIdl(const sba::SimulationState& state) {
  simulation::SimulationStatus status;
  status.name = state.name;
  status.phase = FromIdl(state.phase);
  status.mode =
      state.pacing == sba::LOCKSTEP ? simulation::Mode::kLockstep : simulation::Mode::kRealTime;
  status.step = static_cast<std::int64_t>(state.step);
  status.time = base::SimTime(state.time_ns);
  status.step_size = base::SimTime(state.step_ns);
  status.target_factor = state.target_factor;
  status.real_time_factor = state.real_time_factor;
  status.late_steps = state.late_steps;
  status.waiting_for = state.waiting_for;
  status.failure = state.failure;
  for (CORBA::ULong i = 0; i < state.robots.length(); ++i) {
    const sba::RobotState& in = state.robots[i];
    simulation::RobotStatus robot;
    robot.name = in.name;
    robot.model = in.model;
    robot.behaviour = in.behaviour;
    robot.phase = AgentPhaseOf(in.phase);
    robot.detail = in.detail;
    robot.world_from_robot = FromIdl(in.place);
    robot.distance = in.distance_m;
    robot.collisions = in.collisions;
    status.robots.push_back(std::move(robot));
  }
  return status;
}

}  // namespace gsv::services
