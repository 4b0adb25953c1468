// Tests gsv ps, pause, resume, step, real-time-factor, stop and reset with simulations in other
// processes.
#include <csignal>
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using Strings = std::vector<std::string>;

// Runs of this test register in a folder of their own, apart from runs and crash reports of other
// tests.
class Control : public ::testing::Test {
 protected:
  Control() {
    setenv("XDG_RUNTIME_DIR", folder_.path().c_str(), 1);
    setenv("XDG_STATE_HOME", (folder_.path() / "state").c_str(), 1);
    unsetenv("GSV_BROKER");
  }

  // Starts a run in lockstep that has no end.
  static std::unique_ptr<Running> StartRun(Strings more = {}) {
    Strings arguments{"run",     "playground", "--headless", "--lockstep",
                      "--robot", "pebble@0,0", "--seed",     "3"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    auto run = std::make_unique<Running>("gsv", arguments);
    run->AwaitLine("broker: ");
    return run;
  }
  static Outcome Gsv(Strings arguments) { return RunProgram("gsv", std::move(arguments)); }
  static nlohmann::json Json(Strings arguments) {
    arguments.push_back("--json");
    const Outcome outcome = Gsv(std::move(arguments));
    EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
    return outcome.LastLine();
  }
  static void ExpectError(Strings arguments, int code, const std::string& sentence) {
    const Outcome outcome = Gsv(std::move(arguments));
    EXPECT_EQ(outcome.ending, "exit code " + std::to_string(code));
    EXPECT_THAT(outcome.err, HasSubstr(sentence));
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  static std::string Pid(Running& run) { return std::to_string(run.process().pid()); }

  base::testing::TestFolder folder_;
};

TEST_F(Control, PsListsSimulationsWithTheirRobots) {
  const auto run = StartRun({"--behaviour", "wander"});
  const auto simulation = Json({"ps"});
  EXPECT_EQ(simulation["server"]["name"], "gsv run");
  EXPECT_THAT(simulation["server"]["place"].get<std::string>(), HasSubstr(":" + Pid(*run)));
  EXPECT_EQ(simulation["name"], "simulation");
  EXPECT_EQ(simulation["phase"], "running");
  EXPECT_EQ(simulation["mode"], "lockstep");
  EXPECT_GE(simulation["time_s"], 0.0);
  EXPECT_EQ(simulation["target_factor"], 1.0);
  EXPECT_TRUE(simulation["real_time_factor"].is_number());
  EXPECT_EQ(simulation["late_steps"], 0);
  ASSERT_EQ(simulation["robots"].size(), 1u);
  EXPECT_EQ(simulation["robots"][0]["behaviour"], "wander");
  EXPECT_THAT(Gsv({"ps"}).out, HasSubstr("simulation on gsv run ("));
  EXPECT_EQ(Gsv({"ps", "another"}).out, "");
}

TEST_F(Control, RecordsARunningSimulation) {
  const auto run = StartRun();
  const std::string path = folder_.path() / "part.mcap";
  const Outcome started = Gsv({"rec", "start", path});
  EXPECT_EQ(started.ending, "exit code 0") << started.err;
  EXPECT_EQ(started.out, "recording simulation to " + path + "\n");
  EXPECT_THAT(Gsv({"rec", "start", path + "2"}).err, HasSubstr("stop this recording first"));
  EXPECT_EQ(Json({"pause"})["phase"], "paused");
  const int from = Json({"ps"})["step"];
  Json({"step", "100"});
  const Outcome stopped = Gsv({"rec", "stop"});
  EXPECT_EQ(stopped.ending, "exit code 0") << stopped.err;
  EXPECT_EQ(Json({"ps"})["step"], from + 100);  // `rec stop` does not end the run
  const auto info = Json({"rec", "info", path});
  EXPECT_TRUE(info["indexed"]);
  EXPECT_GE(info["duration_s"], 0.1);
  EXPECT_THAT(Gsv({"rec", "stop"}).err, HasSubstr("it is not being recorded"));
}

TEST_F(Control, PausesStepsResumesAndStops) {
  const auto run = StartRun();
  EXPECT_EQ(Json({"pause"})["phase"], "paused");
  const int step = Json({"step"})["step"];  // takes one step and returns its number
  EXPECT_EQ(Json({"step", "7"})["step"], step + 7);
  EXPECT_EQ(Json({"ps"})["step"], step + 7);
  EXPECT_EQ(Json({"resume"})["phase"], "running");
  const Outcome stopped = Gsv({"stop"});
  EXPECT_EQ(stopped.ending, "exit code 0");
  EXPECT_THAT(stopped.out, HasSubstr(": stopped"));
  EXPECT_EQ(run->AwaitEnd().ending, "exit code 0");
}

TEST_F(Control, RunAfterAResetHasTheSameHash) {
  const auto run = StartRun({"--behaviour", "wander"});
  EXPECT_EQ(Json({"pause"})["phase"], "paused");
  EXPECT_EQ(Json({"reset"})["time_s"], 0.0);
  const auto first = Json({"step", "40"});
  EXPECT_EQ(first["step"], 40);
  EXPECT_EQ(Json({"reset"})["phase"], "created");
  EXPECT_EQ(Json({"step", "40"})["state_hash"], first["state_hash"]);
  EXPECT_EQ(Json({"reset"})["phase"], "created");
  EXPECT_THAT(Json({"resume"})["phase"].get<std::string>(), AnyOf("starting", "running"));
}

TEST_F(Control, CommandsReadTheirParametersFromOptions) {
  const auto run = StartRun();
  Json({"pause"});
  Json({"step"});
  const auto before = Json({"ps"})["state_hash"];
  EXPECT_NE(Json({"set-gravity", "simulation", "--z", "-1.62"})["state_hash"], before);
  ExpectError({"set-gravity", "--z", "-101"}, 2, "'z' must be a number from -100 to 100 m/s²");
  EXPECT_EQ(Json({"set-gravity"})["state_hash"], before);
  EXPECT_THAT(Gsv({"set-gravity", "--help"}).out,
              HasSubstr("from -100 to 100 m/s² (default: the world's"));
}

TEST_F(Control, SetsTheRealTimeFactor) {
  Running run("gsv", {"run", "playground", "--headless", "--real-time-factor", "0.001",
                      "--duration", "20"});
  run.AwaitLine("broker: ");
  const Outcome set = Gsv({"real-time-factor", "2.5"});
  EXPECT_EQ(set.ending, "exit code 0") << set.err;
  EXPECT_THAT(set.out, HasSubstr("(target 2.5)"));
  ExpectError({"factor", "0"}, 2, "it must be above 0 and at most 1e6");
  ExpectError({"factor", "fast"}, 2, "fast");
  ExpectError({"real-time-factor"}, 2, "missing argument real_time_factor");
  EXPECT_EQ(Json({"ps"})["target_factor"], 2.5);
  EXPECT_EQ(Gsv({"factor", "1000000"}).ending, "exit code 0");
  // At the initial real-time factor, the run would take 5.5 hours.
  EXPECT_EQ(run.AwaitEnd().ending, "exit code 0");
}

TEST_F(Control, RejectsARealTimeFactorInLockstep) {
  const auto run = StartRun();
  ExpectError({"factor", "2"}, 2, "a simulation in lockstep runs as fast as possible");
}

TEST_F(Control, SelectsTheNewestRunWithoutABroker) {
  const auto older = StartRun();
  const auto newer = StartRun();
  EXPECT_THAT(Json({"pause"})["server"]["place"].get<std::string>(), HasSubstr(":" + Pid(*newer)));
  EXPECT_EQ(Json({"ps", "--server", Pid(*older)})["phase"], "running");
  EXPECT_EQ(Json({"ps", "--server", Pid(*newer)})["phase"], "paused");
  const Outcome all = Gsv({"ps"});
  EXPECT_THAT(all.out, HasSubstr(":" + Pid(*older)));
  EXPECT_THAT(all.out, HasSubstr(":" + Pid(*newer)));
  ExpectError({"pause", "simulation"}, 2, "several simulations match");
  EXPECT_EQ(Json({"pause", "--server", Pid(*older)})["phase"], "paused");
}

TEST_F(Control, KilledRunIsNoLongerListed) {
  {
    const auto run = StartRun();
    run->process().Signal(SIGKILL);
    EXPECT_EQ(run->AwaitEnd().ending, "signal 9");
  }
  EXPECT_FALSE(std::filesystem::is_empty(folder_.path() / "gsv"));
  const Outcome outcome = Gsv({"ps"});
  EXPECT_EQ(outcome.ending, "exit code 0");
  EXPECT_EQ(outcome.out, "");
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path() / "gsv"))
    EXPECT_EQ(entry.path().extension(), ".socket");  // the next server removes this file
}

TEST_F(Control, FinishedRunLeavesNoFile) {
  const auto run = StartRun();
  EXPECT_EQ(Gsv({"stop"}).ending, "exit code 0");
  run->AwaitEnd();
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path() / "gsv"));
}

TEST_F(Control, IgnoresAFolderThatOthersCanWriteTo) {
  std::filesystem::create_directory(folder_.path() / "gsv");
  std::filesystem::permissions(folder_.path() / "gsv", std::filesystem::perms::all);
  folder_.Write("gsv/1.json", R"({"pid":1,"started":0,"broker":"corbaloc::127.0.0.1:1/Trap"})");
  const auto run = StartRun();
  EXPECT_EQ(Gsv({"ps"}).out, "");
  run->process().Signal(SIGINT);
  EXPECT_THAT(run->AwaitEnd().err, HasSubstr("only this user can write to"));
}

TEST_F(Control, FindsSimulationsOfAServerThroughItsBroker) {
  const BrokerProcess broker;
  Running serve("gsv", {"serve", "--broker", broker.reference(), "--headless"});
  serve.AwaitLine("broker: ");
  const Outcome none = Gsv({"ps", "--broker", broker.reference()});
  EXPECT_EQ(none.ending, "exit code 0");
  EXPECT_EQ(none.out, "");
  ExpectError({"stop", "--broker", broker.reference()}, 5, "the broker has no simulations");
  const auto run = StartRun({"--broker", broker.reference()});
  EXPECT_EQ(Json({"pause", "--broker", broker.reference(), "simulation"})["phase"], "paused");
}

TEST_F(Control, ErrorsAreOneSentenceWithAnExitCode) {
  ExpectError({"pause"}, 5, "you have no running simulation on this machine");
  ExpectError({"ps", "--broker", "corbaloc::127.0.0.1:1/TradingService"}, 5, "no broker responds");
  ExpectError({"ps", "--broker", "nonsense"}, 2, "nonsense");
  const auto run = StartRun();
  ExpectError({"pause", "another"}, 2, "there are: simulation on gsv run (");
  ExpectError({"step", "3"}, 5, "to step it must be created or paused, and it is running");
  EXPECT_EQ(Gsv({"step", "0"}).ending, "exit code 2");
  EXPECT_EQ(Gsv({"ps", "--nothing"}).ending, "exit code 2");
  EXPECT_THAT(Gsv({"pause", "--help"}).out, HasSubstr("--broker"));
}

}  // namespace
}  // namespace gsv::testing
