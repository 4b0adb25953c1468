// Tests how the command line explains the state of robots, recordings and brokers.
#include <set>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;
using Strings = std::vector<std::string>;

class HealthRun : public ::testing::Test {
 protected:
  HealthRun() {
    setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
    setenv("XDG_STATE_HOME", (folder_.path() / "state").c_str(), 1);
    unsetenv("GSV_BROKER");
  }
  static Outcome Gsv(Strings arguments) { return RunProgram("gsv", std::move(arguments)); }
  // Executes a run of two seconds.
  static Outcome Run(Strings more) {
    Strings arguments{"run", "playground", "--headless", "--lockstep", "--duration", "2"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Gsv(std::move(arguments));
  }
  static std::string ReplyOfBash(const std::string& words, int current) {
    return RunProgram("/bin/bash", {"-c", "source <(" + Program("gsv").string() +
                                              " completion bash); COMP_WORDS=(" + words +
                                              "); COMP_CWORD=" + std::to_string(current) +
                                              "; _gsv; echo \"${COMPREPLY[@]}\""})
        .out;
  }

  base::testing::TestFolder folder_;
};

TEST_F(HealthRun, PsPrintsWhyARobotStandsAndOffersFindsTheBroker) {
  Running run("gsv", {"run", "playground", "--headless", "--lockstep", "--robot", "pebble@0,0"});
  run.AwaitLine("broker: ");
  const Outcome ps = Gsv({"ps"});
  EXPECT_THAT(ps.out, HasSubstr("has not moved for "));
  EXPECT_THAT(ps.out, HasSubstr("it has no behaviour, and no command to move"));
  const auto robot = Gsv({"ps", "--json"}).LastLine()["robots"][0];
  EXPECT_EQ(robot["health"]["state"], "standing") << robot;
  EXPECT_NEAR(robot["health"]["since_s"].get<double>(), 0, 0.02) << robot;
  const Outcome offers = Gsv({"offers"});
  EXPECT_EQ(offers.ending, "exit code 0") << offers.err;
  EXPECT_THAT(offers.out, HasSubstr("SimulationService"));
}

TEST_F(HealthRun, ListingOffersWithoutABrokerIsAnErrorWithAHint) {
  const Outcome offers = Gsv({"offers"});
  EXPECT_EQ(offers.ending, "exit code 5");
  EXPECT_THAT(offers.err, HasSubstr("give the address of a broker with --broker"));
}

TEST_F(HealthRun, ARunReportsTheRobotsThatStoodStill) {
  const Outcome run = Run({"--robot", "pebble@0,0", "--robot", "pebble@2,0"});
  EXPECT_EQ(run.ending, "exit code 0") << run.err;
  EXPECT_THAT(run.out, HasSubstr("Finished after 2.00 s simulated"));
  EXPECT_THAT(run.out, HasSubstr("2 stand"));
  EXPECT_THAT(run.out, HasSubstr("0 collisions; stood still from 0.0 s"));
}

TEST_F(HealthRun, ABehaviourThatCannotStartIsReportedWithItsLastError) {
  const auto program = folder_.Write("gsv-broken",
                                     "#!/bin/sh\n"
                                     "echo 'Traceback (most recent call last):' >&2\n"
                                     "echo '  File \"/x/broken.py\", line 12, in run' >&2\n"
                                     "echo 'ValueError: too far' >&2\n"
                                     "exit 1\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  setenv("PATH", (folder_.path().string() + ":/usr/bin:/bin").c_str(), 1);
  const Outcome run = Run({"--robot", "pebble@0,0", "--behaviour", "broken"});
  EXPECT_THAT(
      run.err,
      HasSubstr("ended at once with exit code 1: ValueError: too far in broken.py line 12"));
}

TEST_F(HealthRun, RobotsArePlacedOnAGridOrAtRandom) {
  for (const char* place : {"grid:9", "random:9"}) {
    const auto report = Run({"--place", place, "--json"}).LastLine();
    ASSERT_EQ(report["robots"].size(), 9u) << place;
    std::set<std::pair<double, double>> places;
    for (const auto& robot : report["robots"]) {
      EXPECT_EQ(robot["model"], "pebble");
      places.emplace(robot["pose"]["x_m"], robot["pose"]["y_m"]);
    }
    EXPECT_EQ(places.size(), 9u) << place;
  }
  EXPECT_THAT(Run({"--place", "gird:9"}).err, HasSubstr("Did you mean grid?"));
  EXPECT_EQ(Run({"--place", "grid:0"}).ending, "exit code 2");
}

TEST_F(HealthRun, ADifferenceNamesScenarioAndRobot) {
  const std::string first = folder_.path() / "first.mcap", second = folder_.path() / "second.mcap";
  for (const auto& [file, robot, seed] :
       {std::tuple(first, "pebble@0,0", "1"), std::tuple(second, "pebble@0,1", "2")}) {
    EXPECT_EQ(Run({"--seed", seed, "--record", file, "--robot", robot}).ending, "exit code 0");
  }
  const Outcome diff = Gsv({"rec", "diff", first, second});
  EXPECT_EQ(diff.ending, "exit code 1");
  EXPECT_THAT(diff.out, HasSubstr("the scenarios differ:\n"));
  EXPECT_THAT(diff.out, HasSubstr("  first:  seed: 1\n"));
  EXPECT_THAT(diff.out, HasSubstr("  second: seed: 2\n"));
  EXPECT_THAT(diff.out, HasSubstr("pebble: "));
  EXPECT_LT(std::count(diff.out.begin(), diff.out.end(), '\n'), 60);
  const Outcome list = Gsv({"rec", "list", folder_.path()});
  EXPECT_THAT(list.out, HasSubstr("first.mcap"));
  EXPECT_THAT(list.out, HasSubstr("playground, 1 robot\n"));
}

TEST_F(HealthRun, TheDifferenceNamesTheRobotWhoseCommandDiffers) {
  const auto record = [&](const std::string& name, const std::string& goal) {
    const std::string file = folder_.path() / name;
    const Outcome run = Run({"--robot", "pebble@0,0", "--robot", "pebble@0,1", "--behaviour",
                             "pebble=goto --goal-x 1 --goal-y 0", "--behaviour",
                             "pebble_2=goto --goal-y 1 --goal-x " + goal, "--record", file});
    EXPECT_EQ(run.ending, "exit code 0") << run.err;
    return file;
  };
  const Outcome diff = Gsv({"rec", "diff", record("near.mcap", "0.5"), record("far.mcap", "-1")});
  EXPECT_THAT(diff.out, HasSubstr("\npebble_2: ")) << diff.err;
}

TEST_F(HealthRun, EqualRunsWhoseBehaviourDiesHaveEqualRecordings) {
  setenv("PATH", (folder_.path().string() + ":/usr/bin:/bin").c_str(), 1);
  for (const std::string fault : {"throw", "die"}) {
    const auto program = folder_.Write(
        "gsv-" + fault, "#!/bin/sh\nexec '" + Program("../tests/bad_behaviour").string() +
                            "' --fault " + fault + " \"$@\"\n");
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    const auto record = [&](const std::string& name) {
      const std::string file = folder_.path() / (fault + name);
      const Outcome run = Run({"--robot", "pebble@0,0", "--behaviour", fault, "--record", file});
      EXPECT_THAT(run.out, HasSubstr("was dead from 0.2 s")) << run.err;
      return file;
    };
    const Outcome diff = Gsv({"rec", "diff", record("-1.mcap"), record("-2.mcap")});
    EXPECT_EQ(diff.ending, "exit code 0") << diff.out << diff.err;
  }
}

TEST_F(HealthRun, BashCompletesCommandsOptionsAndValues) {
  EXPECT_EQ(ReplyOfBash("gsv rec inf", 2), "info\n");
  EXPECT_EQ(ReplyOfBash("gsv run --headl", 2), "--headless\n");
  EXPECT_EQ(ReplyOfBash("gsv run --record-pictures j", 3), "jpeg\n");
  for (const char* shell : {"zsh", "fish"}) {
    EXPECT_THAT(Gsv({"completion", shell}).out, HasSubstr("headless"));
  }
}

}  // namespace
}  // namespace gsv::testing
