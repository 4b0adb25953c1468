// Tests several servers at one broker. A client gets the least loaded server, and other servers
// execute the runs of a server that dies.
#include <csignal>
#include <fstream>
#include <map>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/broker/client/broker_client.h"
#include "gsv/broker/client/gsv_service_types.h"
#include "sdk/application.h"
#include "tests/end_to_end/served.h"
#include "tests/support/group.h"
#include "tests/support/other_host.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;
using Strings = std::vector<std::string>;

std::unique_ptr<Running> Serve(const std::string& broker, const std::string& name, Strings more,
                               const Strings& wrapper = {}) {
  Strings arguments{"serve", "--headless", "--broker", broker, "--name", name};
  arguments.insert(arguments.end(), more.begin(), more.end());
  auto server = std::make_unique<Running>("gsv", arguments, wrapper);
  server->AwaitLine("broker: ");
  return server;
}

// Waits until the results contain this number of the campaign's runs.
void AwaitDone(Running& driver, const std::string& results, int count) {
  for (int done = 0; done < count && driver.process().Ending().empty();) {
    const auto status = RunProgram("gsv", {"campaign", "status", results, "--json"}).LastLine();
    done = status.is_object() ? status.value("done", 0) : 0;
  }
}

// Returns status and hash of a campaign's runs, by number.
std::map<std::string, std::string> RunsOf(const std::string& results, const std::string& csv) {
  EXPECT_EQ(RunProgram("gsv", {"campaign", "report", results, "--csv", csv}).ending, "exit code 0");
  std::ifstream file(csv);
  std::string line;
  std::getline(file, line);
  const Strings wanted{"status", "state_hash"};
  std::vector<bool> is_wanted;
  std::istringstream header(line);
  for (std::string field; std::getline(header, field, ',');) {
    is_wanted.push_back(std::find(wanted.begin(), wanted.end(), field) != wanted.end());
  }
  std::map<std::string, std::string> runs;
  while (std::getline(file, line)) {
    std::istringstream fields(line);
    std::string run, text, field;
    for (std::size_t i = 0; std::getline(fields, field, ',') && i < is_wanted.size(); ++i) {
      if (i == 0) run = field;
      if (is_wanted[i]) text += field + " ";
    }
    EXPECT_TRUE(runs.emplace(run, text).second) << "run " << run << " counts twice";
  }
  return runs;
}

TEST(Servers, CampaignSurvivesAKilledAndADisconnectedServer) {
  OtherHost first(1), second(1), third(1);
  if (!first.refusal().empty()) GTEST_SKIP() << first.refusal();
  const Group group;
  const BrokerProcess broker(first.address_here());
  const auto killed = Serve(broker.reference(), "killed", {"--scenarios", "1"}, first.wrapper());
  const auto cut = Serve(broker.reference(), "cut", {"--scenarios", "1"}, second.wrapper());
  const auto stays = Serve(broker.reference(), "stays", {"--scenarios", "2"}, third.wrapper());

  const base::testing::TestFolder folder;
  folder.Write("s.yaml",
               "world: playground\nduration: 5\nrobots:\n"
               "  - {name: r, model: pebble, x: 0, y: 0, behaviour: wander --no-pictures}\n"
               "expect: [{stays_within: {robot: r, x: [-3, 3]}}]\n");
  const std::string file =
      folder.Write("c.yaml", "scenario: s.yaml\nparameters:\n  seed: {from: 1, to: 14}\n");
  const std::string there = folder.path() / "there.sqlite", here = folder.path() / "here.sqlite";
  Running driver("gsv", {"campaign", "run", file, "--results", there, "--broker",
                         broker.reference(), "--servers", "slots >= 1", "--json"});
  AwaitDone(driver, there, 2);
  killed->process().Signal(SIGKILL);
  AwaitDone(driver, there, 4);
  second.Cut();
  const Outcome outcome = driver.AwaitEnd();
  second.Mend();
  EXPECT_THAT(outcome.err, HasSubstr("killed (elsewhere:"));
  EXPECT_THAT(outcome.err, HasSubstr("cut (elsewhere:"));
  EXPECT_THAT(outcome.err, HasSubstr("other servers execute its runs"));
  EXPECT_EQ(outcome.LastLine()["done"], 14) << outcome.err;
  EXPECT_EQ(outcome.LastLine()["errors"], 0) << outcome.err;

  // A campaign without servers, on this machine, must have the same results bit by bit.
  (void)RunProgram("gsv", {"campaign", "run", file, "--results", here});
  const auto runs = RunsOf(there, folder.path() / "there.csv");
  EXPECT_EQ(runs.size(), 14u);
  EXPECT_EQ(runs, RunsOf(here, folder.path() / "here.csv"));
}

TEST(Servers, RunsOfAStoppedServerGoToOtherServers) {
  const BrokerProcess broker;
  const auto stopped = Serve(broker.reference(), "stopped", {"--scenarios", "1"});
  const auto stays = Serve(broker.reference(), "stays", {"--scenarios", "1"});
  const base::testing::TestFolder folder;
  folder.Write("s.yaml",
               "world: playground\nduration: 2000\n"
               "robots: [{name: r, model: pebble, x: 0, y: 0}]\n");
  const std::string file =
      folder.Write("c.yaml", "scenario: s.yaml\nparameters:\n  seed: {from: 1, to: 8}\n");
  const std::string results = folder.path() / "c.sqlite";
  Running driver("gsv", {"campaign", "run", file, "--broker", broker.reference(), "--json"});
  AwaitDone(driver, results, 2);
  stopped->process().Signal(SIGTERM);
  EXPECT_EQ(stopped->AwaitEnd().ending, "exit code 0");
  const Outcome outcome = driver.AwaitEnd();
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
  EXPECT_EQ(outcome.LastLine()["passed"], 8) << outcome.err;
}

TEST(Servers, CampaignWithoutServersIsAnError) {
  const BrokerProcess broker;
  const base::testing::TestFolder folder;
  folder.Write("s.yaml", "world: playground\nduration: 1\n");
  const std::string file = folder.Write("c.yaml", "scenario: s.yaml\n");
  const Outcome none = RunProgram("gsv", {"campaign", "run", file, "--broker", broker.reference()});
  EXPECT_EQ(none.ending, "exit code 5");
  EXPECT_THAT(
      none.err,
      HasSubstr("no server is available at the broker that accepts scenarios; start one with"));
  const auto server = Serve(broker.reference(), "a", {"--scenarios", "1"});
  const Outcome wrong = RunProgram(
      "gsv", {"campaign", "run", file, "--broker", broker.reference(), "--servers", "slots >"});
  EXPECT_EQ(wrong.ending, "exit code 2");
  const Outcome one = RunProgram(
      "gsv", {"campaign", "run", file, "--broker", broker.reference(), "--servers", "name == 'a'"});
  EXPECT_EQ(one.ending, "exit code 0") << one.err;
  EXPECT_THAT(one.out, HasSubstr("1 of 1 runs: 1 passed, 0 failed, 0 errors"));
}

// Returns the name of the server that runs the simulation.
std::string ServerOf(const std::string& broker, const std::string& simulation) {
  std::istringstream lines(RunProgram("gsv", {"ps", "--broker", broker, "--json"}).out);
  for (std::string line; std::getline(lines, line);) {
    const auto json = nlohmann::json::parse(line);
    if (json["name"] == simulation) return json["server"]["name"];
  }
  return "";
}

TEST(Servers, PreferenceForLeastLoadSelectsTheIdleServer) {
  const BrokerProcess broker;
  const auto one = Serve(broker.reference(), "one", {}), two = Serve(broker.reference(), "two", {});
  auto application = Application::Connect(broker.reference());
  ASSERT_TRUE(application) << application.error().Sentence();
  auto orb = StartOrbWithLongTimeout();  // the same ORB, because a process has only one
  ASSERT_TRUE(orb);
  auto client = broker::BrokerClient::Connect(*orb, broker.reference());
  ASSERT_TRUE(client);
  for (const char* busy : {"one", "two"}) {
    const std::string other = busy == std::string("one") ? "two" : "one";
    auto running = (*application)
                       ->Create({.world = "playground", .lockstep = false},
                                std::string("name == '") + busy + "'");
    ASSERT_TRUE(running) << running.error().Sentence();
    ASSERT_TRUE((*running)->Start());
    // The new values are awaited, because the broker caches each value for a second.
    const std::string is_seen =
        std::string("name == '") + busy + "' and load > 0 and simulations == 1";
    const std::string is_idle = "name == '" + other + "' and load == 0";
    for (const std::string& constraint : {is_seen, is_idle}) {
      std::size_t found = 0;
      while (found == 0) {
        const auto offers =
            client->Query(broker::SimulationServiceType().name, constraint, "first", 1);
        ASSERT_TRUE(offers) << offers.error().Sentence();
        found = offers->size();
      }
    }
    auto created = (*application)
                       ->Create({.world = "playground", .name = std::string("beside_") + busy}, "",
                                "min load");
    ASSERT_TRUE(created) << created.error().Sentence();
    EXPECT_EQ(ServerOf(broker.reference(), std::string("beside_") + busy), other);
  }
}

TEST(Servers, SimulationOfADeadServerIsReportedAsLost) {
  const BrokerProcess broker;
  const auto server = Serve(broker.reference(), "dies", {});
  auto application = Application::Connect(broker.reference());
  ASSERT_TRUE(application);
  auto simulation = (*application)->Create({.world = "playground", .lockstep = false});
  ASSERT_TRUE(simulation) << simulation.error().Sentence();
  ASSERT_TRUE((*simulation)->AddRobot({.model = "pebble", .x = 1}));
  ASSERT_TRUE((*simulation)->Start());
  ASSERT_EQ((*simulation)->State()->phase, "running");
  bool was_killed = false;
  const auto ran = (*simulation)->RunUntil(std::chrono::hours(1), std::chrono::minutes(5), [&] {
    if (!std::exchange(was_killed, true)) server->process().Signal(SIGKILL);
    return true;
  });
  ASSERT_FALSE(ran);
  EXPECT_THAT(ran.error().Sentence(), HasSubstr("the simulation ended with its server"));
  const auto state = (*simulation)->State();
  ASSERT_TRUE(state);
  EXPECT_EQ(state->phase, "lost");
  EXPECT_THAT(state->failure, HasSubstr("no program accepts connections at this address any more"));
  ASSERT_EQ(state->robots.size(), 1u);  // the last state that the server returned
  EXPECT_EQ(state->robots[0].place.x, 1);
  // The application continues with another server.
  const auto another = Serve(broker.reference(), "lives", {});
  auto again = (*application)->Create({.world = "playground"}, "", "min load");
  ASSERT_TRUE(again) << again.error().Sentence();
  EXPECT_TRUE((*again)->RunUntil(std::chrono::seconds(1)));
}

}  // namespace
}  // namespace gsv::testing
