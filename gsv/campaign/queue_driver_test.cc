// Tests the driver of job queues with a queue and nodes that the test simulates.
#include "gsv/campaign/queue_driver.h"

#include <deque>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/base/temporary_folder.h"

namespace gsv::campaign {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using Runs = std::vector<std::int64_t>;

struct FakeQueue final : JobQueue {
  base::Result<std::size_t> MaxTasks() override { return max_tasks; }
  base::Result<std::string> Submit(const Spool&, const Batch& batch) override {
    if (held.size() + batch.tasks() > room)
      return base::Fail(base::ErrorCode::kNotRunning, "it is full", "submit");
    for (std::size_t task = 0; task < batch.tasks(); ++task)
      held[batch.ShareOf(task)] = {batch, batch.RunsOf(task)};
    submitted.push_back(batch);
    return "job " + std::to_string(batch.number);
  }
  base::Result<std::map<std::string, QueuedTask>> TasksOf(const std::vector<Batch>&) override {
    if (failure) return base::Fail(*failure);
    std::map<std::string, QueuedTask> tasks;
    for (const auto& [share, task] : held) tasks[share] = {"RUNNING", ""};
    return tasks;
  }

  struct Task {
    Batch batch;
    Runs runs;
  };
  std::size_t max_tasks = 100, room = 1000;
  std::optional<base::Error> failure;
  std::map<std::string, Task> held;
  std::vector<Batch> submitted;
};

class QueueDriverTest : public ::testing::Test {
 protected:
  static Campaign TenRuns() {
    Campaign campaign;
    campaign.scenario = "world: maze\n";
    campaign.parameters = {
        {"seed", Parameter::Kind::kList, {"1", "2", "3", "4", "5", "6", "7", "8", "9", "10"}}};
    return campaign;
  }

  // Simulates a node that executes the first `count` runs of the task. If `crashes` is true, the
  // node begins one more run, and the task ends during this run. Then the task leaves the queue.
  void Do(const std::string& share, std::size_t count = 1000, bool crashes = false) {
    const auto task = queue_.held.extract(share);
    ASSERT_FALSE(task.empty()) << share;
    Attempt attempt{"", share, "job", "n1"};
    attempt.started = static_cast<double>(++attempts_);
    const auto journal = JournalWriter::Create(spool_.journals(), attempt);
    ASSERT_TRUE(journal);
    for (const std::int64_t run : task.mapped().runs) {
      if (count == 0 && crashes) {
        ASSERT_TRUE((*journal)->Begin(run));
      }
      if (count-- == 0) return;
      ASSERT_TRUE((*journal)->Begin(run));
      ASSERT_TRUE((*journal)->Add({run, "passed"}));
    }
    ASSERT_TRUE((*journal)->End());
  }
  void DoAll() {
    while (!queue_.held.empty()) Do(queue_.held.begin()->first);
  }
  // Adds an event that occurs while the driver waits. The driver is interrupted after the last
  // event.
  void Then(std::function<void()> event) { events_.push_back(std::move(event)); }

  base::Status Drive(const std::function<void(QueueDriver&)>& set = {}) {
    QueueDriver driver{queue_, "The queue"};
    driver.runs_per_task = 2;
    driver.poll_period = std::chrono::milliseconds(0);
    driver.say = [this](const std::string& sentence) { said_.push_back(sentence); };
    driver.is_interrupted = [this](std::chrono::milliseconds) {
      if (events_.empty()) return true;
      events_.front()();
      events_.pop_front();
      return false;
    };
    if (set) set(driver);
    return driver.Run(spool_, *results_);
  }
  std::size_t Done() { return results_->DoneRuns()->size(); }
  static Runs RunsOf(const std::vector<Batch>& batches) {
    Runs runs;
    for (const Batch& batch : batches)
      runs.insert(runs.end(), batch.runs.begin(), batch.runs.end());
    return runs;
  }

  const base::TemporaryFolder temporary_ = *base::TemporaryFolder::Make("gsv-queue-driver");
  Spool spool_ = *Spool::Make(temporary_.path() / "c.runs", TenRuns());
  std::unique_ptr<Results> results_ =
      *Results::OpenToAdd(temporary_.path() / "c.sqlite", TenRuns());
  FakeQueue queue_;
  std::deque<std::function<void()>> events_;
  std::vector<std::string> said_;
  int attempts_ = 0;
};

TEST_F(QueueDriverTest, RunsAreSubmittedInBatchesOfTheQueuesMaximumLength) {
  queue_.max_tasks = 3;
  Then([this] { DoAll(); });
  ASSERT_TRUE(Drive());
  EXPECT_EQ(Done(), 10u);
  ASSERT_EQ(queue_.submitted.size(), 2u);
  EXPECT_THAT(queue_.submitted[0].runs, ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(queue_.submitted[1].runs, ElementsAre(6, 7, 8, 9));
  EXPECT_EQ(queue_.submitted[1].tasks(), 2u);
  EXPECT_THAT(said_.front(), HasSubstr("The queue: submitted 6 runs in 3 tasks, job job 1, gsv-"));
}

TEST_F(QueueDriverTest, RunsPerTaskAreChosenSoThatOneBatchSuffices) {
  queue_.max_tasks = 3;
  Then([this] { DoAll(); });
  ASSERT_TRUE(Drive([](QueueDriver& driver) { driver.runs_per_task = 0; }));
  ASSERT_EQ(queue_.submitted.size(), 1u);
  EXPECT_EQ(queue_.submitted[0].runs_per_task, 4u);  // 10 / 3, rounded up
}

TEST_F(QueueDriverTest, RunsOfALostTaskAreSubmittedAgainAfterTwoQueries) {
  Then([this] {
    Do("batch-0001-task-0000", 0, true);  // the task ended during run 0
    queue_.held.erase("batch-0001-task-0003");
  });
  Then([this] { EXPECT_EQ(queue_.submitted.size(), 1u) << "after one look"; });
  Then([this] {
    ASSERT_EQ(queue_.submitted.size(), 2u);
    EXPECT_THAT(queue_.submitted[1].runs, ElementsAre(1, 6, 7, 0));
    DoAll();
  });
  ASSERT_TRUE(Drive());
  EXPECT_EQ(Done(), 10u);
}

TEST_F(QueueDriverTest, RunThatCrashesItsTaskThreeTimesIsAnError) {
  for (int attempt = 0; attempt < 3; ++attempt) {
    Then([this] {
      while (!queue_.held.empty()) {
        const auto& [share, task] = *queue_.held.begin();
        const bool is_run_4 = task.runs[0] == 4;
        Do(std::string(share), is_run_4 ? 0 : 1, is_run_4);
      }
    });
    Then([] {});
  }
  ASSERT_TRUE(Drive([](QueueDriver& driver) { driver.runs_per_task = 1; }));
  EXPECT_EQ(queue_.submitted.size(), 3u);
  const auto all = results_->All();
  ASSERT_EQ(all->size(), 10u);
  EXPECT_EQ((*all)[4].status, "error");
  EXPECT_THAT((*all)[4].message, HasSubstr("its task ended 3 times during the run"));
  EXPECT_EQ((*all)[4].parameters.at("seed"), "5");
  EXPECT_EQ(*results_->NotPassed(), 1u);
}

TEST_F(QueueDriverTest, RunsSubmittedByAnEarlierDriverAreNotSubmittedAgain) {
  ASSERT_TRUE(Drive());  // the driver is interrupted at once
  ASSERT_EQ(queue_.submitted.size(), 1u);
  Then([this] { Do("batch-0001-task-0000"); });
  Then([this] { DoAll(); });
  ASSERT_TRUE(Drive());
  EXPECT_EQ(queue_.submitted.size(), 1u);
  EXPECT_EQ(Done(), 10u);
}

TEST_F(QueueDriverTest, AbortedBatchOfAnEarlierDriverIsDropped) {
  ASSERT_TRUE(Drive());
  queue_.held.clear();  // the user cancels the batch
  Then([] {});
  Then([this] { DoAll(); });
  ASSERT_TRUE(Drive());
  EXPECT_EQ(queue_.submitted.size(), 2u);
  EXPECT_EQ(Done(), 10u);
  EXPECT_EQ(spool_.Batches()->size(), 1u);
}

TEST_F(QueueDriverTest, AbortedBatchOfThisDriverIsAnErrorWithTheLog) {
  Then([this] {
    std::ofstream(spool_.LogOf(queue_.submitted[0], "0")) << "gsv: no such folder\n";
    queue_.held.clear();
  });
  Then([] {});
  Then([] {});
  const auto ended = Drive();
  ASSERT_FALSE(ended);
  EXPECT_THAT(
      ended.error().message,
      HasSubstr("The queue: job job 1 ended before any of its runs started: gsv: no such folder"));
}

TEST_F(QueueDriverTest, RefusedBatchIsSubmittedAgainWhenTheQueueIsShorter) {
  queue_.max_tasks = 3;
  queue_.room = 3;
  Then([this] {
    EXPECT_EQ(queue_.submitted.size(), 1u);
    EXPECT_THAT(said_.back(),
                HasSubstr("it is full; 4 runs will be submitted when the queue is shorter"));
    Do("batch-0001-task-0000");
  });
  Then([this] {
    EXPECT_EQ(queue_.submitted.size(), 1u) << "two tasks and two more are too many";
    DoAll();
  });
  Then([this] { DoAll(); });
  ASSERT_TRUE(Drive());
  EXPECT_EQ(Done(), 10u);
  EXPECT_THAT(RunsOf(queue_.submitted), ElementsAre(0, 1, 2, 3, 4, 5, 6, 7, 8, 9));
}

TEST_F(QueueDriverTest, RefusalByAnEmptyQueueEndsTheDriver) {
  queue_.room = 0;
  const auto ended = Drive();
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().Sentence(), "submit: it is full");
  EXPECT_THAT(*spool_.Batches(), IsEmpty());
}

TEST_F(QueueDriverTest, QueueThatStopsAnsweringIsQueriedAgain) {
  queue_.failure = base::Error{base::ErrorCode::kUnavailable, "no answer", "squeue"};
  EXPECT_FALSE(Drive());
  queue_.failure.reset();
  Then([this] { queue_.failure = base::Error{base::ErrorCode::kUnavailable, "no answer", "ask"}; });
  Then([] {});
  Then([this] {
    EXPECT_EQ(said_.back(),
              "ask: no answer; gsv will query the queue again, and running tasks continue");
    EXPECT_EQ(said_.size(), 2u) << "said once";
    queue_.failure.reset();
    DoAll();
  });
  ASSERT_TRUE(Drive());
  EXPECT_EQ(Done(), 10u);
}

TEST_F(QueueDriverTest, PermanentlyMissingQueueEndsTheDriver) {
  Then([this] { queue_.failure = base::Error{base::ErrorCode::kNotFound, "no host", "ssh"}; });
  Then([] {});
  const auto ended = Drive();
  ASSERT_FALSE(ended);
  EXPECT_EQ(ended.error().Sentence(), "ssh: no host");
  EXPECT_EQ(ended.error().code, base::ErrorCode::kUnavailable);
}

TEST_F(QueueDriverTest, DriverThatDoesNotWaitEndsAfterSubmitting) {
  ASSERT_TRUE(Drive([](QueueDriver& driver) { driver.waits = false; }));
  EXPECT_EQ(queue_.held.size(), 5u);
  EXPECT_EQ(Done(), 0u);
}

}  // namespace
}  // namespace gsv::campaign
