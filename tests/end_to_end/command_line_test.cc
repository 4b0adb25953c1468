// Tests the command line as a user types it, with the real programs.
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsSupersetOf;
using ::testing::Not;
using Strings = std::vector<std::string>;

Strings RunArguments(Strings more) {
  Strings arguments{"run", "playground", "--headless", "--lockstep", "--json", "--seed", "1"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(CommandLine, RunShowsTheDefaultWorldWithFiveRobots) {
  const Outcome outcome = RunProgram("gsv", {"run", "--port", "0", "--duration", "3", "--json"});
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("viewer: http://127.0.0.1:"));
  const auto report = outcome.LastLine();
  ASSERT_EQ(report["robots"].size(), 5u) << outcome.out;
  std::set<std::string> behaviours;
  for (const auto& robot : report["robots"]) {
    EXPECT_GT(robot["distance_m"], 0.1) << robot;
    // At least one reading of each of eight sonars, even on a slow machine.
    EXPECT_GE(robot["readings"]["sonar"], 8) << robot;
    behaviours.insert(robot["behaviour"]);
  }
  EXPECT_GE(behaviours.size(), 2u);
  EXPECT_EQ(report["warnings"].size(), 0u);
}

// Libraries that take long to link are loaded only by commands that need them; see docs/adr/063.
TEST(CommandLine, VersionLoadsNoOptionalLibraries) {
  const Outcome outcome =
      RunProgram("/usr/bin/env", {"LD_DEBUG=files", Program("gsv").string(), "--version"});
  EXPECT_EQ(outcome.ending, "exit code 0");
  EXPECT_THAT(outcome.err, HasSubstr("libomniORB4"));
  for (const char* library :
       {"libsdformat", "libignition", "libCOS4", "libCOSDynamic4", "libEGL", "libpng"}) {
    EXPECT_THAT(outcome.err, Not(HasSubstr(library)));
  }
}

TEST(CommandLine, RunAcceptsWorldRobotsAndBehaviours) {
  const Outcome outcome =
      RunProgram("gsv", RunArguments({"--robot", "pebble@-2,-3.5,90deg", "--robot", "b21r@0,1",
                                      "--behaviour", "wander", "--behaviour", "b21r=follow-wall",
                                      "--step", "0.02", "--duration", "2"}));
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
  const auto report = outcome.LastLine();
  EXPECT_EQ(report["steps"], 100);
  EXPECT_DOUBLE_EQ(report["sim_time_s"], 2.0);
  ASSERT_EQ(report["robots"].size(), 2u);
  EXPECT_EQ(report["robots"][0]["name"], "b21r");
  EXPECT_EQ(report["robots"][0]["behaviour"], "follow-wall");
  EXPECT_EQ(report["robots"][1]["behaviour"], "wander");
  EXPECT_EQ(report["robots"][1]["readings"]["camera"], 2);
}

TEST(CommandLine, LockstepGivesTheSameHashTwice) {
  const Strings arguments = RunArguments({"--robot", "pebble@-2,-3.5", "--robot", "b21r@0,1",
                                          "--behaviour", "wander", "--duration", "5"});
  const auto first = RunProgram("gsv", arguments).LastLine();
  const auto second = RunProgram("gsv", arguments).LastLine();
  ASSERT_EQ(first["state_hash"].get<std::string>().size(), 16u);
  EXPECT_EQ(first["state_hash"], second["state_hash"]);
}

TEST(CommandLine, RunAddsAnAvatar) {
  const Outcome outcome = RunProgram("gsv", RunArguments({"--avatar", "avatar@1,1,0", "--robot",
                                                          "pebble@0,1", "--duration", "0.5"}));
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
  EXPECT_EQ(outcome.LastLine()["robots"].size(), 2u);
}

TEST(CommandLine, InterruptEndsCleanly) {
  base::testing::TestFolder folder;
  const auto file = (folder.path() / "run.mcap").string();
  Running run("gsv", {"run", "playground", "--port", "0", "--robot", "pebble", "--behaviour",
                      "wander", "--record", file});
  run.AwaitLine("viewer: ");
  run.process().Signal(SIGINT);
  EXPECT_EQ(run.AwaitEnd().ending, "exit code 130");
  EXPECT_EQ(RunProgram("gsv", {"rec", "info", file, "--json"}).ending, "exit code 0");
}

TEST(CommandLine, ServeRegistersWithTheBroker) {
  const BrokerProcess broker;
  Running serve("gsv",
                {"serve", "--broker", broker.reference(), "--name", "laboratory", "--headless"});
  serve.AwaitLine("broker: ");
  const Outcome offers = RunProgram("gsv", {"offers", "--broker", broker.reference(), "--json"});
  EXPECT_EQ(offers.ending, "exit code 0");
  const auto offer = offers.LastLine();
  EXPECT_EQ(offer["type"], "gsv::SimulationService");
  EXPECT_EQ(offer["properties"]["name"], "laboratory");
}

TEST(CommandLine, ServeWithdrawsItsOfferOnSigterm) {
  const BrokerProcess broker;
  Running serve("gsv", {"serve", "--broker", broker.reference(), "--headless"});
  serve.AwaitLine("broker: ");
  serve.process().Signal(SIGTERM);
  EXPECT_EQ(serve.AwaitEnd().ending, "exit code 0");
  EXPECT_EQ(RunProgram("gsv", {"offers", "--broker", broker.reference(), "--json"}).out, "");
}

TEST(CommandLine, ListsAddsAndRemovesLinks) {
  const BrokerProcess broker;
  const BrokerProcess other;
  const auto links = [&](std::vector<std::string> words) {
    words.insert(words.begin(), "links");
    words.insert(words.end(), {"--broker", broker.reference(), "--json"});
    return RunProgram("gsv", words);
  };
  EXPECT_EQ(links({"add", "north", other.reference(), "--limit", "if_no_local"}).ending,
            "exit code 0");
  const Outcome listed = links({});
  EXPECT_EQ(listed.ending, "exit code 0");
  EXPECT_EQ(listed.LastLine()["name"], "north");
  EXPECT_EQ(listed.LastLine()["limiting_follow_rule"], "if_no_local");
  EXPECT_EQ(listed.LastLine()["answers"], true);
  EXPECT_EQ(links({"add", "north", other.reference()}).ending, "exit code 2");
  EXPECT_EQ(links({"remove", "north"}).ending, "exit code 0");
  EXPECT_EQ(links({"list"}).out, "");
}

TEST(CommandLine, ListsAddsAndRemovesTypesAndOffers) {
  const BrokerProcess broker;
  const auto run = [&](const char* command, std::vector<std::string> words) {
    words.insert(words.begin(), command);
    words.insert(words.end(), {"--broker", broker.reference(), "--json"});
    return RunProgram("gsv", words);
  };
  const std::string service = "corbaloc::1.2@127.0.0.1:9/Robot";
  EXPECT_EQ(run("offers", {"add", "Robot", service}).ending, "exit code 3");
  EXPECT_EQ(run("types", {"add", "Robot", "--property", "mandatory string name"}).ending,
            "exit code 0");
  const auto type = run("types", {}).LastLine();
  EXPECT_EQ(type["name"], "Robot");
  EXPECT_EQ(type["properties"][0]["mandatory"], true);

  const Outcome added = run("offers", {"add", "Robot", service, "--property", "name=r2"});
  ASSERT_EQ(added.ending, "exit code 0") << added.err;
  const std::string id = added.LastLine()["id"];
  const auto offer = run("offers", {"list"}).LastLine();
  EXPECT_EQ(offer["id"], id);
  EXPECT_EQ(offer["address"], "127.0.0.1:9");
  EXPECT_EQ(offer["properties"]["name"], "r2");
  EXPECT_EQ(run("offers", {"remove", id}).ending, "exit code 0");
  EXPECT_EQ(run("offers", {}).out, "");
  EXPECT_NE(run("offers", {"remove", id}).ending, "exit code 0");
  EXPECT_EQ(run("types", {"remove", "Robot"}).ending, "exit code 0");
  EXPECT_EQ(run("types", {}).out, "");
}

TEST(CommandLine, BrokerListensAtTheGivenAddress) {
  const BrokerProcess elsewhere("127.0.0.2");
  EXPECT_THAT(elsewhere.reference(), HasSubstr("@127.0.0.2:"));
  EXPECT_EQ(RunProgram("gsv", {"types", "--broker", elsewhere.reference()}).ending, "exit code 0");
  std::string here = elsewhere.reference();
  here.replace(here.find("127.0.0.2"), 9, "127.0.0.1");
  EXPECT_EQ(RunProgram("gsv", {"types", "--broker", here}).ending, "exit code 5");
}

TEST(CommandLine, RecordsAndReplays) {
  base::testing::TestFolder folder;
  const auto file = (folder.path() / "run.mcap").string();
  const Outcome recorded =
      RunProgram("gsv", RunArguments({"--robot", "pebble@0,0", "--behaviour", "wander",
                                      "--duration", "3", "--record", file}));
  EXPECT_EQ(recorded.ending, "exit code 0") << recorded.err;
  const auto info = RunProgram("gsv", {"rec", "info", file, "--json"}).LastLine();
  EXPECT_NEAR(info["duration_s"].get<double>(), 3.0, 0.1);
  EXPECT_GT(info["messages"].get<int>(), 100);
  const Outcome replayed = RunProgram("gsv", {"replay", file, "--headless", "--json"});
  EXPECT_EQ(replayed.ending, "exit code 0") << replayed.err;
  EXPECT_EQ(replayed.LastLine()["messages"], info["messages"]);
}

TEST(CommandLine, ViewShowsAnotherInstance) {
  Running run("gsv",
              {"run", "playground", "--port", "0", "--robot", "pebble", "--behaviour", "wander"});
  const std::string line = run.AwaitLine("viewer: ");
  Running view("gsv", {"view", line.substr(std::string("viewer: ").size()), "--port", "0"});
  const std::string url = view.AwaitLine("viewer: ").substr(std::string("viewer: ").size());
  const auto simulations = nlohmann::json::parse(HttpGet(url + "api/simulations"), nullptr, false);
  ASSERT_EQ(simulations.size(), 1u);
  EXPECT_EQ(simulations[0]["phase"], "running");
  const auto scene =
      nlohmann::json::parse(HttpGet(url + "api/simulations/simulation/scene"), nullptr, false);
  EXPECT_EQ(std::count_if(scene["bodies"].begin(), scene["bodies"].end(),
                          [](const auto& body) { return body["is_robot"] == true; }),
            1);
}

TEST(CommandLine, BenchTypicalReportsARowForEachNumberOfRobots) {
  const Outcome outcome =
      RunProgram("gsv", {"bench", "typical", "--robots", "1,5", "--duration", "3", "--json"});
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
  const auto rows = outcome.LastLine()["rows"];
  ASSERT_EQ(rows.size(), 2u) << outcome.out;
  EXPECT_EQ(rows[0]["robots"], 1);
  EXPECT_EQ(rows[1]["robots"], 5);
  // This test only checks that each figure was measured, because speed depends on the machine. `gsv
  // bench` itself requires a median of at most 20 ms.
  for (const auto& row : rows) {
    EXPECT_GT(row["real_time_factor_after_start"], 0.0) << row;
    EXPECT_GT(row["update_interval_ms"]["median"], 0.0) << row;
    EXPECT_LE(row["update_interval_ms"]["median"], row["update_interval_ms"]["p99"]) << row;
    EXPECT_GT(row["camera_ms"]["mean"], 0.0) << row;
    EXPECT_GT(row["pictures_per_s"], 0.0) << row;
    EXPECT_GT(row["cycles_per_robot_s"], 0.0) << row;
  }
}

TEST(CommandLine, BenchRigidGivesOneHashForAnyNumberOfThreads) {
  std::set<std::string> hashes;
  const Strings scenes{"rovers", "boxes", "terrain", "arms"};
  for (const std::string& scene : scenes) {
    for (const char* threads : {"1", "2"}) {
      const Outcome outcome =
          RunProgram("gsv", {"bench", "rigid", "--scene", scene, "--bodies", "9", "--duration",
                             "0.5", "--threads", threads, "--json"});
      EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
      const auto figures = outcome.LastLine();
      EXPECT_EQ(figures["steps"], 500);
      EXPECT_EQ(figures["contacts"] > 0, scene != "arms") << figures;
      EXPECT_GT(figures["iterations_per_step"], 0.0) << figures;
      hashes.insert(figures["state_hash"].get<std::string>());
    }
  }
  EXPECT_EQ(hashes.size(), scenes.size());
}

TEST(CommandLine, UsageErrorsExitWithTwo) {
  for (const Strings& arguments :
       {Strings{}, Strings{"fly"}, Strings{"run", "--seed", "x"}, Strings{"run", "--port", "70000"},
        Strings{"bench", "rigid", "--scene", "x"}, Strings{"run", "--robot", "pebble@1"},
        Strings{"run", "--behaviour", "a="}}) {
    const Outcome outcome = RunProgram("gsv", arguments);
    EXPECT_EQ(outcome.ending, "exit code 2") << outcome.err;
    EXPECT_NE(outcome.err, "");
  }
}

TEST(CommandLine, UnknownCommandIsReported) {
  const auto said = [](const Strings& arguments) { return RunProgram("gsv", arguments).err; };
  EXPECT_EQ(said({"fly"}), "gsv: there is no command fly. See gsv --help\n");
  EXPECT_EQ(said({"world", "burn"}), "gsv: there is no command burn. See gsv world --help\n");
  EXPECT_EQ(said({"run", "--duration", "abc"}),
            "gsv: --duration: expected a number, found abc. See gsv run --help\n");
  EXPECT_EQ(said({"--swim"}), "gsv: there is no option --swim. See gsv --help\n");
  EXPECT_EQ(said({"rnu"}), "gsv: there is no command rnu. Did you mean run? See gsv --help\n");
  EXPECT_EQ(said({"help", "rnu"}),
            "gsv: there is no command rnu. Did you mean run? See gsv --help\n");
  EXPECT_EQ(said({"run", "--robott", "pebble"}),
            "gsv: there is no option --robott. Did you mean --robot? See gsv run --help\n");
  EXPECT_EQ(said({"ps", "office", "again"}), "gsv: unexpected argument again. See gsv ps --help\n");
  EXPECT_EQ(said({"rec"}), "gsv: a command is missing. See gsv rec --help\n");
}

// A command that is named first is added without the others.
TEST(CommandLine, EachListedCommandHasAHelpText) {
  std::istringstream help(RunProgram("gsv", {"--help"}).out);
  const std::regex row("  ([a-z][a-z0-9-]+)(  .*)?");
  std::set<std::string> names;
  for (std::string line; std::getline(help, line);) {
    if (std::smatch found; std::regex_match(line, found, row)) names.insert(found[1]);
  }
  EXPECT_THAT(names, IsSupersetOf({"run", "rec", "world", "fit", "ros2", "bench", "set-gravity"}));
  for (const std::string& name : names) {
    const Outcome outcome = RunProgram("gsv", {name, "--help"});
    EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
    EXPECT_THAT(outcome.out, HasSubstr("Usage: gsv " + name));
    EXPECT_EQ(RunProgram("gsv", {"--insecure-corba", name, "--help"}).out, outcome.out);
  }
}

TEST(CommandLine, NamesTheMissingArgumentOptionOrValue) {
  const auto said = [](const Strings& arguments) {
    const Outcome outcome = RunProgram("gsv", arguments);
    EXPECT_EQ(outcome.ending, "exit code 2");
    return outcome.err;
  };
  EXPECT_EQ(said({"ros2", "echo"}), "gsv: missing argument topic. See gsv ros2 echo --help\n");
  EXPECT_EQ(said({"test"}), "gsv: missing argument scenarios. See gsv test --help\n");
  EXPECT_EQ(said({"film", "run.mcap"}), "gsv: missing option --output FILE. See gsv film --help\n");
  EXPECT_EQ(said({"run", "--seed"}), "gsv: --seed: missing value N. See gsv run --help\n");
  EXPECT_EQ(said({"ros2", "echo", "/odom", "--count"}),
            "gsv: --count: missing value N. See gsv ros2 echo --help\n");
  EXPECT_EQ(said({"compare", "log", "--start", "1"}),
            "gsv: --start: expected 3 values, found 1. See gsv compare --help\n");
}

TEST(CommandLine, CheckPrintsProblemsAndExitsWithThreeForAnUnfaithfulWorld) {
  base::testing::TestFolder folder;
  const auto world = folder.Write("bad.sdf", "<sdf version='1.9'><world name='w'><model name='m'>");
  const Outcome bad = RunProgram("gsv", {"world", "check", world.string(), "--json"});
  EXPECT_EQ(bad.ending, "exit code 3");
  EXPECT_EQ(bad.LastLine()["severity"], "error");
  EXPECT_EQ(RunProgram("gsv", {"world", "check", "office"}).ending, "exit code 0");
}

TEST(CommandLine, DrawWritesAnImageOfAWorldAndPrintsItsContent) {
  base::testing::TestFolder folder;
  const std::string image = folder.path() / "office.jpg";
  const Outcome outcome = RunProgram(
      "gsv", {"world", "draw", "office", image, "--width", "160", "--height", "120", "--json"});
  ASSERT_EQ(outcome.ending, "exit code 0") << outcome.err;
  EXPECT_GT(outcome.LastLine()["triangles"], 100);
  std::ifstream file(image, std::ios::binary);
  EXPECT_EQ(file.get(), 0xff);  // a JPEG file begins with these bytes
  EXPECT_EQ(file.get(), 0xd8);
  const std::string png = folder.path() / "office.png";
  ASSERT_EQ(RunProgram("gsv", {"world", "draw", "office", "-o", png}).ending, "exit code 0");
  std::string signature(4, '\0');
  std::ifstream(png, std::ios::binary).read(signature.data(), 4);
  EXPECT_EQ(signature, "\x89PNG");
  const Outcome refused = RunProgram("gsv", {"world", "draw", "office", folder.path() / "x.gif"});
  EXPECT_EQ(refused.ending, "exit code 2");
  EXPECT_THAT(refused.err, HasSubstr("x.gif"));
}

TEST(CommandLine, MisspeltNamesGetASuggestion) {
  const auto said = [](const Strings& arguments) { return RunProgram("gsv", arguments).err; };
  EXPECT_THAT(said({"run", "offise"}), HasSubstr("Did you mean office?"));
  EXPECT_THAT(said(RunArguments({"--robot", "peble"})), HasSubstr("Did you mean pebble?"));
  EXPECT_THAT(said(RunArguments({"--robot", "pebble", "--behaviour", "wandr"})),
              HasSubstr("Did you mean wander?"));
  EXPECT_THAT(said(RunArguments({"--robot", "pebble", "--behaviour", "peble=wander"})),
              HasSubstr("Did you mean pebble?"));
  base::testing::TestFolder folder;
  EXPECT_THAT(said({"run", folder.Write("s.yaml", "world: office\nrobot: []\n")}),
              HasSubstr("Did you mean robots?"));
}

TEST(CommandLine, ListPrintsWorldsRobotsAndBehaviours) {
  const auto listed = [](const char* kind) {
    const Outcome outcome = RunProgram("gsv", {"list", kind, "--json"});
    EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
    return outcome.LastLine().get<Strings>();
  };
  EXPECT_THAT(listed("worlds"), IsSupersetOf({"maze", "office"}));
  EXPECT_THAT(listed("models"), IsSupersetOf({"b21r", "pebble"}));
  EXPECT_THAT(listed("behaviours"), IsSupersetOf({"follow-wall", "wander"}));
  EXPECT_THAT(listed("sensors"), IsSupersetOf({"camera", "sonar"}));
  EXPECT_EQ(RunProgram("gsv", {"list", "dragons"}).ending, "exit code 2");
}

TEST(CommandLine, DrawShowsPedestriansAtTheirStarts) {
  base::testing::TestFolder folder;
  const auto models_in = [&](const std::string& pedestrians) {
    const std::filesystem::path world = folder.path() / "square.sdf";
    std::ofstream(world) << "<sdf version='1.11'><world name='square' xmlns:gsv='https://gsv/'>" +
                                pedestrians + "</world></sdf>";
    const Outcome outcome =
        RunProgram("gsv", {"world", "draw", world, folder.path() / "square.png", "--json"});
    EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
    return outcome.LastLine()["models"].get<int>();
  };
  EXPECT_EQ(models_in(""), 0);
  EXPECT_EQ(models_in("<gsv:pedestrians name='walker' count='3'><gsv:goal>-4 0</gsv:goal>"
                      "<gsv:goal>4 0</gsv:goal></gsv:pedestrians>"),
            3);
}

TEST(CommandLine, LimitsCanBeRaisedByName) {
  EXPECT_EQ(RunProgram("gsv", {"world", "check", "office", "--limit", "xml_bytes=10"}).ending,
            "exit code 3");
  EXPECT_EQ(RunProgram("gsv", {"world", "check", "office", "--limit", "xml_bytes=10000000"}).ending,
            "exit code 0");
  EXPECT_EQ(RunProgram("gsv", {"world", "check", "office", "--limit", "xml=1"}).ending,
            "exit code 2");
}

TEST(CommandLine, FullDiskForTheOutputIsAnError) {
  base::testing::TestFolder folder;
  const std::string recording = folder.path() / "run.mcap";
  ASSERT_EQ(RunProgram("gsv", RunArguments({"--robot", "pebble@0,0", "--duration", "0.2",
                                            "--record", recording}))
                .ending,
            "exit code 0");
  const Strings commands[] = {
      RunArguments({"--robot", "pebble@0,0", "--duration", "0.2"}),
      {"world", "check", "playground"},
      {"rec", "info", recording},
      {"rec", "cat", recording},
      {"rec", "export", recording, "--topic", "/clock"},
      {"--help"},
  };
  for (const Strings& command : commands) {
    Strings arguments{"-c", "exec \"$@\" > /dev/full", "sh", Program("gsv")};
    arguments.insert(arguments.end(), command.begin(), command.end());
    const Outcome outcome = RunProgram("/bin/sh", arguments);
    EXPECT_EQ(outcome.ending, "exit code 5") << command[0] << command[1 % command.size()];
    EXPECT_THAT(outcome.err, HasSubstr("to standard output")) << command[0];
  }
}

TEST(CommandLine, ClosedTerminalEndsTheRunCleanly) {
  base::testing::TestFolder folder;
  const auto bag = folder.path() / "bag";
  Running run("gsv", {"run", "playground", "--port", "0", "--robot", "pebble", "--record", bag});
  run.AwaitLine("viewer: ");
  run.process().Signal(SIGHUP);
  EXPECT_EQ(run.AwaitEnd().ending, "exit code 130");
  EXPECT_TRUE(std::filesystem::exists(bag / "metadata.yaml"));
  EXPECT_EQ(RunProgram("gsv", {"rec", "info", bag, "--json"}).LastLine()["warnings"].size(), 0u);
}

TEST(CommandLine, ExcerptOfARecordingKeepsTheFramesOfSensors) {
  base::testing::TestFolder folder;
  const std::string bag = folder.path() / "bag", part = folder.path() / "part";
  ASSERT_EQ(
      RunProgram("gsv", RunArguments({"--robot", "pebble@0,0", "--duration", "2", "--record", bag}))
          .ending,
      "exit code 0");
  const Outcome cut = RunProgram("gsv", {"rec", "filter", bag, "-o", part, "--from", "1"});
  ASSERT_EQ(cut.ending, "exit code 0") << cut.err;
  EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(part) / "metadata.yaml"));
  const Outcome frames = RunProgram("gsv", {"rec", "cat", part, "--topic", "/tf_static"});
  EXPECT_EQ(frames.ending, "exit code 0") << frames.err;
  EXPECT_EQ(frames.LastLine()["time_s"], 1.0);
}

TEST(CommandLine, EmptySelectionsAreReported) {
  base::testing::TestFolder folder;
  const std::string recording = folder.path() / "run.mcap", part = folder.path() / "part.mcap";
  ASSERT_EQ(RunProgram("gsv", RunArguments({"--robot", "pebble@0,0", "--duration", "0.2",
                                            "--record", recording}))
                .ending,
            "exit code 0");
  const Outcome turned =
      RunProgram("gsv", {"rec", "filter", recording, "-o", part, "--from", "2", "--to", "1"});
  EXPECT_EQ(turned.ending, "exit code 2");
  EXPECT_THAT(turned.err, HasSubstr("--from: must not be after --to"));
  const Outcome unknown =
      RunProgram("gsv", {"rec", "filter", recording, "-o", part, "--topic", "/nowhere"});
  EXPECT_EQ(unknown.ending, "exit code 5");
  EXPECT_THAT(unknown.err, HasSubstr("/nowhere: the recording has no such topic"));
  const Outcome late = RunProgram("gsv", {"rec", "cat", recording, "--from", "100"});
  EXPECT_THAT(late.err, HasSubstr("the selected part has no messages"));
  const Outcome itself =
      RunProgram("gsv", {"rec", "export", recording, "--topic", "/clock", "-o", recording});
  EXPECT_EQ(itself.ending, "exit code 2");
  EXPECT_EQ(RunProgram("gsv", {"rec", "info", recording}).ending, "exit code 0");
}

TEST(CommandLine, UnlikelyArgumentsGiveAWarning) {
  const auto warnings = [](const Strings& more) {
    const Outcome outcome = RunProgram("gsv", RunArguments(more));
    EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
    return outcome.LastLine()["warnings"].dump();
  };
  EXPECT_THAT(warnings({"--robot", "pebble@0,0,90", "--duration", "0.1"}),
              HasSubstr("yaw of 90 rad"));
  EXPECT_THAT(warnings({"--robot", "pebble@500,0", "--duration", "0.1"}),
              HasSubstr("away from all objects"));
  EXPECT_THAT(warnings({"--model-path", "/nowhere", "--duration", "0.1"}),
              HasSubstr("--model-path /nowhere: there is no such folder"));
  EXPECT_THAT(warnings({"--behaviour", "wander", "--duration", "0.1"}),
              HasSubstr("there is no robot"));
  EXPECT_THAT(warnings({"--real-time-factor", "2", "--duration", "0.1"}),
              HasSubstr("--real-time-factor: has no effect with --lockstep"));
  EXPECT_EQ(warnings({"--robot", "pebble@0,0,90deg", "--duration", "0.1"}), "[]");
}

TEST(CommandLine, ArgumentMayFollowARepeatableOption) {
  base::testing::TestFolder folder;
  const Outcome outcome =
      RunProgram("gsv", {"model", "check", "--model-path", folder.path().string(), "pebble"});
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.err;
}

TEST(CommandLine, BehaviourThatCannotBeExecutedIsReported) {
  base::testing::TestFolder folder;
  const std::string program = folder.path() / "gsv-unready";
  std::ofstream(program) << "#!/bin/sh\n";
  const Outcome outcome =
      Running("gsv", RunArguments({"--robot", "pebble", "--behaviour", "unready"}),
              {"env", "PATH=" + folder.path().string() + ":/usr/bin:/bin"})
          .AwaitEnd();
  EXPECT_EQ(outcome.ending, "exit code 4");
  EXPECT_THAT(outcome.err, HasSubstr(program + " is not executable"));
}

// The behaviour's program is killed, and the run does not wait for its answers.
TEST(CommandLine, BehaviourThatNeverWaitsDoesNotDelayTheEnd) {
  base::testing::TestFolder folder;
  std::filesystem::create_symlink(std::filesystem::absolute(Program("../tests/bad_behaviour")),
                                  folder.path() / "gsv-never-ends");
  Running run("gsv",
              {"run", "playground", "--headless", "--lockstep", "--robot", "pebble", "--behaviour",
               "never-ends --fault never-end"},
              {"env", "PATH=" + folder.path().string() + ":/usr/bin:/bin"});
  run.AwaitLine("broker: ");
  const auto start = std::chrono::steady_clock::now();
  run.process().Signal(SIGTERM);
  EXPECT_EQ(run.AwaitEnd().ending, "exit code 130");
  // The calls at the end of a behaviour may take twenty seconds, and this limit is far below.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(8) * base::kSlowdown);
}

// The behaviour cannot be interrupted, and must not delay the end of the run.
TEST(CommandLine, InProcessBehaviourThatNeverReturnsFailsTheRun) {
  base::testing::TestFolder folder;
  const std::string recording = folder.path() / "run.mcap";
  const Outcome outcome =
      Running("gsv",
              RunArguments({"--robot", "pebble", "--behaviour", "endless", "--in-process",
                            "--deadline", "0.1", "--duration", "60", "--record", recording}),
              {"env", "GSV_PLUGIN_PATH=" + Program("../tests").string()})
          .AwaitEnd();
  EXPECT_EQ(outcome.ending, "exit code 4");
  EXPECT_THAT(outcome.err, HasSubstr("the run failed: pebble (endless) has not returned from "
                                     "its turn within 100 ms"));
  EXPECT_THAT(outcome.err, HasSubstr("gsv abandons the simulation"));
  EXPECT_EQ(outcome.LastLine()["phase"], "failed");
  EXPECT_DOUBLE_EQ(outcome.LastLine()["sim_time_s"], 0.2);
  // The recording is closed, and not just truncated.
  const Outcome info = RunProgram("gsv", {"rec", "info", recording, "--json"});
  EXPECT_EQ(info.ending, "exit code 0") << info.err;
  EXPECT_DOUBLE_EQ(info.LastLine()["end_s"], 0.2) << info.out;
  EXPECT_EQ(info.LastLine().value("content_hash", "").size(), 16u) << info.out;
}

}  // namespace
}  // namespace gsv::testing
