// Tests `gsv campaign`, which executes many runs of a scenario.
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;
using Strings = std::vector<std::string>;

class CampaignCommand : public ::testing::Test {
 protected:
  CampaignCommand() {
    folder_.Write(
        "s.yaml",
        "world: playground\nduration: 2000\nrobots: [{name: r, model: pebble, x: 0, y: 0}]\n"
        "expect: [{name: stays, stays_within: {robot: r, x: [-0.5, 0.5]}}]\n");
  }
  Outcome Campaign(const std::string& what, Strings more = {}) const {
    more.insert(more.begin(), {"campaign", what, file_});
    return RunProgram("gsv", more);
  }

  const base::testing::TestFolder folder_{};
  const std::string file_ = folder_.Write("c.yaml",
                                          "scenario: s.yaml\nparameters:\n"
                                          "  robots[0].x: [0, 1]\n"
                                          "  seed: {from: 1, to: 4}\n");
};

TEST_F(CampaignCommand, AnotherDriverContinuesAKilledOneAndRunsCountOnce) {
  {
    Running driver("gsv", {"campaign", "run", file_, "--jobs", "1"});
    for (int done = 0; done < 1 && driver.process().Ending().empty();) {
      const auto status = Campaign("status", {"--json"}).LastLine();
      done = status.is_object() ? status.value("done", 0) : 0;
    }
    driver.process().Signal(SIGKILL);
    EXPECT_EQ(driver.AwaitEnd().ending, "signal 9");
  }
  const auto left = Campaign("status", {"--json"}).LastLine();
  EXPECT_GE(left["done"], 1);
  EXPECT_LT(left["done"], 8);
  const Outcome rest = Campaign("run", {"--json", "--jobs", "2"});
  // The runs with x = 1 fail, because the robot starts out of bounds.
  EXPECT_EQ(rest.ending, "exit code 1") << rest.err;
  const auto status = rest.LastLine();
  EXPECT_EQ(status["done"], 8);
  EXPECT_EQ(status["passed"], 4);
  EXPECT_EQ(status["failed"], 4);

  const std::string csv = folder_.path() / "all.csv", html = folder_.path() / "report.html";
  const Outcome report = Campaign(
      "report", {"--by", "robots[0].x", "--metric", "r.collisions", "--csv", csv, "--html", html});
  EXPECT_EQ(report.ending, "exit code 0") << report.err;
  EXPECT_THAT(report.out, HasSubstr("0            4     4       1 [0.5101, 1]"));
  EXPECT_THAT(report.out, HasSubstr("1            4     0       0 [0, 0.4899]"));
  std::ostringstream text;
  text << std::ifstream(csv).rdbuf();
  const std::string lines = text.str();
  EXPECT_EQ(std::count(lines.begin(), lines.end(), '\n'), 9) << lines;
  EXPECT_GT(std::filesystem::file_size(html), 1000u);
  // No run is left to do.
  EXPECT_EQ(Campaign("run", {"--json"}).LastLine()["done"], 8);
}

TEST_F(CampaignCommand, SingleRunCanBeExecuted) {
  const Outcome shown = Campaign("show", {"5"});
  ASSERT_EQ(shown.ending, "exit code 0") << shown.err;
  const std::string file = folder_.Write("run5.yaml", shown.out);
  const auto run =
      RunProgram("gsv", {"run", file, "--lockstep", "--headless", "--json"}).LastLine();
  EXPECT_EQ(run["robots"][0]["pose"]["x_m"], 1.0);
  EXPECT_EQ(Campaign("show", {"8"}).ending, "exit code 2");
}

TEST_F(CampaignCommand, SharesOfAnotherQueueAreCollectedAndContinued) {
  EXPECT_EQ(Campaign("run", {"--shard", "1/3", "--jobs", "1"}).ending, "exit code 0");
  EXPECT_EQ(Campaign("status", {"--json"}).LastLine()["done"], 3);
  // A batch queue may execute a share again, if it believes that the share was lost. In this case,
  // all runs of the share are already done.
  EXPECT_EQ(Campaign("run", {"--shard", "1/3"}).ending, "exit code 0");
  EXPECT_EQ(Campaign("run", {"--shard", "3/3", "--jobs", "1"}).ending, "exit code 0");
  const Outcome report = Campaign("report", {"--by", "robots[0].x"});
  // The shares 1 and 3 consist of the runs 0, 3, 6 and 2, 5. In 0, 2 and 3, x is 0.
  EXPECT_THAT(report.out, HasSubstr("0            3 "));
  const Outcome rest = Campaign("run", {"--json"});
  EXPECT_EQ(rest.ending, "exit code 1") << rest.err;
  EXPECT_EQ(rest.LastLine()["done"], 8);
  EXPECT_EQ(rest.LastLine()["failed"], 4);
  // The results file can be created again from the results of the shares.
  std::filesystem::remove(folder_.path() / "c.sqlite");
  EXPECT_EQ(Campaign("status", {"--json"}).LastLine()["done"], 5);
  EXPECT_EQ(Campaign("run", {"--shard", "4/3"}).ending, "exit code 2");
}

TEST_F(CampaignCommand, OptionsWithoutEffectAreRefused) {
  const Strings queues[] = {{"--engine", "slurm"}, {"--engine", "ssh", "--host", "localhost"}};
  for (Strings arguments : queues) {
    const std::string engine = arguments[1];
    arguments.insert(arguments.end(), {"-j", "2"});
    const Outcome run = Campaign("run", arguments);
    EXPECT_EQ(run.ending, "exit code 2") << run.err;
    EXPECT_THAT(run.err, HasSubstr("--jobs 2: the engine " + engine +
                                   " determines how many runs are executed in parallel; remove "
                                   "the option"));
  }
  const std::string slurm = folder_.Write("slurm.yaml", "scenario: s.yaml\nengine: slurm\n");
  EXPECT_EQ(RunProgram("gsv", {"campaign", "run", slurm, "--jobs", "1"}).ending, "exit code 2");
  const std::pair<const char*, Strings> for_other_engines[] = {
      {"--poll: has no effect on runs on this machine", {"--poll", "3"}},
      {"--no-wait: has no effect on runs on this machine", {"--no-wait"}},
      {"--runs-per-task: has no effect on runs on this machine", {"--runs-per-task", "5"}},
      {"--host: has no effect on runs on this machine", {"--host", "localhost"}},
      {"--host: has no effect on runs as Slurm job arrays",
       {"--engine", "slurm", "--host", "localhost"}},
      {"--no-wait: has no effect on runs of a share", {"--shard", "1/2", "--no-wait"}}};
  for (const auto& [sentence, arguments] : for_other_engines) {
    const Outcome run = Campaign("run", arguments);
    EXPECT_EQ(run.ending, "exit code 2") << sentence;
    EXPECT_THAT(run.err, HasSubstr(sentence));
  }
  const std::pair<const char*, Strings> with_shard[] = {
      {"--broker", {"--broker", "corbaloc::1.2@127.0.0.1:1/TradingService"}},
      {"--broker", {"--broker", "corbaloc::1.2@127.0.0.1:1/TradingService", "--servers", "TRUE"}},
      {"--engine", {"--engine", "local"}},
      {"--json", {"--json"}}};
  for (auto [option, arguments] : with_shard) {
    arguments.insert(arguments.end(), {"--shard", "1/2"});
    const Outcome run = Campaign("run", arguments);
    EXPECT_EQ(run.ending, "exit code 2") << option;
    EXPECT_THAT(run.err, ::testing::AllOf(HasSubstr("--shard"), HasSubstr(option),
                                          HasSubstr("cannot be used together")));
  }
}

TEST_F(CampaignCommand, InvalidInputIsReported) {
  const std::string bad = folder_.Write("bad.yaml", "scenario: s.yaml\nparameters: {sed: [1]}\n");
  const Outcome run = RunProgram("gsv", {"campaign", "run", bad});
  EXPECT_EQ(run.ending, "exit code 3");
  EXPECT_THAT(run.err, HasSubstr("sed = 1: there is no key \"sed\" here"));
  EXPECT_EQ(RunProgram("gsv", {"campaign", "run", folder_.path() / "none.yaml"}).ending,
            "exit code 3");
  EXPECT_EQ(Campaign("run", {"--engine", "pbs"}).ending, "exit code 2");
  const std::string pbs = folder_.Write("pbs.yaml", "scenario: s.yaml\nengine: pbs\n");
  const Outcome engine = RunProgram("gsv", {"campaign", "run", pbs});
  EXPECT_EQ(engine.ending, "exit code 3");
  EXPECT_THAT(engine.err, HasSubstr("pbs.yaml:2:9: there is no engine \"pbs\""));
  const std::string torn = folder_.Write("torn.sqlite", "SQLite format 3, and then nothing of it");
  const Outcome report = RunProgram("gsv", {"campaign", "report", torn});
  EXPECT_EQ(report.ending, "exit code 5");
  EXPECT_THAT(report.err, HasSubstr("torn.sqlite"));
}

}  // namespace
}  // namespace gsv::testing
