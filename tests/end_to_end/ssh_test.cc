// Tests `gsv campaign run --engine ssh` with real sshds that the test starts, or with a fake ssh.
#include <csignal>
#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/ssh_hosts.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;
using Strings = std::vector<std::string>;

constexpr std::chrono::minutes kCampaignTimeout{5};

class SshCampaign : public ::testing::Test {
 protected:
  // Half of the runs fail, because the robot starts out of bounds at x = 1.
  void WriteCampaign(const SshHosts& hosts, const std::string& names, int runs,
                     const std::string& duration = "0.1") {
    folder_.Write("s.yaml",
                  "world: playground\nduration: " + duration +
                      "\nrobots: [{name: r, model: pebble, x: 0, y: 0}]\n"
                      "expect: [{name: stays, stays_within: {robot: r, x: [-0.5, 0.5]}}]\n");
    folder_.Write("c.yaml", "engine: ssh\nssh: {hosts: " + names + ", runs_per_task: 2, " +
                                hosts.Keys() +
                                "}\nscenario: s.yaml\nparameters:\n  robots[0].x: [0, 1]\n"
                                "  seed: {from: 1, to: " +
                                std::to_string(runs / 2) + "}\n");
  }
  // Waits until this number of runs is done, or the driver has ended.
  void AwaitDone(int runs, Running& driver) const {
    for (int done = 0; done < runs && driver.process().Ending().empty();) {
      const auto status = RunProgram("gsv", {"campaign", "status", file_, "--json"}).LastLine();
      done = status.is_object() ? status.value("done", 0) : 0;
    }
    EXPECT_EQ(driver.process().Ending(), "") << driver.errors();
  }
  static Outcome AwaitEnd(Running& driver) {
    EXPECT_NE(driver.process().AwaitEnd(kCampaignTimeout), "") << driver.errors();
    return driver.AwaitEnd();
  }
  std::vector<int> Tasks() const {
    return ProcessesWith("campaign task " + (folder_.path() / "c.runs").string());
  }
  // Waits until all tasks on this machine have ended. A task without a connection ends soon: it
  // checks its connection about twice a second.
  void ExpectTasksEnd() const {
    const auto give_up = std::chrono::steady_clock::now() + kProgramTimeout;
    while (!Tasks().empty() && std::chrono::steady_clock::now() < give_up) {
    }
    EXPECT_TRUE(Tasks().empty());
  }

  const base::testing::TestFolder folder_{};
  const std::string file_ = folder_.path() / "c.yaml";
  const Strings run_{"campaign", "run", file_, "--json"};
};

class SshCampaignBy : public SshCampaign, public ::testing::WithParamInterface<SshHosts::Kind> {
 protected:
  void SetUp() override {
    if (const std::string missing = SshHosts::Missing(GetParam()); !missing.empty())
      GTEST_SKIP() << missing;
  }
};

INSTANTIATE_TEST_SUITE_P(, SshCampaignBy,
                         ::testing::Values(SshHosts::Kind::kSshd, SshHosts::Kind::kStandIn),
                         [](const auto& kind) {
                           return kind.param == SshHosts::Kind::kSshd ? "Sshd" : "StandIn";
                         });

TEST_P(SshCampaignBy, RunsCountOnceIfDriverAndHostAreKilledAndAHostIsMissing) {
  SshHosts hosts(GetParam(), 2);
  WriteCampaign(hosts, "['127.0.0.1:1', '127.0.0.2:1', '127.0.0.3:2']", 16);
  {
    Running driver("gsv", run_);
    AwaitDone(2, driver);
    driver.process().Signal(SIGKILL);
    EXPECT_EQ(driver.AwaitEnd().ending, "signal 9");
    ExpectTasksEnd();
  }
  Running driver("gsv", run_);
  AwaitDone(6, driver);
  hosts.Lose(1);
  const Outcome outcome = AwaitEnd(driver);
  EXPECT_EQ(outcome.ending, "exit code 1") << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("host 127.0.0.3 failed: ssh: connect to host 127.0.0.3"));
  EXPECT_THAT(outcome.err, HasSubstr("host 127.0.0.2 failed: "));
  const auto status = outcome.LastLine();
  EXPECT_EQ(status["done"], 16);
  EXPECT_EQ(status["passed"], 8);
  EXPECT_EQ(status["failed"], 8);
  EXPECT_EQ(status["queue"]["nodes"], 2);
  const std::string csv = folder_.path() / "all.csv";
  RunProgram("gsv", {"campaign", "report", file_, "--csv", csv});
  std::ifstream lines(csv);
  std::set<std::string> numbers;
  std::string line;
  std::getline(lines, line);
  while (std::getline(lines, line)) numbers.insert(line.substr(0, line.find(',')));
  EXPECT_EQ(numbers.size(), 16u);
}

TEST_F(SshCampaign, InterruptEndsTheTasksOnTheHosts) {
  SshHosts hosts(SshHosts::Kind::kStandIn, 1);
  WriteCampaign(hosts, "['127.0.0.1:2']", 4, "1e6");
  Running driver("gsv", run_);
  while (Tasks().empty() && driver.process().Ending().empty()) {
  }
  driver.process().Signal(SIGINT);
  const Outcome outcome = AwaitEnd(driver);
  EXPECT_EQ(outcome.ending, "exit code 130");
  EXPECT_THAT(
      outcome.err,
      HasSubstr("interrupted; the tasks on the hosts end. Run the same command again to continue"));
  ExpectTasksEnd();
}

TEST_F(SshCampaign, InvalidInputIsReportedInOneSentence) {
  SshHosts hosts(SshHosts::Kind::kStandIn, 0);
  WriteCampaign(hosts, "[n1]", 2);
  const Outcome no_wait = RunProgram("gsv", {"campaign", "run", file_, "--no-wait"});
  EXPECT_EQ(no_wait.ending, "exit code 2");
  EXPECT_EQ(
      no_wait.err,
      "gsv: --no-wait: the tasks of the engine ssh end with this command; remove --no-wait\n");
  WriteCampaign(hosts, "[]", 2);
  const Outcome none = RunProgram("gsv", {"campaign", "run", file_});
  EXPECT_EQ(none.ending, "exit code 3");
  EXPECT_THAT(none.err, HasSubstr("hosts must be a list of 1 to 1,000 hosts"));
}

}  // namespace
}  // namespace gsv::testing
