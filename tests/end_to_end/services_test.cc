// Tests the services from the view of an application: the real server runs in its own process, and
// this process has stubs of the IDL.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/broker/client/broker_client.h"
#include "gsv/broker/client/gsv_service_types.h"
#include "idl/simulation.hh"
#include "sdk/application.h"
#include "tests/end_to_end/served.h"
#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;

// A simulation that is destroyed with this object, so that it does not outlive a failed test.
class OwnSimulation {
 public:
  explicit OwnSimulation(sba::Simulation_ptr simulation) : simulation_(simulation) {}
  ~OwnSimulation() {
    try {
      simulation_->destroy();
    } catch (const CORBA::Exception&) {  // the simulation has ended already
    }
  }
  OwnSimulation(const OwnSimulation&) = delete;
  OwnSimulation& operator=(const OwnSimulation&) = delete;

  sba::Simulation_ptr operator->() const { return simulation_.in(); }
  operator sba::Simulation_ptr() const {  // NOLINT(google-explicit-constructor): as a _var does
    return simulation_.in();
  }

 private:
  const sba::Simulation_var simulation_;
};

// One broker, one server and one behaviour program serve all tests of this file.
class Services : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    broker_ = new BrokerProcess;
    server_ = new Running("gsv", {"serve", "--broker", broker_->reference(), "--port", "0"});
    server_->AwaitLine("broker: ");
    wander_ = new Running("gsv-wander", {"--broker", broker_->reference()});
    wander_->AwaitLine("offered at");
    auto orb = StartOrbWithLongTimeout();
    ASSERT_TRUE(orb);
    orb_ = *orb;
    auto client = broker::BrokerClient::Connect(orb_, broker_->reference());
    ASSERT_TRUE(client) << client.error().Sentence();
    const auto offers =
        client->Query(broker::SimulationServiceType().name, "cores >= 1", "first", 1);
    ASSERT_TRUE(offers && offers->size() == 1);
    service_ = sba::SimulationService::_narrow(offers->front().object);
    const auto behaviours =
        client->Query(broker::AgentBehaviourFactoryType().name, "name == 'wander'", "first", 1);
    ASSERT_TRUE(behaviours && behaviours->size() == 1);
    factory_ = sba::AgentBehaviourFactory::_narrow(behaviours->front().object);
  }
  static void TearDownTestSuite() {
    service_ = sba::SimulationService::_nil();
    factory_ = sba::AgentBehaviourFactory::_nil();
    orb_->destroy();
    delete wander_;
    delete server_;
    delete broker_;
  }

  static sba::SimulationSpecification Playground() {
    sba::SimulationSpecification specification;
    specification.world = "playground";
    specification.pacing = sba::LOCKSTEP;
    specification.factor = 1;
    specification.step_ns = 0;
    specification.seed = 1;
    specification.duration_ns = 0;
    specification.keep = false;
    return specification;
  }
  static sba::RobotSpecification Pebble(double x, double y, const char* constraint = "") {
    sba::RobotSpecification robot;
    robot.model = "pebble";
    robot.start = {x, y, 0, 0, 0, 0};
    robot.behaviour_constraint = constraint;
    return robot;
  }
  static sba::SimulationPhase Await(sba::Simulation_ptr simulation, sba::SimulationPhase wanted) {
    const auto give_up = std::chrono::steady_clock::now() + kProgramTimeout;
    sba::SimulationPhase phase = sba::SimulationState_var(simulation->state())->phase;
    while (phase != wanted && std::chrono::steady_clock::now() < give_up)
      phase = simulation->await_change(phase);
    return phase;
  }
  static sba::SimulationPhase RunTo(sba::Simulation_ptr simulation, double seconds) {
    simulation->run_until(static_cast<CORBA::LongLong>(seconds * 1e9));
    return Await(simulation, sba::PHASE_PAUSED);
  }

  static inline BrokerProcess* broker_;
  static inline Running* server_;
  static inline Running* wander_;
  static inline CORBA::ORB_var orb_;
  static inline sba::SimulationService_var service_;
  static inline sba::AgentBehaviourFactory_var factory_;
};

using SimulationService = Services;
using AgentBehaviour = Services;

template <typename Exception, typename Call>
std::string ReasonOf(Call call) {
  try {
    call();
  } catch (const Exception& exception) {
    return std::string(exception.reason);
  } catch (const CORBA::Exception& exception) {
    return std::string("raised ") + exception._name();
  }
  return "raised nothing";
}

TEST_F(SimulationService, CreatesASimulationOfAWorld) {
  const OwnSimulation simulation(service_->create_simulation(Playground()));
  const sba::SimulationState_var state = simulation->state();
  EXPECT_EQ(state->phase, sba::PHASE_CREATED);
  EXPECT_EQ(state->time_ns, 0);
  EXPECT_EQ(state->robots.length(), 0u);
  const CORBA::String_var url = simulation->viewer_url();
  EXPECT_THAT(std::string(url), HasSubstr("http://127.0.0.1:"));
  const sba::Simulations_var all = service_->list();
  EXPECT_EQ(all->length(), 1u);
}

TEST_F(SimulationService, DescribesItsCommandsAndAppliesThemByName) {
  sba::Simulation_var simulation = service_->create_simulation(Playground());
  sba::CommandDescriptions_var commands = simulation->commands();
  const sba::CommandDescription* gravity = nullptr;
  for (CORBA::ULong i = 0; i < commands->length(); ++i) {
    if (std::string(commands[i].name) == "set_gravity") gravity = &commands[i];
  }
  ASSERT_NE(gravity, nullptr);
  ASSERT_EQ(gravity->parameters.length(), 1u);
  EXPECT_STREQ(gravity->parameters[0].name, "z");
  EXPECT_EQ(gravity->parameters[0].type, sba::COMMAND_NUMBER);
  EXPECT_EQ(gravity->parameters[0].minimum, -100);
  EXPECT_FALSE(gravity->parameters[0].required);
  sba::NameValues arguments;
  arguments.length(1);
  arguments[0].name = "z";
  arguments[0].value = "-1.62";
  const std::string before = CORBA::String_var(simulation->state_hash()).in();
  simulation->command("set_gravity", arguments);
  EXPECT_NE(CORBA::String_var(simulation->state_hash()).in(), before);
  arguments[0].value = "down";
  EXPECT_THAT(ReasonOf<sba::Refused>([&] { simulation->command("set_gravity", arguments); }),
              HasSubstr("'z' must be a number from -100 to 100"));
  arguments.length(0);
  EXPECT_EQ(ReasonOf<sba::Refused>([&] { simulation->command("explode", arguments); }),
            "there is no command 'explode'");
  EXPECT_THAT(ReasonOf<sba::NotRunning>([&] { simulation->command("pause", arguments); }),
              HasSubstr("to pause it must be"));
  simulation->destroy();
}

TEST_F(SimulationService, ParametersTakeEffect) {
  sba::SimulationSpecification specification = Playground();
  specification.name = "parameters";
  specification.step_ns = 20'000'000;
  specification.duration_ns = 100'000'000;
  specification.seed = 42;
  const OwnSimulation simulation(service_->create_simulation(specification));
  simulation->start();
  ASSERT_EQ(Await(simulation, sba::PHASE_FINISHED), sba::PHASE_FINISHED);
  const sba::SimulationState_var state = simulation->state();
  EXPECT_STREQ(state->name, "parameters");
  EXPECT_EQ(state->step, 5u);
  EXPECT_EQ(state->pacing, sba::LOCKSTEP);
  EXPECT_EQ(sba::SimulationSpecification_var(simulation->specification())->seed, 42u);
}

TEST_F(SimulationService, AddsAndRemovesRobots) {
  const OwnSimulation simulation(service_->create_simulation(Playground()));
  const sba::AgentBehaviour_var behaviour = factory_->create();
  sba::RobotSpecification by_reference = Pebble(-1, 0);
  by_reference.name = "mine";
  by_reference.behaviour = behaviour;
  EXPECT_STREQ(CORBA::String_var(simulation->add_robot(by_reference)), "mine");
  EXPECT_STREQ(CORBA::String_var(simulation->add_robot(Pebble(0, 0, "name == 'wander'"))),
               "pebble");
  EXPECT_STREQ(CORBA::String_var(simulation->add_robot(Pebble(1, 0))), "pebble_2");
  simulation->remove_robot("pebble_2");
  EXPECT_EQ(sba::SimulationState_var(simulation->state())->robots.length(), 2u);
  ASSERT_EQ(RunTo(simulation, 2.0), sba::PHASE_PAUSED);
  const sba::SimulationState_var state = simulation->state();
  for (CORBA::ULong i = 0; i < 2; ++i) EXPECT_GT(state->robots[i].distance_m, 0.1);
}

TEST_F(SimulationService, RejectsAnInvalidWorldWithItsPlace) {
  sba::SimulationSpecification specification = Playground();
  specification.world = "/nowhere/to.sdf";
  EXPECT_THAT(ReasonOf<sba::Refused>([&] { service_->create_simulation(specification); }),
              HasSubstr("/nowhere/to.sdf"));
}

TEST_F(SimulationService, SimulationsAreIndependent) {
  const OwnSimulation first(service_->create_simulation(Playground()));
  const OwnSimulation second(service_->create_simulation(Playground()));
  ASSERT_EQ(RunTo(first, 0.5), sba::PHASE_PAUSED);
  EXPECT_EQ(sba::SimulationState_var(second->state())->time_ns, 0);
  ASSERT_EQ(RunTo(second, 0.25), sba::PHASE_PAUSED);
  EXPECT_EQ(sba::SimulationState_var(first->state())->time_ns, 500'000'000);
  first->destroy();
  EXPECT_EQ(sba::SimulationState_var(second->state())->time_ns, 250'000'000);
}

TEST_F(SimulationService, CallsChangeTheLifeCycle) {
  const OwnSimulation simulation(service_->create_simulation(Playground()));
  const CORBA::String_var robot = simulation->add_robot(Pebble(0, 0, "name == 'wander'"));
  simulation->start();
  ASSERT_EQ(Await(simulation, sba::PHASE_RUNNING), sba::PHASE_RUNNING);
  simulation->pause();
  ASSERT_EQ(Await(simulation, sba::PHASE_PAUSED), sba::PHASE_PAUSED);
  const auto paused_at = sba::SimulationState_var(simulation->state())->step;
  simulation->step(5);
  const auto give_up = std::chrono::steady_clock::now() + kProgramTimeout;
  while (sba::SimulationState_var(simulation->state())->step < paused_at + 5 &&
         std::chrono::steady_clock::now() < give_up) {
  }
  ASSERT_EQ(Await(simulation, sba::PHASE_PAUSED), sba::PHASE_PAUSED);
  EXPECT_EQ(sba::SimulationState_var(simulation->state())->step, paused_at + 5);
  simulation->resume();
  simulation->stop();
  ASSERT_EQ(Await(simulation, sba::PHASE_STOPPED), sba::PHASE_STOPPED);
  EXPECT_THAT(ReasonOf<sba::NotRunning>([&] { simulation->start(); }), HasSubstr("stopped"));
  simulation->reset();
  EXPECT_EQ(sba::SimulationState_var(simulation->state())->time_ns, 0);
}

TEST_F(SimulationService, DestroyEndsTheSimulation) {
  const OwnSimulation simulation(service_->create_simulation(Playground()));
  simulation->destroy();
  EXPECT_THROW(sba::SimulationState_var(simulation->state()), CORBA::OBJECT_NOT_EXIST);
  EXPECT_EQ(sba::Simulations_var(service_->list())->length(), 0u);
}

TEST_F(SimulationService, ReportsStateTimeAndResults) {
  std::vector<std::string> hashes;
  for (int run = 0; run < 2; ++run) {
    const OwnSimulation simulation(service_->create_simulation(Playground()));
    const CORBA::String_var robot = simulation->add_robot(Pebble(0, 0, "name == 'wander'"));
    ASSERT_EQ(RunTo(simulation, 1.0), sba::PHASE_PAUSED);
    const sba::SimulationState_var state = simulation->state();
    EXPECT_EQ(state->time_ns, 1'000'000'000);
    EXPECT_EQ(state->robots[0].phase, sba::AGENT_WAITING);
    EXPECT_STREQ(state->robots[0].behaviour, "wander");
    hashes.emplace_back(CORBA::String_var(simulation->state_hash()));
  }
  EXPECT_EQ(hashes[0], hashes[1]);
}

TEST_F(SimulationService, BadArgumentsRaiseDeclaredExceptions) {
  sba::SimulationSpecification bad_step = Playground();
  bad_step.step_ns = -1;
  EXPECT_THAT(ReasonOf<sba::Refused>([&] { service_->create_simulation(bad_step); }),
              HasSubstr("step_ns"));
  const OwnSimulation simulation(service_->create_simulation(Playground()));
  sba::RobotSpecification unknown = Pebble(0, 0);
  unknown.model = "unicorn";
  EXPECT_THAT(ReasonOf<sba::Refused>([&] { simulation->add_robot(unknown); }),
              HasSubstr("unicorn"));
  EXPECT_THAT(
      ReasonOf<sba::Failed>([&] { simulation->add_robot(Pebble(0, 0, "name == 'nobody'")); }),
      HasSubstr("nobody"));
  EXPECT_THAT(ReasonOf<sba::Refused>([&] { simulation->add_robot(Pebble(0, 0, "name ==")); }),
              HasSubstr("name =="));
  EXPECT_THAT(ReasonOf<sba::Refused>([&] { simulation->remove_robot("nobody"); }),
              HasSubstr("nobody"));
  EXPECT_THAT(ReasonOf<sba::Refused>([&] { simulation->step(0); }), HasSubstr("steps"));
  EXPECT_THAT(ReasonOf<sba::NotRunning>([&] { simulation->resume(); }), HasSubstr("paused"));
}

TEST_F(AgentBehaviour, OneProgramServesSeveralRobots) {
  const OwnSimulation simulation(service_->create_simulation(Playground()));
  for (const double x : {-1.2, 0.0, 1.2})
    CORBA::String_var(simulation->add_robot(Pebble(x, 0, "name == 'wander'")));
  ASSERT_EQ(RunTo(simulation, 1.0), sba::PHASE_PAUSED);
  const sba::SimulationState_var state = simulation->state();
  ASSERT_EQ(state->robots.length(), 3u);
  for (CORBA::ULong i = 0; i < 3; ++i) EXPECT_EQ(state->robots[i].phase, sba::AGENT_WAITING);
}

TEST_F(AgentBehaviour, StopWakesAWaitingBehaviour) {
  const OwnSimulation simulation(service_->create_simulation(Playground()));
  const CORBA::String_var robot = simulation->add_robot(Pebble(0, 0, "name == 'wander'"));
  ASSERT_EQ(RunTo(simulation, 0.5), sba::PHASE_PAUSED);
  simulation->stop();
  // The request has ended the behaviour's wait, so its thread has returned. The same behaviour can
  // run again.
  simulation->reset();
  EXPECT_EQ(RunTo(simulation, 0.5), sba::PHASE_PAUSED);
}

// The following tests call the same services through the SDK.
TEST_F(Services, ApplicationNeedsNoCorbaCode) {
  // This program uses only the SDK.
  EXPECT_EQ(RunProgram("example-test-wandering",
                       {"--broker", broker_->reference(), "--world", "playground", "--places", "-1",
                        "0", "1", "0", "--seconds", "10"})
                .ending,
            "exit code 0");
}

TEST_F(Services, ApplicationFailsIfNoRobotMovesFarEnough) {
  const Outcome outcome = RunProgram("example-test-wandering",
                                     {"--broker", broker_->reference(), "--world", "playground",
                                      "--places", "-1", "0", "--seconds", "0.1"});
  EXPECT_EQ(outcome.ending, "exit code 1");
  EXPECT_THAT(outcome.out, HasSubstr("verdict: failed"));
}

TEST_F(Services, ExampleBehaviourDrivesARobot) {
  Running first("gsv-first", {"--broker", broker_->reference()});
  first.AwaitLine("offered at");
  const Outcome outcome = RunProgram(
      "gsv", {"run", "playground", "--broker", broker_->reference(), "--robot", "pebble@0,0",
              "--behaviour", "first", "--lockstep", "--duration", "5", "--headless", "--json"});
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
  EXPECT_GT(outcome.LastLine()["robots"][0]["distance_m"], 0.5);
}

TEST_F(SimulationService, EndsAfterItsCreatorDisconnects) {
  sba::SimulationSpecification specification = Playground();
  specification.options.length(1);
  specification.options[0].name = "abandoned_after_s";
  specification.options[0].value = "1";
  const OwnSimulation simulation(service_->create_simulation(specification));
  simulation->start();
  // A connected viewer does not keep the simulation alive, because it is not the creator.
  const CORBA::String_var viewer(simulation->viewer_url());
  const std::string url =
      std::string(viewer).substr(0, std::string(viewer).find('?')) + "api/simulations";
  const auto give_up = std::chrono::steady_clock::now() + kProgramTimeout;
  std::string seen;
  while (seen.find("\"stopped\"") == std::string::npos &&
         std::chrono::steady_clock::now() < give_up) {
    seen = HttpGet(url);
  }
  EXPECT_THAT(seen, HasSubstr("\"stopped\""));
}

TEST_F(Services, BehaviourDrivesHardwareWithoutASimulation) {
  const Outcome outcome = RunProgram("example-real-robot", {"--broker", broker_->reference()});
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.out << outcome.err;
}

}  // namespace
}  // namespace gsv::testing
