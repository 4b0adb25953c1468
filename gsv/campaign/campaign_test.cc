#include <filesystem>
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/base/temporary_folder.h"
#include "gsv/campaign/campaign.h"
#include "gsv/campaign/local_engine.h"
#include "gsv/campaign/report.h"
#include "gsv/scenario/scenario_file.h"

namespace gsv::campaign {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class CampaignTest : public ::testing::Test {
 protected:
  CampaignTest() : folder_(*base::TemporaryFolder::Make("gsv-campaign")) {
    std::ofstream(folder_.path() / "s.yaml")
        << "world: maze\nduration: 3\nrobots: [{name: r, model: pebble, x: 0, y: 1}]\n"
           "expect: [{reaches: {robot: r, x: 1, y: 1}, by: 2}]\n";
  }
  base::Result<Campaign> Read(const std::string& text) {
    problems_.clear();
    std::ofstream(folder_.path() / "c.yaml") << text;
    return ReadCampaign(folder_.path() / "c.yaml", problems_);
  }
  std::string file() const { return folder_.path() / "results.sqlite"; }

  base::TemporaryFolder folder_;
  base::Problems problems_;
};

TEST_F(CampaignTest, ListsFormAGridAndDrawsDependOnTheSeed) {
  const auto campaign = Read(
      "scenario: s.yaml\ndraws: 3\ndraw_seed: 5\nparameters:\n"
      "  seed: {from: 1, to: 2}\n"
      "  robots[0].x: [-1, 0.5]\n"
      "  robots[0].yaw: {uniform: [2, 3]}\n");
  ASSERT_TRUE(campaign && problems_.empty());
  ASSERT_EQ(campaign->runs(), 12u);
  std::vector<std::string> seeds, drawn;
  for (std::size_t run = 0; run < 12; ++run) {
    const auto values = campaign->ValuesOf(run);
    EXPECT_EQ(values[1], run % 2 == 0 ? "-1" : "0.5");
    seeds.push_back(values[0]);
    EXPECT_GE(std::stod(values[2]), 2);
    EXPECT_LT(std::stod(values[2]), 3);
    EXPECT_EQ(std::count(drawn.begin(), drawn.end(), values[2]), 0) << "drawn twice";
    drawn.push_back(values[2]);
  }
  EXPECT_THAT(std::vector<std::string>(seeds.begin(), seeds.begin() + 4),
              ElementsAre("1", "1", "2", "2"));
  EXPECT_EQ(campaign->ValuesOf(7), campaign->ValuesOf(7));
  base::Problems problems;
  const auto text = campaign->ScenarioWith({"7", "0.5", "2.25"});
  ASSERT_TRUE(text);
  const auto scenario = scenario::ParseScenario(*text, "variant", problems);
  ASSERT_TRUE(scenario && problems.empty()) << *text;
  EXPECT_EQ(scenario->seed, 7u);
  EXPECT_EQ(scenario->robots[0].start, (scenario::Place{0.5, 1, {}, 2.25}));
  EXPECT_EQ(scenario->expect.size(), 1u);
}

TEST_F(CampaignTest, QuotedTextsKeepTheirCharacters) {
  const auto campaign = Read(
      "scenario: s.yaml\nparameters:\n"
      "  robots[0].name: ['a \"b\"', 'C:\\new', \"plain\", '5']\n");
  ASSERT_TRUE(campaign);
  const char* const names[]{"a \"b\"", "C:\\new", "plain", "5"};
  for (std::size_t run = 0; run < 4; ++run) {
    const auto text = campaign->ScenarioWith(campaign->ValuesOf(run));
    ASSERT_TRUE(text);
    base::Problems problems;
    const auto scenario = scenario::ParseScenario(*text, "variant", problems);
    ASSERT_TRUE(scenario) << *text;
    EXPECT_EQ(scenario->robots.at(0).name, names[run]) << *text;
  }
  EXPECT_EQ(campaign->ValuesOf(2), std::vector<std::string>{"plain"});
}

TEST_F(CampaignTest, ReportsErrorsBeforeAnythingRuns) {
  const std::pair<const char*, const char*> bad[]{
      {"parameters: {seed: [1]}", "the key scenario is required"},
      {"scenario: s.yaml\nparameters: {seed: []}", "c.yaml:2:20: the list is empty"},
      {"scenario: s.yaml\nparameters: {seed: {from: 3, to: 1}}",
       "\"from\" is 3, but must not be larger than \"to\", which is 1"},
      {"scenario: s.yaml\nparameters: {seed: {uniform: [1]}}", "uniform must be two numbers"},
      {"scenario: s.yaml\nparameters: {seed: {gauss: [1, 2]}}", "a parameter must be a list"},
      {"scenario: s.yaml\nparameters: {'robots[3].x': [1]}", "the scenario has no such key"},
      {"scenario: s.yaml\nparameters: {seed: [1, -1]}", "seed = -1: seed must be a whole number"},
      {"scenario: s.yaml\nengine: pbs", "c.yaml:2:9: there is no engine \"pbs\""},
      {"scenario: s.yaml\nruns: 3", "there is no key \"runs\" here"}};
  for (const auto& [text, sentence] : bad) {
    const auto campaign = Read(text);
    std::string said = campaign ? "" : campaign.error().Sentence();
    for (const auto& problem : problems_) said += problem.Sentence() + "\n";
    EXPECT_THAT(said, HasSubstr(sentence)) << text;
  }
  EXPECT_FALSE(Read("scenario: none.yaml"));
}

LocalEngine EngineThatExecutes(std::vector<std::atomic<int>>& executed, std::size_t most) {
  LocalEngine engine;
  engine.jobs = 3;
  auto begun = std::make_shared<std::atomic<std::size_t>>(0);
  engine.execute = [&executed, begun, most](std::int64_t run,
                                            const std::atomic<bool>&) -> std::optional<RunResult> {
    if ((*begun)++ >= most) return std::nullopt;
    ++executed[static_cast<std::size_t>(run)];
    return RunResult{run, run % 3 == 0 ? "failed" : "passed"};
  };
  return engine;
}

TEST_F(CampaignTest, SecondDriverContinuesTheRunsAndEachRunCountsOnce) {
  const auto campaign = Read("scenario: s.yaml\nparameters: {seed: {from: 0, to: 299}}");
  ASSERT_TRUE(campaign && problems_.empty());
  std::vector<std::atomic<int>> executed(300);
  {
    const auto results = Results::OpenToAdd(file(), *campaign);
    ASSERT_TRUE(results) << results.error().Sentence();
    ASSERT_TRUE(EngineThatExecutes(executed, 120).Run(**results));
    EXPECT_EQ((*results)->DoneRuns()->size(), 120u);
    const auto second = Results::OpenToAdd(file(), *campaign);
    ASSERT_FALSE(second);
    EXPECT_THAT(second.error().Sentence(),
                HasSubstr("another `gsv campaign run` is writing to it"));
  }
  const auto results = Results::OpenToAdd(file(), *campaign);
  ASSERT_TRUE(results);
  Progress last_reported;
  LocalEngine engine = EngineThatExecutes(executed, 1000);
  engine.report = [&](const Progress& progress) { last_reported = progress; };
  ASSERT_TRUE(engine.Run(**results));
  for (const auto& times : executed) EXPECT_EQ(times, 1);
  EXPECT_EQ(*(*results)->NotPassed(), 100u);
  EXPECT_EQ(last_reported.done, 300u);
  EXPECT_EQ(last_reported.not_passed, 100u);  // includes the runs of the first driver
  ASSERT_TRUE((*results)->Add({RunResult{5, "error"}}));
  const auto all = (*results)->All();
  ASSERT_TRUE(all);
  ASSERT_EQ(all->size(), 300u);
  EXPECT_EQ((*all)[5].status, "passed");
}

TEST_F(CampaignTest, ResultsOfAnotherCampaignAreNotChanged) {
  const auto one = Read("scenario: s.yaml\nparameters: {seed: [1, 2]}");
  ASSERT_TRUE(one);
  ASSERT_TRUE(Results::OpenToAdd(file(), *one));
  const auto other = Read("scenario: s.yaml\nparameters: {seed: [1, 3]}");
  const auto refused = Results::OpenToAdd(file(), *other);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, base::ErrorCode::kInvalidArgument);
  std::ofstream(file()) << "no database, but long enough to be executed for one, if nobody looked";
  EXPECT_FALSE(Results::Open(file()));
  EXPECT_EQ(Results::Open(file() + "x").error().code, base::ErrorCode::kNotFound);
}

TEST_F(CampaignTest, DatabaseOfAnotherProgramIsNotChanged) {
  const auto campaign = Read("scenario: s.yaml\nparameters: {seed: [1, 2]}");
  ASSERT_TRUE(campaign);
  const auto content = [&] {
    std::ostringstream bytes;
    bytes << std::ifstream(file(), std::ios::binary).rdbuf();
    return bytes.str();
  };
  ASSERT_TRUE(broker::Database::Open(file())->Run("CREATE TABLE songs (title TEXT)"));
  const std::string before = content();
  const auto refused = Results::OpenToAdd(file(), *campaign);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, base::ErrorCode::kInvalidArgument);
  EXPECT_THAT(refused.error().Sentence(), HasSubstr("is the database of another program"));
  EXPECT_EQ(content(), before);
}

TEST_F(CampaignTest, LockedOrIncompleteResultsFileLosesNoResults) {
  const auto campaign = Read("scenario: s.yaml\nparameters: {seed: {from: 0, to: 999}}");
  ASSERT_TRUE(campaign);
  std::vector<RunResult> many;
  for (std::int64_t run = 1; run < 1000; ++run) many.push_back({run, "passed"});
  {
    const auto results = Results::OpenToAdd(file(), *campaign);
    ASSERT_TRUE(results);
    auto other = broker::Database::Open(file());
    ASSERT_TRUE(other && other->Run("BEGIN IMMEDIATE"));
    const auto refused = (*results)->Add(many);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, base::ErrorCode::kUnavailable);
    EXPECT_EQ(refused.error().Sentence(), file() +
                                              ": database is locked: another program uses it; when "
                                              "that has ended, run the same command again");
    ASSERT_TRUE(other->Run("ROLLBACK"));
    ASSERT_TRUE((*results)->Add(many));
  }
  const auto size = std::filesystem::file_size(file());
  std::filesystem::resize_file(file(), size / 2);
  const auto torn = Results::Open(file());
  const auto all = torn ? (*torn)->All() : base::Fail(torn.error());
  ASSERT_FALSE(all);
  EXPECT_THAT(all.error().Sentence(), HasSubstr(file()));
  EXPECT_THAT(all.error().Sentence(), HasSubstr("malformed"));
}

TEST(CampaignStatistics, IntervalsEqualPublishedValues) {
  // The expected values are Wilson's interval for 8 of 10, and Student's interval for 1, 2, 3, 4, 5
  // (t = 2.7764, s = 1.5811).
  const Interval rate = PassRate(8, 10);
  EXPECT_EQ(rate.middle, 0.8);
  EXPECT_NEAR(rate.low, 0.4902, 1e-4);
  EXPECT_NEAR(rate.high, 0.9433, 1e-4);
  EXPECT_EQ(PassRate(5, 5).high, 1);
  const Interval mean = Mean({1, 2, 3, 4, 5});
  EXPECT_EQ(mean.middle, 3);
  EXPECT_NEAR(mean.high, 3 + 2.7764 * 1.58114 / 2.23607, 1e-3);
  std::vector<double> many(121);
  for (std::size_t i = 0; i < many.size(); ++i) many[i] = i % 2 == 0 ? 1 : -1;
  // Student's t for 120 degrees of freedom is 1.9799.
  const double s = std::sqrt((121 - 1.0 / 121) / 120);
  EXPECT_NEAR(Mean(many).high - Mean(many).middle, 1.9799 * s / 11, 1e-4);
}

TEST(CampaignReport, RunsAreGroupedByTheirParameters) {
  std::vector<RunResult> results;
  for (int run = 0; run < 20; ++run) {
    RunResult result{run, run % 4 == 0 ? "failed" : "passed"};
    result.parameters = {{"speed", run % 2 == 0 ? "slow" : "a,\"b\"<"},
                         {"seed", std::to_string(run)}};
    result.metrics = {{"way", run}};
    results.push_back(result);
  }
  const Report report = MakeReport(results, {}, {"speed", "seed"}, {"way"});
  EXPECT_THAT(report.parameters, ElementsAre("speed"));
  ASSERT_EQ(report.groups.size(), 2u);
  EXPECT_EQ(report.groups[0].passed, 5u);
  EXPECT_EQ(report.groups[1].passed, 10u);
  EXPECT_THAT(ToText(report), HasSubstr("slow    10    5       0.5 [0.2366, 0.7634]"));
  // the interval of the mean is 9 ± 2.2622 · 6.0553 / √10
  EXPECT_THAT(ToText(report), HasSubstr("9 [4.668, 13.33]"));
  EXPECT_THAT(ToHtml(report), HasSubstr("a,\"b\"&lt;"));
  EXPECT_THAT(ToCsv(results, {"speed"}), HasSubstr("\r\n1,\"a,\"\"b\"\"<\",passed,,0,0,,,1\r\n"));
}

}  // namespace
}  // namespace gsv::campaign
