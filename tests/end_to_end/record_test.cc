// Tests recordings of `gsv run` with `gsv rec`.
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Strings = std::vector<std::string>;

class Record : public ::testing::Test {
 protected:
  // Records half a second of the playground with one robot.
  Outcome Run(const Strings& more) const {
    Strings arguments{"run",        "playground", "--headless", "--lockstep", "--json", "--robot",
                      "pebble@0,0", "--duration", "0.5",        "--record",   file_};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return RunProgram("gsv", arguments);
  }
  std::set<std::string> Topics() const {
    std::set<std::string> topics;
    const auto info = RunProgram("gsv", {"rec", "info", file_, "--json"}).LastLine();
    for (const auto& channel : info["channels"]) topics.insert(channel["topic"]);
    return topics;
  }

  const base::testing::TestFolder folder_{};
  const std::string file_ = folder_.path() / "run.mcap";
};

TEST_F(Record, UnknownTopicsAreReportedWithTheKnownOnes) {
  const Outcome run = Run({"--record-topics", "/nonsense,/pebble,/clock"});
  EXPECT_EQ(run.ending, "exit code 0") << run.err;
  const std::string nonsense =
      "--record-topics /nonsense: there is no topic of this name or below it; topics are /clock, "
      "/diagnostics, /gsv/actuators, /gsv/beams, ";
  const std::string pebble =
      "--record-topics /pebble: there is no topic of this name; use \"/pebble/\" for all topics "
      "below it";
  EXPECT_THAT(run.LastLine()["warnings"].get<Strings>(), ElementsAre(HasSubstr(nonsense), pebble));
  EXPECT_THAT(run.err, HasSubstr("gsv: warning: " + nonsense));
  EXPECT_THAT(run.err, HasSubstr("gsv: warning: " + pebble));
  EXPECT_EQ(Topics(), (std::set<std::string>{"/clock"}));
}

TEST_F(Record, TopicsThatMatchGiveNoWarning) {
  const Outcome run = Run({"--record-topics", "/gsv/contacts,/pebble/"});
  EXPECT_EQ(run.ending, "exit code 0") << run.err;
  EXPECT_EQ(run.LastLine()["warnings"].size(), 0u) << run.out;
}

TEST_F(Record, InvalidNameIsRejected) {
  for (const std::string word : {"true", "false"}) {
    const Outcome run = RunProgram("gsv", {"run", "playground", "--headless", "--record", word});
    EXPECT_EQ(run.ending, "exit code 2");
    EXPECT_EQ(run.err, "gsv: --record: expected a file NAME.mcap or a folder, found \"" + word +
                           "\". See gsv run --help\n");
    EXPECT_FALSE(std::filesystem::exists(word));
  }
}

TEST_F(Record, TopicWithoutASlashIsRejected) {
  const Outcome run = Run({"--record-topics", "nonsense"});
  EXPECT_EQ(run.ending, "exit code 2");
  EXPECT_EQ(run.err,
            "gsv: --record-topics nonsense: a topic must begin with a slash, such as /gsv/poses or "
            "/ROBOT/SENSOR\n");
  EXPECT_FALSE(std::filesystem::exists(file_));
}

}  // namespace
}  // namespace gsv::testing
