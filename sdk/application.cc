#include "sdk/application.h"

#include <cstdio>

#include "gsv/broker/client/broker_client.h"
#include "gsv/broker/client/gsv_service_types.h"
#include "gsv/orb/errors.h"
#include "gsv/orb/orb.h"
#include "idl/simulation.hh"
#include "sdk/behaviour_servant.h"
#include "sdk/shared_orb.h"

namespace gsv {
namespace {

// Time limit for creating a simulation: reading a world and initialising behaviours may take long.
constexpr std::chrono::milliseconds kCreateTimeout{120'000};
// Time limit for a wait. The server answers a wait after at most two seconds, even if the phase has
// not changed. So a server that does not answer for this long is lost.
constexpr std::chrono::milliseconds kWaitTimeout{10'000};
constexpr std::chrono::seconds kServerTimeout{30};
constexpr int kConnectionsTried = 16;

const char* Text(sba::SimulationPhase phase) {
  switch (phase) {
    case sba::PHASE_CREATED:
      return "created";
    case sba::PHASE_STARTING:
      return "starting";
    case sba::PHASE_RUNNING:
      return "running";
    case sba::PHASE_PAUSED:
      return "paused";
    case sba::PHASE_STOPPED:
      return "stopped";
    case sba::PHASE_FINISHED:
      return "finished";
    case sba::PHASE_FAILED:
      return "failed";
  }
  return "";
}

const char* Text(sba::AgentPhase phase) {
  switch (phase) {
    case sba::AGENT_NONE:
      return "none";
    case sba::AGENT_INITIALISED:
      return "initialised";
    case sba::AGENT_RUNNING:
      return "running";
    case sba::AGENT_WAITING:
      return "waiting";
    case sba::AGENT_FINISHED:
      return "finished";
    case sba::AGENT_UNRESPONSIVE:
      return "unresponsive";
    case sba::AGENT_DEAD:
      return "dead";
  }
  return "";
}

SimulationState FromIdl(const sba::SimulationState& in) {
  SimulationState out;
  out.phase = Text(in.phase);
  out.time = SimTime(in.time_ns);
  out.real_time_factor = in.real_time_factor;
  out.late_steps = in.late_steps;
  out.waiting_for = in.waiting_for;
  out.failure = in.failure;
  for (CORBA::ULong i = 0; i < in.robots.length(); ++i) {
    const sba::RobotState& robot = in.robots[i];
    const sba::Placement& p = robot.place;
    out.robots.push_back({std::string(robot.name),
                          std::string(robot.model),
                          std::string(robot.behaviour),
                          Text(robot.phase),
                          {p.x_m, p.y_m, p.z_m, p.roll_rad, p.pitch_rad, p.yaw_rad},
                          robot.distance_m,
                          robot.collisions});
  }
  return out;
}

std::string Quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') quoted += '\\';
    quoted += c;
  }
  return quoted + "'";
}

sba::NameValues ToIdl(const std::map<std::string, std::string>& options) {
  sba::NameValues idl;
  idl.length(static_cast<CORBA::ULong>(options.size()));
  CORBA::ULong i = 0;
  for (const auto& [name, value] : options) {
    idl[i].name = name.c_str();
    idl[i++].value = value.c_str();
  }
  return idl;
}

class SimulationProxy final : public RemoteSimulation {
 public:
  SimulationProxy(std::shared_ptr<sdk::SharedOrb> orb, sba::Simulation_ptr simulation,
                  std::string server)
      : orb_(std::move(orb)),
        simulation_(sba::Simulation::_duplicate(simulation)),
        server_(std::move(server)) {
    orb::LimitCalls(simulation_, kCreateTimeout);
    // An object reference has one time limit for all its calls. So waits use a second reference to
    // the simulation, with another limit.
    const CORBA::String_var text = orb_->orb()->object_to_string(simulation);
    const CORBA::Object_var object = orb_->orb()->string_to_object(text);
    waiting_ = sba::Simulation::_unchecked_narrow(object);
    orb::LimitCalls(waiting_, kWaitTimeout);
  }
  ~SimulationProxy() override {
    // The call may fail, because the server may have ended.
    (void)Ask([this] { simulation_->destroy(); });
  }

  base::Result<std::string> AddRobot(const RobotRequest& request) override {
    sba::RobotSpecification robot;
    robot.name = request.name.c_str();
    robot.model = request.model.c_str();
    robot.start = {request.x, request.y, 0, 0, 0, request.yaw};
    const std::string constraint =
        request.behaviour.empty() ? "" : "name == " + Quoted(request.behaviour);
    robot.behaviour_constraint = constraint.c_str();
    if (request.own_behaviour) {
      const PortableServer::POA_var poa = orb::RootPoa(orb_->orb());
      robot.behaviour = sdk::NewBehaviour(poa, request.own_behaviour);
    }
    auto added = Ask([&] {
      const CORBA::String_var name = simulation_->add_robot(robot);
      return std::string(name);
    });
    if (!added && request.own_behaviour) {
      // The simulator may already have destroyed the behaviour, so this call may fail.
      (void)Ask([&] { robot.behaviour->destroy(); });
    }
    return added;
  }
  base::Status RemoveRobot(const std::string& name) override {
    return Ask([&] { simulation_->remove_robot(name.c_str()); });
  }

  base::Status Start() override {
    return Ask([this] { simulation_->start(); });
  }
  base::Status Pause() override {
    return Ask([this] { simulation_->pause(); });
  }
  base::Status Resume() override {
    return Ask([this] { simulation_->resume(); });
  }
  base::Status Stop() override {
    return Ask([this] { simulation_->stop(); });
  }

  base::Status Reset() override {
    return Ask([this] { simulation_->reset(); });
  }

  base::Status SetRealTimeFactor(double factor) override {
    return Ask([this, factor] { simulation_->set_factor(factor); });
  }

  base::Status Command(const std::string& name,
                       const std::map<std::string, std::string>& arguments) override {
    return Ask([&] { simulation_->command(name.c_str(), ToIdl(arguments)); });
  }

  base::Status RunUntil(SimTime until, std::chrono::seconds timeout,
                        const std::function<bool()>& keep_waiting) override {
    const auto give_up = std::chrono::steady_clock::now() + timeout;
    if (auto ok = Ask([&] { simulation_->run_until(until.count()); }); !ok) return ok;
    auto heard = std::chrono::steady_clock::now();
    auto phase = sba::PHASE_STARTING;
    while (phase == sba::PHASE_STARTING || phase == sba::PHASE_RUNNING) {
      if (std::chrono::steady_clock::now() > give_up) {
        return base::Fail(base::ErrorCode::kTimeout,
                          "the simulation did not reach this time before the timeout", server_);
      }
      if (keep_waiting && !keep_waiting()) {
        return base::Fail(base::ErrorCode::kEnded, "the wait was interrupted", server_);
      }
      const auto known = phase;
      auto next = Ask([&] { return waiting_->await_change(known); });
      const auto now = std::chrono::steady_clock::now();
      if (next) {
        phase = *next;
        heard = now;
      } else if (next.error().code != base::ErrorCode::kTimeout || !lost_.empty()) {
        return base::Fail(next.error());
      } else if (now - heard > kServerTimeout) {
        return Lose("it has not responded for too long");
      }
    }
    auto state = State();
    if (phase == sba::PHASE_PAUSED || phase == sba::PHASE_FINISHED) {
      if (!state) return base::Fail(state.error());
      if (state->time >= until) return {};
      char times[80];
      std::snprintf(times, sizeof times, "at %g s, before %g s", base::ToSeconds(state->time),
                    base::ToSeconds(until));
      return base::Fail(base::ErrorCode::kEnded,
                        std::string("the simulation is ") + Text(phase) + " " + times, server_);
    }
    return base::Fail(base::ErrorCode::kEnded,
                      std::string("the simulation is ") + Text(phase) +
                          (state && !state->failure.empty() ? ": " + state->failure : ""),
                      server_);
  }

  base::Result<SimulationState> State() override {
    auto state = Ask([this] {
      const sba::SimulationState_var answer = simulation_->state();
      return FromIdl(answer.in());
    });
    if (state) known_ = *state;
    if (lost_.empty()) return state;
    known_.phase = "lost";
    known_.failure = lost_;
    return known_;
  }

  base::Result<std::string> StateHash() override {
    return Ask([this] {
      const CORBA::String_var hash = simulation_->state_hash();
      return std::string(hash);
    });
  }

  base::Result<std::string> ViewerUrl() override {
    return Ask([this] {
      const CORBA::String_var url = simulation_->viewer_url();
      return std::string(url);
    });
  }

  base::Status StartRecording(const std::string& path) override {
    return Ask([&] { simulation_->start_recording(path.c_str()); });
  }
  base::Status StopRecording() override {
    return Ask([this] { simulation_->stop_recording(); });
  }

 private:
  // Calls the server, unless it is lost.
  template <typename Question>
  auto Ask(Question question) -> base::Result<decltype(question())> {
    if (!lost_.empty()) return base::Fail(base::ErrorCode::kUnavailable, lost_, server_);
    auto answer = orb::Call(server_, question);
    const bool is_doubtful = !answer && answer.error().code == base::ErrorCode::kUnavailable;
    if (is_doubtful && IsServerGone())
      return Lose("no program accepts connections at this address any more");
    return answer;
  }
  // Whether the server refuses connections. One failed call does not prove that the server has
  // ended, because the ORB may have several open connections, and each of them may be broken.
  bool IsServerGone() {
    for (int i = 0; i < kConnectionsTried; ++i) {
      try {
        (void)waiting_->_non_existent();
        return false;
      } catch (const CORBA::COMM_FAILURE&) {
      } catch (const CORBA::TRANSIENT& exception) {
        if (orb::MeansGone(exception)) return true;
      } catch (const CORBA::SystemException&) {
        return false;
      }
    }
    return false;
  }
  base::Failure<base::Error> Lose(const std::string& why) {
    lost_ = "the simulation ended with its server: " + why;
    return base::Fail(base::ErrorCode::kUnavailable, lost_, server_);
  }

  const std::shared_ptr<sdk::SharedOrb> orb_;
  sba::Simulation_var simulation_, waiting_;
  const std::string server_;
  std::string lost_;       // the reason why the server is lost; empty if it is not lost
  SimulationState known_;  // the last known state
};

class BrokerApplication final : public Application {
 public:
  BrokerApplication(std::shared_ptr<sdk::SharedOrb> orb, broker::BrokerClient broker)
      : orb_(std::move(orb)), broker_(std::move(broker)) {}

  base::Result<std::unique_ptr<RemoteSimulation>> Create(const SimulationRequest& request,
                                                         const std::string& constraint,
                                                         const std::string& preference) override {
    auto offers = broker_.Query(broker::SimulationServiceType().name, constraint, preference, 16);
    // kNotFound means that the broker does not know the service type, because no simulator has ever
    // registered with it. So there are no offers.
    if (!offers && offers.error().code == base::ErrorCode::kNotFound)
      offers = std::vector<broker::FoundOffer>();
    if (!offers) return base::Fail(offers.error());
    base::Error error{
        base::ErrorCode::kNotFound,
        "no simulator is available at the broker" +
            (constraint.empty() ? "" : " that matches the constraint: " + constraint) +
            "; start one with gsv serve --broker " + broker_.reference(),
        broker_.reference()};
    for (const broker::FoundOffer& offer : *offers) {
      auto created = CreateAt(offer.object, request);
      if (created || created.error().code == base::ErrorCode::kInvalidArgument) return created;
      error = created.error();  // the server may have ended, so the next server is tried
    }
    return base::Fail(std::move(error));
  }

 private:
  base::Result<std::unique_ptr<RemoteSimulation>> CreateAt(CORBA::Object_ptr object,
                                                           const SimulationRequest& request) {
    const std::string server = "simulator at " + orb::AddressOf(object);
    orb::LimitCalls(object, kCreateTimeout);
    return orb::Call(server, [&]() -> std::unique_ptr<RemoteSimulation> {
      const sba::SimulationService_var service = sba::SimulationService::_narrow(object);
      if (CORBA::is_nil(service)) throw sba::Failed("the offer is not a SimulationService");
      sba::SimulationSpecification specification;
      specification.name = request.name.c_str();
      specification.world = request.world.c_str();
      specification.pacing = request.lockstep ? sba::LOCKSTEP : sba::REAL_TIME;
      specification.factor = request.factor;
      specification.step_ns = request.step.count();
      specification.seed = request.seed;
      specification.duration_ns = 0;
      specification.keep = false;
      specification.options = ToIdl(request.options);
      const sba::Simulation_var simulation = service->create_simulation(specification);
      return std::make_unique<SimulationProxy>(orb_, simulation, server);
    });
  }

  const std::shared_ptr<sdk::SharedOrb> orb_;
  broker::BrokerClient broker_;
};

}  // namespace

base::Result<std::unique_ptr<Application>> Application::Connect(const std::string& broker) {
  auto orb = sdk::SharedOrb::Towards(broker);
  if (!orb) return base::Fail(orb.error());
  auto client = broker::BrokerClient::Connect((*orb)->orb(), broker);
  if (!client) return base::Fail(client.error());
  return std::make_unique<BrokerApplication>(*std::move(orb), *std::move(client));
}

}  // namespace gsv
