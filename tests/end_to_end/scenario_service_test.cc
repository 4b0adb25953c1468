// Tests sba::ScenarioService from the view of its clients, and the refusals of servers.
#include <gmock/gmock.h>

#include "gsv/broker/client/broker_client.h"
#include "gsv/broker/client/gsv_service_types.h"
#include "idl/scenario.hh"
#include "tests/end_to_end/served.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;

constexpr const char* kStands =
    "world: playground\nduration: 1\nrobots: [{name: r, model: pebble, x: 0, y: 0}]\n"
    "expect: [{stays_within: {robot: r, x: [-1, 1]}}]\n";
constexpr const char* kLasts =
    "world: playground\nduration: 1000000\nrobots: [{name: r, model: pebble, x: 0, y: 0}]\n";

class ScenarioService : public Served {
 protected:
  ScenarioService() {
    scenarios_.AwaitLine("broker: ");
    auto client = broker::BrokerClient::Connect(orb_, broker_.reference());
    const auto offers = client->Query(broker::ScenarioServiceType().name, "slots == 1", "first", 1);
    there_ = sba::ScenarioService::_narrow(offers->front().object);
  }
  // Returns the reason for a refusal.
  std::string Refusal(const char* scenario, const sba::NameValues& options = {}) {
    try {
      const sba::ScenarioRun_var run = there_->run(scenario, options);
    } catch (const sba::Refused& refused) {
      return refused.reason.in();
    }
    return "nothing is refused";
  }
  static sba::NameValues Option(const char* name, const char* value) {
    sba::NameValues options;
    options.length(1);
    options[0].name = name;
    options[0].value = value;
    return options;
  }

  Running scenarios_{"gsv",
                     {"serve", "--broker", broker_.reference(), "--headless", "--scenarios", "1"}};
  sba::ScenarioService_var there_;
};

TEST_F(ScenarioService, RunsAndEvaluatesAScenario) {
  const sba::ScenarioRun_var run = there_->run(kStands, {});
  ASSERT_FALSE(CORBA::is_nil(run));
  while (!run->await_end()) {
  }
  const sba::ScenarioOutcome_var outcome = run->outcome();
  EXPECT_STREQ(outcome->status, "passed") << outcome->message;
  const auto report = nlohmann::json::parse(outcome->report.in());
  EXPECT_EQ(report["sim_time_s"], 1.0);
  EXPECT_FALSE(report["state_hash"].get<std::string>().empty());
  run->destroy();
  EXPECT_THROW(run->await_end(), CORBA::OBJECT_NOT_EXIST);
}

TEST_F(ScenarioService, RefusesScenariosBeyondItsSlots) {
  const sba::ScenarioRun_var run = there_->run(kLasts, {});
  ASSERT_FALSE(CORBA::is_nil(run));
  EXPECT_THROW(sba::ScenarioOutcome_var(run->outcome()), sba::NotRunning);
  const sba::ScenarioRun_var none = there_->run(kStands, {});
  EXPECT_TRUE(CORBA::is_nil(none));
  run->destroy();
  sba::ScenarioRun_var next;
  while (CORBA::is_nil(next)) next = there_->run(kStands, {});
}

TEST_F(ScenarioService, EndsAScenarioWithoutAClient) {
  const sba::ScenarioRun_var run = there_->run(kLasts, Option("abandoned_after_s", "1"));
  ASSERT_FALSE(CORBA::is_nil(run));
  sba::ScenarioRun_var next;
  while (CORBA::is_nil(next)) next = there_->run(kStands, {});
  EXPECT_THROW(run->await_end(), CORBA::OBJECT_NOT_EXIST);
}

TEST_F(ScenarioService, RejectsScenariosThatItMustNotRun) {
  EXPECT_THAT(Refusal("- 1\n"), HasSubstr("scenario"));
  EXPECT_THAT(Refusal("world: playground\n"), HasSubstr("the scenario needs an end: set duration"));
  EXPECT_THAT(Refusal("world: playground\nduration: 1\nwolrd: 2\n"), HasSubstr("\"wolrd\""));
  EXPECT_THAT(Refusal("world: playground\nduration: 1\nrecord: /tmp/x.mcap\n"),
              HasSubstr("remove record"));
  EXPECT_EQ(
      Refusal(kStands, Option("timeout", "3")),
      "timeout: there is no such option; the options are: abandoned_after_s, timeout_s. Did you "
      "mean timeout_s?");
  EXPECT_EQ(Refusal(kStands, Option("timeout_s", "soon")),
            "timeout_s must be a number from 1 to 1e6");
}

TEST_F(Served, UnknownOptionsOfSimulationAndRobotAreRejected) {
  auto specification = Playground(sba::LOCKSTEP);
  SetOption(specification, "deadlines", "3");
  try {
    const sba::Simulation_var simulation = service_->create_simulation(specification);
    FAIL() << "it was created";
  } catch (const sba::Refused& refused) {
    EXPECT_STREQ(
        refused.reason,
        "deadlines: there is no such option; the options are: abandoned_after_s, deadline_s, "
        "on_failure. Did you mean deadline_s?");
  }
  const sba::Simulation_var simulation = service_->create_simulation(Playground(sba::LOCKSTEP));
  sba::RobotSpecification robot;
  robot.model = "pebble";
  robot.options.length(1);
  robot.options[0].name = "colour";
  robot.options[0].value = "red";
  EXPECT_THROW(CORBA::String_var(simulation->add_robot(robot)), sba::Refused);
}

}  // namespace
}  // namespace gsv::testing
