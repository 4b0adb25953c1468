#include "gsv/services/hardware_servants.h"

#include <chrono>
#include <optional>
#include <set>

#include "gsv/orb/errors.h"
#include "gsv/services/conversions.h"
#include "gsv/services/joint_servants.h"
#include "gsv/services/sensor_servants.h"
#include "gsv/simulation/robots/robot_commands.h"
#include "idl/clocks.hh"

namespace gsv::services {
namespace {

using simulation::Agent;
using AgentPtr = std::shared_ptr<Agent>;
using GroupPtr = std::shared_ptr<ServantGroup>;

// A wait that takes longer than this wall-clock time returns NOT_YET, and the client waits again.
constexpr std::chrono::milliseconds kLease{2000};
constexpr unsigned kReadingRaises = orb::kNotRunning | orb::kEnded | orb::kFailed;

class SensorFactoryServant final : public POA_sba::SensorFactory {
 public:
  SensorFactoryServant(AgentPtr agent, GroupPtr group)
      : agent_(std::move(agent)), group_(std::move(group)) {}

  sba::SensorTraitsList* list() override {
    const auto descriptions = agent_->Sensors();
    auto* list = new sba::SensorTraitsList;
    list->length(static_cast<CORBA::ULong>(descriptions.size()));
    for (CORBA::ULong i = 0; i < list->length(); ++i) {
      (*list)[i] = ToIdl(descriptions[i], agent_->RobotFromLink(descriptions[i].link));
    }
    return list;
  }

  sba::Strings* types() override {
    const auto names = agent_->SensorTypes();
    auto* types = new sba::Strings;
    types->length(static_cast<CORBA::ULong>(names.size()));
    for (CORBA::ULong i = 0; i < types->length(); ++i) (*types)[i] = names[i].c_str();
    return types;
  }

  sba::Sensor_ptr open(const char* name) override {
    orb::ValueOrThrow(agent_->OpenSensor(name), orb::kRefused | orb::kNotRunning | orb::kEnded);
    return Serve<sba::Sensor>(name);
  }

  sba::Sonar_ptr create_sonar(const char* name, const sba::Placement& mounting, CORBA::Double min_m,
                              CORBA::Double max_m) override {
    return Create<sba::Sonar>("sonar", name, mounting, {{"min", min_m}, {"max", max_m}});
  }

  sba::Camera_ptr create_camera(const char* name, const sba::Placement& mounting,
                                CORBA::ULong width, CORBA::ULong height,
                                CORBA::Double horizontal_fov_rad) override {
    return Create<sba::Camera>("camera", name, mounting,
                               {{"image.width", static_cast<double>(width)},
                                {"image.height", static_cast<double>(height)},
                                {"horizontal_fov", horizontal_fov_rad}});
  }

  sba::PositioningSystem_ptr create_positioning_system(const char* name) override {
    return Create<sba::PositioningSystem>("positioning", name, {}, {});
  }

  sba::Sensor_ptr create(const char* type, const sba::SensorTraits& description) override {
    return Create<sba::Sensor>(type, std::string(description.name), description.mounting,
                               FromIdl(description.parameters), description.update_rate_hz);
  }

 private:
  template <typename Interface>
  typename Interface::_ptr_type Create(const std::string& type, const std::string& name,
                                       const sba::Placement& mounting, model::Parameters parameters,
                                       double update_rate = 0) {
    model::SensorDescription description;
    description.name = name;
    description.type = type;
    description.link_from_sensor = Inverse(agent_->RobotFromLink(0)) * FromIdl(mounting);
    description.update_rate = update_rate;
    description.parameters = std::move(parameters);
    orb::ValueOrThrow(agent_->CreateSensor(std::move(description)),
                      orb::kRefused | orb::kNotRunning | orb::kEnded);
    return Serve<Interface>(name);
  }

  template <typename Interface>
  typename Interface::_ptr_type Serve(const std::string& name) {
    for (model::SensorDescription& description : agent_->Sensors()) {
      if (description.name != name) continue;
      const auto mounted = agent_->Mounted(name);
      const bool takes_commands = mounted && simulation::TakesCommands(**mounted);
      const SensorServantMaker make = SensorServants::For(description.type, takes_commands);
      return group_->Activate<Interface>(make(agent_, std::move(description), group_));
    }
    throw sba::Ended("the sensor has just been closed");
  }

  const AgentPtr agent_;
  const GroupPtr group_;
};

class BaseServant final : public POA_sba::ActuatorProxy {
 public:
  explicit BaseServant(AgentPtr agent) : agent_(std::move(agent)) {}

  void drive(CORBA::Double linear_m_s, CORBA::Double angular_rad_s) override {
    orb::ValueOrThrow(agent_->Command({linear_m_s, 0, angular_rad_s}));
  }
  void drive_sideways(CORBA::Double linear_m_s, CORBA::Double lateral_m_s,
                      CORBA::Double angular_rad_s) override {
    orb::ValueOrThrow(agent_->Command({linear_m_s, lateral_m_s, angular_rad_s}));
  }
  void halt() override { orb::ValueOrThrow(agent_->Command({}), kReadingRaises); }

 private:
  const AgentPtr agent_;
};

class ClockServant final : public POA_sba::SharedClock {
 public:
  ClockServant(AgentPtr agent, simulation::ClockId clock, GroupPtr group)
      : agent_(std::move(agent)), clock_(clock), group_(std::move(group)) {}

  CORBA::LongLong now() override { return agent_->Now().count(); }

  sba::WaitOutcome sleep_until(CORBA::LongLong instant) override {
    return ToIdl(orb::ValueOrThrow(agent_->SleepUntil(clock_, base::SimTime(instant), kLease),
                                   orb::kNotRunning | orb::kEnded));
  }

  sba::WaitOutcome exchange(CORBA::ULongLong cycle, const sba::BaseCommand& command,
                            CORBA::LongLong instant, CORBA::LongLong& reached_ns,
                            sba::Measurements_out readings) override {
    const simulation::Exchanged exchanged = orb::ValueOrThrow(
        agent_->Exchange(clock_, cycle, CommandOf(command), base::SimTime(instant), kLease));
    reached_ns = exchanged.now.count();
    readings = ToIdl(exchanged.readings);
    return ToIdl(exchanged.wait);
  }

  sba::WaitOutcome sleep_and_read(const sba::BaseCommand& command, CORBA::LongLong instant,
                                  const sba::Strings& sensors, CORBA::LongLong& reached_ns,
                                  CORBA::Boolean& holds_time,
                                  sba::Measurements_out readings) override {
    std::set<std::string> names;
    for (CORBA::ULong i = 0; i < sensors.length(); ++i) names.emplace(sensors[i]);
    const simulation::Exchanged exchanged = orb::ValueOrThrow(
        agent_->SleepAndRead(clock_, CommandOf(command), base::SimTime(instant), kLease, names));
    reached_ns = exchanged.now.count();
    holds_time = exchanged.holds_time;
    readings = ToIdl(exchanged.readings);
    return ToIdl(exchanged.wait);
  }

  sba::CycleMemory share_memory() override {
    const simulation::CycleMemory memory = orb::ValueOrThrow(agent_->ShareMemory(clock_));
    return {memory.file.process, memory.file.descriptor, memory.offset, memory.key};
  }

  void close() override {
    (void)agent_->CloseClock(clock_);  // has no effect if the clock is closed
    group_->Deactivate(this);
  }

  void give_up(const char* reason) override {
    (void)agent_->GiveUp(clock_, reason);  // has no effect if the agent is dead
    group_->Deactivate(this);
  }

 private:
  static sba::WaitOutcome ToIdl(simulation::Wait wait) {
    return wait == simulation::Wait::kReached ? sba::REACHED : sba::NOT_YET;
  }
  static sba::Measurements* ToIdl(const std::vector<simulation::NamedReading>& from) {
    auto* const readings = new sba::Measurements;
    readings->length(static_cast<CORBA::ULong>(from.size()));
    for (CORBA::ULong i = 0; i < readings->length(); ++i) {
      (*readings)[i] = services::ToIdl(from[i].sensor, from[i].reading);
    }
    return readings;
  }
  static std::optional<world::DriveCommand> CommandOf(const sba::BaseCommand& command) {
    if (!command.given) return std::nullopt;
    return world::DriveCommand{command.linear_m_s, command.lateral_m_s, command.angular_rad_s};
  }

  const AgentPtr agent_;
  const simulation::ClockId clock_;
  const GroupPtr group_;
};

class HardwareServant final : public POA_sba::JointedHardware {
 public:
  HardwareServant(AgentPtr agent, GroupPtr group)
      : agent_(std::move(agent)), group_(std::move(group)) {}

  char* robot_name() override { return CORBA::string_dup(agent_->robot().c_str()); }
  char* robot_model() override { return CORBA::string_dup(agent_->model().c_str()); }
  CORBA::Double footprint_radius_m() override { return agent_->footprint_radius(); }
  sba::SensorFactory_ptr sensor_factory() override {
    return group_->Activate<sba::SensorFactory>(new SensorFactoryServant(agent_, group_));
  }
  sba::ActuatorProxy_ptr base() override {
    return group_->Activate<sba::ActuatorProxy>(new BaseServant(agent_));
  }
  sba::Clock_ptr open_clock() override {
    const auto clock =
        orb::ValueOrThrow(agent_->OpenClock(), orb::kRefused | orb::kNotRunning | orb::kEnded);
    return group_->Activate<sba::Clock>(new ClockServant(agent_, clock, group_));
  }
  sba::JointTraitsList* list_joints() override { return ListJoints(*agent_); }
  sba::JointActuator_ptr open_joint(const char* name) override {
    return ActivateJoint(agent_, name, group_);
  }

 private:
  const AgentPtr agent_;
  const GroupPtr group_;
};

}  // namespace

sba::Hardware_ptr ActivateHardware(AgentPtr agent, GroupPtr group) {
  return group->ActivateAs<sba::Hardware>(new HardwareServant(std::move(agent), group));
}

}  // namespace gsv::services
