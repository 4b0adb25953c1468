// Tests `gsv campaign run --engine slurm` with a real Slurm that the test starts.
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/slurm_cluster.h"

namespace gsv::testing {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using Strings = std::vector<std::string>;

constexpr std::chrono::minutes kCampaignTimeout{30};

class SlurmCampaign : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const std::string missing = SlurmCluster::Missing(); !missing.empty())
      GTEST_SKIP() << missing;
  }
  // Half of the runs fail, because the robot starts out of bounds at x = 1.
  void WriteCampaign(int runs, const std::string& duration = "0.1") {
    folder_.Write("s.yaml",
                  "world: playground\nduration: " + duration +
                      "\nrobots: [{name: r, model: pebble, x: 0, y: 0}]\n"
                      "expect: [{name: stays, stays_within: {robot: r, x: [-0.5, 0.5]}}]\n");
    folder_.Write("c.yaml",
                  "engine: slurm\nscenario: s.yaml\nparameters:\n  robots[0].x: [0, 1]\n"
                  "  seed: {from: 1, to: " +
                      std::to_string(runs / 2) + "}\n");
  }
  Strings RunArguments(Strings more = {}) const {
    more.insert(more.begin(), {"campaign", "run", file_, "--json", "--poll", "1"});
    return more;
  }
  nlohmann::json Status() const {
    return RunProgram("gsv", {"campaign", "status", file_, "--json"}).LastLine();
  }
  // Waits until this number of runs is done, or the driver has ended.
  void AwaitDone(int runs, Running& driver) const {
    for (int done = 0; done < runs && driver.process().Ending().empty();) {
      const auto status = Status();
      done = status.is_object() ? status.value("done", 0) : 0;
    }
    EXPECT_EQ(driver.process().Ending(), "") << driver.errors();
  }
  static Outcome AwaitEnd(Running& driver) {
    EXPECT_NE(driver.process().AwaitEnd(kCampaignTimeout), "") << driver.errors();
    return driver.AwaitEnd();
  }
  std::size_t Files(const std::string& folder, const std::string& ending) const {
    std::size_t files = 0;
    for (const auto& entry : fs::directory_iterator(folder_.path() / folder))
      files += entry.path().native().ends_with(ending);
    return files;
  }
  void ExpectEachRunOnce(int runs) const {
    const fs::path csv = folder_.path() / "all.csv";
    const Outcome report = RunProgram(
        "gsv", {"campaign", "report", file_, "--by", "robots[0].x", "--csv", csv.string()});
    EXPECT_THAT(report.out, HasSubstr("runs at once"));
    std::ifstream lines(csv);
    std::string line;
    std::getline(lines, line);
    std::set<std::string> numbers;
    while (std::getline(lines, line)) {
      EXPECT_TRUE(numbers.insert(line.substr(0, line.find(','))).second) << line;
      EXPECT_THAT(line, Not(HasSubstr(",error,")));
    }
    EXPECT_EQ(numbers.size(), static_cast<std::size_t>(runs));
  }

  const base::testing::TestFolder folder_{};
  const std::string file_ = folder_.path() / "c.yaml";
};

// GSV_SLURM_RUNS is the number of runs of the campaign. GSV_SLURM_FIGURES is a file for the
// measured cost.
TEST_F(SlurmCampaign, RunsCountOnceIfDriverSlurmdAndANodeAreKilled) {
  const char* wanted = std::getenv("GSV_SLURM_RUNS");
  const int runs = wanted != nullptr ? std::atoi(wanted) : 40;
  WriteCampaign(runs);
  SlurmCluster cluster;
  const Strings arguments = RunArguments({"--runs-per-task", runs > 100 ? "10" : "4"});
  {
    Running driver("gsv", arguments);
    AwaitDone(runs / 10, driver);
    driver.process().Signal(SIGKILL);
    EXPECT_EQ(driver.AwaitEnd().ending, "signal 9");
  }
  EXPECT_LT(Status()["done"], runs);
  Running driver("gsv", arguments);
  AwaitDone(runs / 4, driver);
  cluster.KillSlurmd(0);
  AwaitDone(runs / 3, driver);
  cluster.StartSlurmd(0);
  AwaitDone(runs / 2, driver);
  EXPECT_THAT(driver.errors(), Not(HasSubstr("submitted")))
      << "what was queued is handed out again";
  cluster.LoseNode(1);
  AwaitDone(runs * 6 / 10, driver);
  cluster.StartSlurmd(1);
  const Outcome outcome = AwaitEnd(driver);
  EXPECT_EQ(outcome.ending, "exit code 1") << outcome.err;
  const auto status = outcome.LastLine();
  EXPECT_EQ(status["done"], runs);
  EXPECT_EQ(status["passed"], runs / 2);
  EXPECT_EQ(status["failed"], runs / 2);
  EXPECT_GE(status["queue"]["tasks"], runs / (runs > 100 ? 10 : 4)) << status;
  EXPECT_EQ(status["queue"]["nodes"], 2);
  EXPECT_GE(status["queue"]["mean_wait_s"], 0);
  ExpectEachRunOnce(runs);
  if (const char* figures = std::getenv("GSV_SLURM_FIGURES"))
    std::ofstream(figures) << status.dump() << "\n";
}

TEST_F(SlurmCampaign, LostRunsAreSubmittedAgain) {
  WriteCampaign(8);
  SlurmCluster cluster({.nodes = 1, .processors = 1, .more = "MaxArraySize=3"});
  const Strings arguments = RunArguments({"--sbatch=--no-requeue", "--runs-per-task", "1"});
  {
    Running driver("gsv", arguments);
    AwaitDone(1, driver);
    // An array has at most three tasks, so there are three jobs. If a user cancels jobs, the driver
    // must not submit them again.
    EXPECT_EQ(Files("c.runs", ".json"), 4u);  // three batches and the plan
    SlurmCluster::Ask({"scancel", "--state=PENDING", "--me"});
    const Outcome cancelled = AwaitEnd(driver);
    EXPECT_EQ(cancelled.ending, "exit code 5");
    EXPECT_THAT(cancelled.err, HasSubstr("ended before any of its runs started"));
  }
  Running driver("gsv", arguments);
  while (driver.process().Ending().empty() && cluster.KillProcesses("gsv campaign task") == 0) {
  }
  const Outcome outcome = AwaitEnd(driver);
  EXPECT_EQ(outcome.ending, "exit code 1") << outcome.err;
  EXPECT_EQ(outcome.LastLine()["failed"], 4) << outcome.err;
  ExpectEachRunOnce(8);
}

TEST_F(SlurmCampaign, RunThatCrashesItsTaskThreeTimesIsAnError) {
  WriteCampaign(2);
  folder_.Write("c.yaml", "engine: slurm\nscenario: s.yaml\nparameters: {duration: [1e6, 0.1]}\n");
  SlurmCluster cluster({.nodes = 1});
  Running driver("gsv", RunArguments({"--runs-a-task", "2"}));
  // Each time the task begins the first run, which is long, the task is killed.
  while (driver.process().Ending().empty()) {
    if (cluster.Runs("run_000000.yaml")) cluster.KillProcesses("gsv campaign task");
  }
  const Outcome outcome = AwaitEnd(driver);
  EXPECT_EQ(outcome.ending, "exit code 1") << outcome.err;
  EXPECT_EQ(outcome.LastLine()["errors"], 1) << outcome.err;
  EXPECT_EQ(outcome.LastLine()["passed"], 1) << outcome.err;
  EXPECT_EQ(Files("c.runs/journals", ".journal"), 3u);
}

TEST_F(SlurmCampaign, RefusalBySlurmIsReported) {
  WriteCampaign(4);
  SlurmCluster cluster({.nodes = 1});
  const Outcome partition = RunProgram("gsv", RunArguments({"--partition", "nowhere"}));
  EXPECT_EQ(partition.ending, "exit code 5");
  EXPECT_EQ(partition.err, "gsv: sbatch: Slurm refuses: Invalid partition name specified\n");
  const Outcome option = RunProgram("gsv", RunArguments({"--sbatch=--no-such-option"}));
  EXPECT_EQ(option.ending, "exit code 5");
  EXPECT_THAT(option.err, HasSubstr("unrecognized option '--no-such-option'"));
  EXPECT_EQ(Files("c.runs", "1.json"), 0u);
  // The first driver submits and does not wait. Then the job is cancelled, which a second driver
  // must notice.
  const Outcome handed = RunProgram("gsv", RunArguments({"--no-wait", "--sbatch=--hold"}));
  EXPECT_THAT(handed.err, HasSubstr("Slurm: submitted 4 runs in 4 tasks, job "));
  EXPECT_EQ(SlurmCluster::Ask({"squeue", "--noheader", "--array"}).empty(), false);
  const Outcome again = RunProgram("gsv", RunArguments({"--no-wait"}));
  EXPECT_THAT(again.err, Not(HasSubstr("submitted")));
  SlurmCluster::Ask({"scancel", "--me"});
  Running driver("gsv", RunArguments({"--no-wait"}));
  EXPECT_THAT(AwaitEnd(driver).err, HasSubstr("Slurm: submitted 4 runs in 4 tasks"));
  cluster.KillController();
  const Outcome gone = RunProgram("gsv", RunArguments());
  EXPECT_EQ(gone.ending, "exit code 5");
  EXPECT_THAT(gone.err, HasSubstr("gsv: squeue: "));
}

TEST_F(SlurmCampaign, MissingSlurmIsReported) {
  WriteCampaign(2);
  const Outcome run = RunProgram(
      "/usr/bin/env", {"PATH=/nowhere", Program("gsv").string(), "campaign", "run", file_});
  EXPECT_EQ(run.ending, "exit code 5");
  EXPECT_THAT(run.err, HasSubstr("the commands of Slurm are not on the PATH"));
}

}  // namespace
}  // namespace gsv::testing
