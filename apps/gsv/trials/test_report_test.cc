#include "apps/gsv/trials/test_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gsv::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using Status = TestResult::Status;

TestResult Passed() {
  TestResult result{{"s/a.yaml", "s/a"}, Status::kPassed};
  result.wall_seconds = 1.25;
  result.hashes = {"00", "00"};
  result.report = {{"sim_time_s", 2.5}};
  return result;
}

TestResult Failed() {
  TestResult result{{"b.yaml", "b"}, Status::kFailed, "\"x\" < 1 & <y>\nsecond line\x01"};
  result.command = "gsv run b.yaml";
  result.folder = "/f/b";
  result.wall_seconds = 0.5;
  return result;
}

TestResult Interrupted() { return {{"c.yaml", "c"}, Status::kInterrupted, "stopped"}; }

TEST(TestReport, TextOfAPassedScenarioIsOneLine) {
  EXPECT_EQ(ToText(Passed()), "PASS  s/a  1.2 s (2.5 s simulated, 2 times)\n");
}

TEST(TestReport, TextOfAFailureHasTheHealthOfItsFirstRobots) {
  TestResult result = Failed();
  result.health = "scout was stuck from 7.4 s: touches wall";
  EXPECT_THAT(ToText(result),
              HasSubstr("      at the end:\n      scout was stuck from 7.4 s: touches wall\n"));
  for (int i = 1; i <= 9; ++i) result.health += "\nr" + std::to_string(i) + " stood still";
  EXPECT_THAT(ToText(result),
              HasSubstr("      r7 stood still\n      and 2 more, see README.txt\n"));
  EXPECT_THAT(ToJUnit({result}, 1), HasSubstr("r9 stood still"));
}

TEST(TestReport, TextOfAFailureContainsReasonAndCommand) {
  EXPECT_EQ(ToText(Failed()),
            "FAIL  b  0.5 s\n      \"x\" < 1 & <y>\n      second line\x01\n"
            "      see /f/b/README.txt\n      again: gsv run b.yaml\n");
}

TEST(TestReport, JUnitCountsAndEscapes) {
  const std::string xml = ToJUnit({Passed(), Failed(), Interrupted()}, 2);
  EXPECT_THAT(xml,
              HasSubstr("tests=\"3\" failures=\"1\" errors=\"0\" skipped=\"1\" time=\"2.000\""));
  EXPECT_THAT(xml, HasSubstr("<testcase classname=\"s\" name=\"a\" time=\"1.250\"/>"));
  EXPECT_THAT(xml, HasSubstr("<testcase classname=\"scenarios\" name=\"b\""));
  EXPECT_THAT(xml, HasSubstr("<failure message=\"&quot;x&quot; &lt; 1 &amp; &lt;y&gt;\">"));
  EXPECT_THAT(
      xml, HasSubstr(
               "second line&#10;&#10;To repeat the run: gsv run b.yaml&#10;Files: /f/b</failure>"));
  EXPECT_THAT(xml, HasSubstr("<skipped message=\"stopped\">"));
  EXPECT_THAT(xml, Not(HasSubstr("\x01"))) << "XML 1.0 cannot hold it";
}

TEST(TestReport, JsonContainsTheReportsOfTheRuns) {
  const auto json = nlohmann::json::parse(ToJson({Passed(), Failed(), Interrupted()}, 2));
  EXPECT_EQ(json["passed"], 1);
  EXPECT_EQ(json["failed"], 1);
  EXPECT_EQ(json["errors"], 0);
  EXPECT_EQ(json["wall_s"], 2.0);
  ASSERT_EQ(json["results"].size(), 3u);
  EXPECT_EQ(json["results"][0]["report"]["sim_time_s"], 2.5);
  EXPECT_EQ(json["results"][0]["state_hashes"], nlohmann::json({"00", "00"}));
  EXPECT_EQ(json["results"][1]["status"], "failed");
  EXPECT_EQ(json["results"][1]["command"], "gsv run b.yaml");
  EXPECT_EQ(json["results"][2]["status"], "interrupted");
}

TEST(TestReport, JsonReplacesInvalidUtf8) {
  TestResult result = Failed();
  result.message = "caf\xe9";
  EXPECT_EQ(nlohmann::json::parse(ToJson({result}, 0))["results"][0]["message"], "caf\ufffd");
}

}  // namespace
}  // namespace gsv::app
