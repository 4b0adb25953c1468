#include "gsv/services/simulation_servant.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include <malloc.h>

#include "gsv/base/log.h"
#include "gsv/health/health_tracker.h"
#include "gsv/orb/errors.h"
#include "gsv/orb/orb.h"
#include "gsv/services/conversions.h"
#include "gsv/services/remote_behaviour.h"
#include "gsv/simulation/commands/argument_reader.h"
#include "gsv/simulation/commands/command_table.h"

namespace gsv::services {
namespace {

constexpr double kAbandonedAfter = 60;  // default, s of wall-clock time
constexpr std::chrono::milliseconds kAwaitLease{2000};

using simulation::Phase;

simulation::Specification SpecificationOf(const sba::SimulationSpecification& in) {
  simulation::Specification out;
  out.name = in.name;
  out.mode = in.pacing == sba::LOCKSTEP ? simulation::Mode::kLockstep : simulation::Mode::kRealTime;
  out.factor = in.factor;
  out.step = base::SimTime(in.step_ns);
  out.seed = in.seed;
  out.duration = base::SimTime(in.duration_ns);
  out.keep = in.keep;
  const model::Parameters options = FromIdl(in.options);
  RefuseUnknown(options, {"abandoned_after_s", "deadline_s", "on_failure"});
  const std::string on_failure = model::TextOr(options, "on_failure", "go_on");
  if (on_failure != "go_on" && on_failure != "fail")
    throw sba::Refused("on_failure must be go_on or fail");
  if (on_failure == "fail") out.on_failure = simulation::FailurePolicy::kFail;
  const double deadline_s = model::NumberOr(options, "deadline_s", 10.0);
  if (!(deadline_s > 0 && deadline_s <= 86'400))
    throw sba::Refused("deadline_s must lie in (0, 86400]");
  out.deadline = std::chrono::milliseconds(static_cast<std::int64_t>(deadline_s * 1000));
  if (in.step_ns < 0 || in.duration_ns < 0)
    throw sba::Refused("step_ns and duration_ns must not be negative");
  return out;
}

sba::SimulationSpecification SpecificationOf(const simulation::Specification& in) {
  sba::SimulationSpecification out;
  out.name = in.name.c_str();
  out.world = in.world->source.c_str();
  out.pacing = in.mode == simulation::Mode::kLockstep ? sba::LOCKSTEP : sba::REAL_TIME;
  out.factor = in.factor;
  out.step_ns = in.step.count();
  out.seed = in.seed;
  out.duration_ns = in.duration.count();
  out.keep = in.keep;
  return out;
}

void Log(const std::string& simulation, const base::Problems& problems) {
  for (const base::Problem& problem : problems)
    spdlog::warn("{}: {}", simulation, problem.Sentence());
}

}  // namespace

SimulationServant::SimulationServant(std::shared_ptr<simulation::Simulation> simulation,
                                     SimulationServiceServant& service,
                                     sba::SimulationSpecification specification)
    : simulation_(std::move(simulation)),
      service_(service),
      specification_(std::move(specification)) {
  NoteContact();
  const double wanted =
      model::NumberOr(FromIdl(specification_.options), "abandoned_after_s", kAbandonedAfter);
  abandoned_after_ =
      std::chrono::milliseconds(static_cast<std::int64_t>(std::clamp(wanted, 1.0, 1e9) * 1000));
}

bool SimulationServant::IsAbandoned() const {
  return !simulation_->specification().keep &&
         std::chrono::steady_clock::now().time_since_epoch() - last_contact_.load() >
             abandoned_after_;
}

sba::SimulationSpecification* SimulationServant::specification() {
  NoteContact();
  return new sba::SimulationSpecification(specification_);
}

char* SimulationServant::add_robot(const sba::RobotSpecification& robot) {
  return CORBA::string_dup(Add(robot, false).c_str());
}

char* SimulationServant::add_avatar(const sba::RobotSpecification& avatar) {
  return CORBA::string_dup(Add(avatar, true).c_str());
}

std::string SimulationServant::Add(const sba::RobotSpecification& robot, bool is_avatar) {
  NoteContact();
  simulation::RobotSpecification out;
  out.name = robot.name;
  out.world_from_robot = FromIdl(robot.start);
  out.is_avatar = is_avatar;
  const model::Parameters options = FromIdl(robot.options);
  RefuseUnknown(options, {"allow_unmanaged", "on_ground"});
  out.on_ground = model::FlagOr(options, "on_ground", true);
  out.allow_unmanaged = model::FlagOr(options, "allow_unmanaged", false);
  base::Problems problems;
  out.model = orb::ValueOrThrow(service_.host().library().ReadModel(
      std::string(robot.model), problems, simulation_->specification().world->source));
  Log(simulation_->specification().name, problems);
  if (!CORBA::is_nil(robot.behaviour)) {
    out.behaviour = std::make_shared<RemoteBehaviour>(
        robot.behaviour, BehaviourIdentity{"given", orb::AddressOf(robot.behaviour), true},
        service_.poa(),
        service_.behaviours() != nullptr ? service_.behaviours()->stop_timeout() : nullptr);
  } else if (const std::string constraint(robot.behaviour_constraint); !constraint.empty()) {
    if (service_.behaviours() == nullptr)
      throw sba::Refused("this server has no broker to ask for behaviours");
    out.behaviour = orb::ValueOrThrow(service_.behaviours()->Get(constraint));
  }
  return orb::ValueOrThrow(simulation_->AddRobot(std::move(out)));
}

void SimulationServant::remove_robot(const char* name) {
  NoteContact();
  orb::ValueOrThrow(simulation_->RemoveRobot(name), orb::kRefused | orb::kEnded);
}

void SimulationServant::start() {
  NoteContact();
  orb::ValueOrThrow(simulation_->Start(), orb::kNotRunning | orb::kEnded);
}

void SimulationServant::pause() {
  NoteContact();
  orb::ValueOrThrow(simulation_->Pause(), orb::kNotRunning | orb::kEnded);
}

void SimulationServant::resume() {
  NoteContact();
  orb::ValueOrThrow(simulation_->Resume(), orb::kNotRunning | orb::kEnded);
}

void SimulationServant::step(CORBA::ULongLong count) {
  NoteContact();
  orb::ValueOrThrow(simulation_->Step(static_cast<std::int64_t>(
                        std::min<CORBA::ULongLong>(count, 1'000'000'001))),
                    orb::kRefused | orb::kNotRunning | orb::kEnded);
}

void SimulationServant::run_until(CORBA::LongLong instant) {
  NoteContact();
  orb::ValueOrThrow(simulation_->RunUntil(base::SimTime(instant)),
                    orb::kRefused | orb::kNotRunning | orb::kEnded);
}

void SimulationServant::set_factor(CORBA::Double factor) {
  NoteContact();
  orb::ValueOrThrow(simulation_->SetRealTimeFactor(factor), orb::kRefused | orb::kEnded);
}

void SimulationServant::stop() {
  NoteContact();
  orb::ValueOrThrow(simulation_->Stop(), orb::kEnded);
}

void SimulationServant::reset() {
  NoteContact();
  orb::ValueOrThrow(simulation_->Reset(), orb::kEnded | orb::kFailed);
}

sba::SimulationState* SimulationServant::state() {
  NoteContact();
  return new sba::SimulationState(ToIdl(simulation_->status()));
}

sba::RobotHealths* SimulationServant::health() {
  NoteContact();
  return new sba::RobotHealths(ToIdl(health::HealthNow(*simulation_)));
}

sba::OutputLines* SimulationServant::output(const char* robot) {
  NoteContact();
  return new sba::OutputLines(OutputToIdl(simulation_->outputs(0), robot));
}

sba::SimulationPhase SimulationServant::await_change(sba::SimulationPhase known) {
  NoteContact();
  std::vector<Phase> others;
  for (const Phase phase : {Phase::kCreated, Phase::kStarting, Phase::kRunning, Phase::kPaused,
                            Phase::kStopped, Phase::kFinished, Phase::kFailed}) {
    if (ToIdl(phase) != known) others.push_back(phase);
  }
  return ToIdl(simulation_->WaitForPhase(others, kAwaitLease));
}

char* SimulationServant::state_hash() {
  NoteContact();
  return CORBA::string_dup(simulation_->state_hash().c_str());
}

char* SimulationServant::viewer_url() {
  NoteContact();
  const auto& hook = service_.hooks().viewer_url;
  return CORBA::string_dup(hook ? hook(simulation_->specification().name).c_str() : "");
}

sba::CommandDescriptions* SimulationServant::commands() {
  NoteContact();
  const auto commands = simulation::Commands();
  auto* descriptions = new sba::CommandDescriptions;
  descriptions->length(static_cast<CORBA::ULong>(commands.size()));
  CORBA::ULong i = 0;
  for (const simulation::Command& command : commands) (*descriptions)[i++] = ToIdl(command);
  return descriptions;
}

void SimulationServant::command(const char* name, const sba::NameValues& arguments) {
  NoteContact();
  const simulation::Command* const command = simulation::FindCommand(name);
  if (command == nullptr) {
    throw sba::Refused(("there is no command '" + std::string(name).substr(0, 100) + "'").c_str());
  }
  const auto given = orb::ValueOrThrow(ReadArguments(*command, TextsOf(arguments)));
  orb::ValueOrThrow(command->apply(*simulation_, given));
}

void SimulationServant::start_recording(const char* path) {
  NoteContact();
  if (!service_.hooks().start_recording)
    throw sba::Refused("this server does not support recording");
  orb::ValueOrThrow(service_.hooks().start_recording(simulation_, path));
}

void SimulationServant::stop_recording() {
  NoteContact();
  if (!service_.hooks().stop_recording)
    throw sba::Refused("this server does not support recording");
  orb::ValueOrThrow(service_.hooks().stop_recording(simulation_->specification().name));
}

// Has no effect if the simulation was already destroyed.
void SimulationServant::destroy() { (void)service_.Destroy(simulation_->specification().name); }

SimulationServiceServant::SimulationServiceServant(PortableServer::POA_ptr poa,
                                                   SimulationHost& host,
                                                   BehaviourSource* behaviours, ServiceHooks hooks)
    : poa_(PortableServer::POA::_duplicate(poa)),
      host_(host),
      behaviours_(behaviours),
      hooks_(std::move(hooks)),
      janitor_([this] { RunJanitor(); }) {}

SimulationServiceServant::~SimulationServiceServant() {
  {
    const base::MutexLock lock(mutex_);
    closing_ = true;
  }
  closing_changed_.notify_all();
}

sba::Simulation_ptr SimulationServiceServant::create_simulation(
    const sba::SimulationSpecification& specification) {
  std::string world(specification.world);
  if (hooks_.find_world) {
    world = orb::ValueOrThrow(hooks_.find_world(world), orb::kRefused | orb::kFailed);
  }
  base::Problems problems;
  auto created = orb::ValueOrThrow(host_.Create(SpecificationOf(specification), world, problems),
                                   orb::kRefused | orb::kFailed);
  const std::string name = created->specification().name;
  Log(name, problems);
  sba::SimulationSpecification described(specification);
  described.name = name.c_str();
  described.world = world.c_str();
  described.step_ns = created->specification().step.count();
  return Activate(std::move(created), described);
}

sba::Simulation_ptr SimulationServiceServant::Activate(
    std::shared_ptr<simulation::Simulation> simulation,
    sba::SimulationSpecification specification) {
  const std::string name = simulation->specification().name;
  auto* servant = new SimulationServant(std::move(simulation), *this, std::move(specification));
  const PortableServer::ServantBase_var owned(servant);
  const PortableServer::ObjectId_var id = poa_->activate_object(servant);
  const base::MutexLock lock(mutex_);
  servants_[name] = servant;
  return servant->_this();
}

void SimulationServiceServant::Publish(std::shared_ptr<simulation::Simulation> simulation) {
  {
    const base::MutexLock lock(mutex_);
    if (servants_.contains(simulation->specification().name)) return;
  }
  auto specification = SpecificationOf(simulation->specification());
  const sba::Simulation_var reference = Activate(std::move(simulation), std::move(specification));
}

void SimulationServiceServant::Close() {
  std::map<std::string, SimulationServant*> servants;
  {
    const base::MutexLock lock(mutex_);
    servants.swap(servants_);
  }
  for (const auto& [name, servant] : servants) {
    const PortableServer::ObjectId_var id = poa_->servant_to_id(servant);
    poa_->deactivate_object(id);
  }
}

sba::Simulations* SimulationServiceServant::list() {
  const base::MutexLock lock(mutex_);
  auto* simulations = new sba::Simulations;
  simulations->length(static_cast<CORBA::ULong>(servants_.size()));
  CORBA::ULong i = 0;
  for (const auto& [name, servant] : servants_) (*simulations)[i++] = servant->_this();
  return simulations;
}

base::Status SimulationServiceServant::Destroy(const std::string& simulation) {
  // The thread that takes the servant out of the map also stops the simulation and deactivates the
  // servant. Other threads that call this function at the same time get kNotFound.
  SimulationServant* servant = nullptr;
  {
    const base::MutexLock lock(mutex_);
    const auto found = servants_.extract(simulation);
    if (found.empty()) {
      return base::Fail(base::ErrorCode::kNotFound, "there is no simulation of this name",
                        simulation);
    }
    servant = found.mapped();
  }
  (void)servant->simulation()->Stop();
  (void)host_.Remove(simulation);
  const PortableServer::ObjectId_var id = poa_->servant_to_id(servant);
  poa_->deactivate_object(id);
  const base::MutexLock lock(mutex_);
  has_destroyed_ = true;
  return {};
}

void SimulationServiceServant::RunJanitor() {
  constexpr int kTrimmingRounds = 30;
  int round = 0;
  base::MutexLock lock(mutex_);
  while (!closing_) {
    closing_changed_.wait_for(lock, std::chrono::seconds(1),
                              [this]() GSV_REQUIRES(mutex_) { return closing_; });
    std::vector<std::shared_ptr<simulation::Simulation>> abandoned;
    for (const auto& [name, servant] : servants_) {
      if (servant->IsAbandoned()) abandoned.push_back(servant->simulation());
    }
    const bool may_trim = std::exchange(has_destroyed_, false) || ++round % kTrimmingRounds == 0;
    // Stopping may take a long time, for example during a reset. The lock is released, so that
    // other threads need not wait for it.
    lock.unlock();
    // Memory that simulations, viewers and messages have freed is in the arenas of many threads.
    // Without this call, glibc returns only the ends of the arenas to the system.
    if (may_trim) malloc_trim(0);
    for (const auto& simulation : abandoned) {
      const Phase phase = simulation->status().phase;
      if (phase == Phase::kStopped || phase == Phase::kFinished || phase == Phase::kFailed)
        continue;
      spdlog::warn("{}: stopped, because no client has called it for too long",
                   simulation->specification().name);
      (void)simulation->Stop();
    }
    abandoned.clear();
    lock.lock();
  }
}

}  // namespace gsv::services
