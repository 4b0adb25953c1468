#include "gsv/campaign/spool.h"

#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/base/temporary_folder.h"
#include "gsv/campaign/queue_cost.h"

namespace gsv::campaign {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

Campaign FourRuns() {
  Campaign campaign;
  campaign.scenario = "world: maze\nseed: 1\n";
  campaign.parameters = {{"seed", Parameter::Kind::kList, {"1", "2", "3", "4"}},
                         {"x", Parameter::Kind::kNormal, {}, 0.1, 1e-3}};
  campaign.draw_seed = ~std::uint64_t{0};
  return campaign;
}

RunResult Result(std::int64_t run) {
  RunResult result{run, "failed", "why \"it\" failed\n\xff", "0123456789abcdef", 1.5, 0.25, "a/b"};
  result.parameters = {{"seed", "1"}, {"x", "0.1"}};
  result.metrics = {{"way", 0.1}};
  return result;
}

Attempt AttemptAt(const std::string& share, double started = 101) {
  Attempt attempt{"", share, "17", "n1"};
  attempt.submitted = 100;
  attempt.started = started;
  return attempt;
}

class SpoolTest : public ::testing::Test {
 protected:
  std::string text(const fs::path& file) const {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
  }

  base::TemporaryFolder temporary_ = *base::TemporaryFolder::Make("gsv-spool");
  const fs::path folder_ = temporary_.path() / "c.runs";
  const std::string results_file_ = temporary_.path() / "c.sqlite";
};

TEST_F(SpoolTest, PlanContainsTheCampaign) {
  ASSERT_TRUE(Spool::Make(folder_, FourRuns()));
  const auto spool = Spool::Open(folder_);
  ASSERT_TRUE(spool) << spool.error().Sentence();
  EXPECT_EQ(spool->campaign().Definition(), FourRuns().Definition());
  EXPECT_EQ(spool->campaign().ValuesOf(3), FourRuns().ValuesOf(3));
  Campaign other = FourRuns();
  other.parameters[0].values.back() = "5";
  const auto refused = Spool::Make(folder_, other);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, base::ErrorCode::kInvalidArgument);
  EXPECT_EQ(Spool::Open(folder_ / "none").error().code, base::ErrorCode::kNotFound);
  std::ofstream(folder_ / "plan.json", std::ios::app) << "}";
  EXPECT_EQ(Spool::Open(folder_).error().code, base::ErrorCode::kCorrupt);
}

TEST_F(SpoolTest, ReadsBackABatchUnchanged) {
  const auto spool = Spool::Make(folder_, FourRuns());
  ASSERT_TRUE(spool);
  const Batch batch{2, "gsv-x-2", "17", 1e9 + 0.25, 3, {5, 7, 9, 11}, 12.5, "/f"};
  ASSERT_TRUE(spool->Put(batch));
  const auto batches = spool->Batches();
  ASSERT_TRUE(batches && batches->size() == 1);
  const Batch& read = batches->front();
  EXPECT_EQ(read.name, "gsv-x-2");
  EXPECT_EQ(read.submitted, 1e9 + 0.25);
  EXPECT_EQ(read.tasks(), 2u);
  EXPECT_THAT(read.RunsOf(0), ElementsAre(5, 7, 9));
  EXPECT_THAT(read.RunsOf(1), ElementsAre(11));
  EXPECT_THAT(read.RunsOf(2), ElementsAre());
  EXPECT_EQ(read.timeout, 12.5);
  std::ofstream(spool->FileOf(batch)) << "{\"number\": 2, \"na";
  EXPECT_EQ(spool->Batches().error().code, base::ErrorCode::kCorrupt);
  EXPECT_THAT(ReadBatch(folder_ / "batch-0003.json").error().Sentence(),
              HasSubstr("this machine can read the folder"));
}

TEST_F(SpoolTest, ReadsAGrowingJournalAndIgnoresAnIncompleteLine) {
  auto spool = Spool::Make(folder_, FourRuns());
  ASSERT_TRUE(spool);
  const auto journal = JournalWriter::Create(spool->journals(), AttemptAt("s"));
  ASSERT_TRUE(journal);
  ASSERT_TRUE((*journal)->Begin(2));
  EXPECT_TRUE(spool->Collect()->empty());
  const JournalReader& reader = spool->read().begin()->second;
  EXPECT_THAT(reader.open_runs(), ElementsAre(2));
  ASSERT_TRUE((*journal)->Add(Result(2)));
  const auto results = spool->Collect();
  ASSERT_EQ(results->size(), 1u);
  EXPECT_EQ(results->front().message, "why \"it\" failed\n\ufffd");
  EXPECT_EQ(results->front().metrics, Result(2).metrics);
  EXPECT_EQ(results->front().wall_time, 0.25);
  EXPECT_TRUE(reader.open_runs().empty());
  // An incomplete or damaged line is ignored. A killed task, a full disk, or different caches of
  // two machines can cause such a line.
  ASSERT_TRUE((*journal)->Add(Result(3)));
  ASSERT_EQ(spool->Collect()->size(), 1u);
  const std::string whole = text(reader.file());
  const std::string line = whole.substr(whole.rfind('\n', whole.size() - 2) + 1);
  for (const std::string& torn :
       {line.substr(0, line.size() / 2) + "\n", std::string(64, '\0') + "\n", "x" + line,
        line.substr(0, 40) + '7' + line.substr(41)}) {
    std::ofstream(reader.file(), std::ios::app | std::ios::binary) << torn;
    EXPECT_TRUE(spool->Collect()->empty());
  }
  EXPECT_EQ(reader.torn_lines(), 4u);
  std::ofstream(reader.file(), std::ios::app | std::ios::binary) << line.substr(0, 30);
  EXPECT_TRUE(spool->Collect()->empty()) << "its end may still come";
  std::ofstream(reader.file(), std::ios::app | std::ios::binary) << line.substr(30);
  EXPECT_EQ(spool->Collect()->size(), 1u);
}

TEST_F(SpoolTest, RunOfSeveralAttemptsCountsOnce) {
  auto spool = Spool::Make(folder_, FourRuns());
  auto results = Results::OpenToAdd(results_file_, FourRuns());
  ASSERT_TRUE(spool && results);
  for (const double started : {101.0, 105.0}) {
    const auto journal = JournalWriter::Create(spool->journals(), AttemptAt("s", started));
    ASSERT_TRUE(journal);
    for (const std::int64_t run : {0, 1}) ASSERT_TRUE((*journal)->Add(Result(run)));
    ASSERT_TRUE((*journal)->Add(Result(4))) << "which the campaign does not have";
    ASSERT_TRUE((*journal)->End());
  }
  ASSERT_TRUE(Gather(*spool, **results));
  // Another reader finds the same results. Gather() has nothing to add.
  auto later = Spool::Open(folder_);
  ASSERT_TRUE(Gather(*later, **results));
  EXPECT_THAT(*(*results)->DoneRuns(), ElementsAre(0, 1));
  const auto attempts = (*results)->Attempts();
  ASSERT_EQ(attempts->size(), 2u);
  EXPECT_EQ((*attempts)[1].started, 105);
  EXPECT_EQ((*attempts)[1].runs, 3u);
  EXPECT_EQ(*(*results)->NotPassed(), 2u);
}

TEST(QueueCostTest, AddsUpWaitsOverheadAndIdleTime) {
  // There are two slots. One executes "a" from 2 to 6 and "c" from 7 to 10. The other executes "b"
  // from 3 to 10; "b" was requeued, so it has a first attempt from 3 to 4 and a second one from 5
  // to 10.
  const auto attempt = [](const char* share, const char* node, double started, double ended,
                          double run_seconds) {
    Attempt made{"", share, "17", node};
    made.started = started;
    made.ended = ended;
    made.run_seconds = run_seconds;
    return made;
  };
  const auto cost = CostOf({attempt("a", "n1", 2, 6, 3), attempt("b", "n1", 3, 4, 0),
                            attempt("b", "n2", 5, 10, 4), attempt("c", "n1", 7, 10, 2.5)});
  ASSERT_TRUE(cost);
  EXPECT_EQ(cost->tasks, 4u);
  EXPECT_EQ(cost->requeued, 1u);
  EXPECT_EQ(cost->nodes, 2u);
  EXPECT_EQ(cost->slots, 2u);
  EXPECT_EQ(cost->mean_wait, 4);  // the mean of the waiting times 2, 3 and 7
  EXPECT_EQ(cost->max_wait, 7);
  EXPECT_EQ(cost->run_seconds, 9.5);
  EXPECT_EQ(cost->task_seconds, 13);
  EXPECT_EQ(cost->idle_seconds, 2 * 8 - 13);
  EXPECT_EQ(cost->span, 10);
  EXPECT_THAT(Sentence(*cost), HasSubstr("4 tasks (1 requeued) on 2 nodes"));
  Attempt no_queue;
  no_queue.share = "shard-1-of-2";
  EXPECT_FALSE(CostOf({no_queue}));
}

}  // namespace
}  // namespace gsv::campaign
