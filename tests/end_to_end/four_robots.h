// For tests: four robots of one model near each other, driven by one behaviour for two seconds in
// lockstep. They affect each other. The result must be the same with the behaviour in its own
// program, inside gsv, and repeated from the recording.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {

class FourRobots : public ::testing::Test {
 protected:
  // `model` is SDFormat. `behaviour` is a behaviour of the tests, which exists as a program
  // gsv-BEHAVIOUR and as a library.
  FourRobots(std::string model, std::string behaviour)
      : model_(std::move(model)), behaviour_(std::move(behaviour)) {}

  Outcome Run(const std::vector<std::string>& more) const {
    const std::string model = folder_.Write("robot.sdf", model_).string();
    const std::string world =
        folder_
            .Write("w.sdf",
                   "<sdf version='1.9'><world name='w'><include><uri>model://ground_plane</uri>"
                   "</include></world></sdf>")
            .string();
    std::vector<std::string> arguments = {"run", world};
    for (const char* place : {"0,0", "1.5,0.5", "3.5,0", "-2,-1"}) {
      arguments.insert(arguments.end(), {"--robot", model + "@" + place});
    }
    arguments.insert(arguments.end(), {"--behaviour", behaviour_, "--lockstep", "--duration", "2",
                                       "--headless", "--json"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return Running("gsv", arguments, {"env", "GSV_PLUGIN_PATH=" + Plugins()}).AwaitEnd();
  }

  void ExpectTheSameOverCorbaAndInProcess() const {
    const BrokerProcess broker;
    Running program(Plugins() + "/gsv-" + behaviour_, {"--broker", broker.reference()});
    program.AwaitLine("offered at");
    const Outcome over_corba = Run({"--broker", broker.reference()});
    ASSERT_EQ(over_corba.ending, "exit code 0") << over_corba.out << over_corba.err;
    for (const char* threads : {"1", "2", "3"}) {
      const Outcome in_process = Run({"--in-process", "--threads", threads});
      ASSERT_EQ(in_process.ending, "exit code 0") << in_process.out << in_process.err;
      EXPECT_EQ(in_process.LastLine()["state_hash"], over_corba.LastLine()["state_hash"]);
    }
  }

  void ExpectTheSameAgainFromItsRecording() const {
    const std::string recording = (folder_.path() / "run.mcap").string();
    const Outcome run = Run({"--in-process", "--record", recording});
    ASSERT_EQ(run.ending, "exit code 0") << run.out << run.err;
    const Outcome again =
        RunProgram("gsv", {"replay", recording, "--resimulate", "--commands", "--json"});
    EXPECT_EQ(again.ending, "exit code 0") << again.out << again.err;
    EXPECT_EQ(again.LastLine()["equal"], true) << again.out;
  }

  static std::string Plugins() { return Program("../tests").string(); }

  base::testing::TestFolder folder_;

 private:
  const std::string model_, behaviour_;
};

}  // namespace gsv::testing
