// Tests the engine `slurm` with a fake of sbatch, squeue and scontrol.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/base/temporary_folder.h"
#include "gsv/campaign/engine.h"
#include "gsv/scenario/yaml_mapping.h"

namespace gsv::campaign {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;
using ::testing::UnorderedElementsAre;

class FakeSlurm final : public CommandRunner {
 public:
  base::Result<CommandOutcome> Run(const std::vector<std::string>& command) override {
    asked.push_back(command);
    return answer;
  }
  base::Result<std::unique_ptr<StartedProgram>> Start(const std::vector<std::string>&) override {
    return base::Fail(base::ErrorCode::kUnavailable, "Slurm's commands all end");
  }

  base::Result<CommandOutcome> answer = CommandOutcome{"exit code 0", ""};
  std::vector<std::vector<std::string>> asked;
};

class SlurmQueueTest : public ::testing::Test {
 protected:
  static Campaign FourRuns() {
    Campaign campaign;
    campaign.scenario = "world: maze\n";
    campaign.parameters = {{"seed", Parameter::Kind::kList, {"1", "2", "3", "4"}}};
    return campaign;
  }
  std::unique_ptr<JobQueue> Queue(const std::string& slurm = "{}",
                                  const EngineRequest& request = {.name = "slurm"}) {
    base::Problems problems;
    const scenario::YamlPlace place(scenario::YamlPlace::Naming::kLines, "c.yaml", problems);
    scenario::YamlMapping mapping(YAML::Load("slurm: " + slurm), "", place);
    const Engine engine = ReadEngine(mapping, request);
    EXPECT_TRUE(problems.empty());
    return engine.make_queue({slurm_, "/opt/g's v/gsv", {}});
  }
  static Batch TwoTasks(int number = 1) {
    Batch batch;
    batch.number = number;
    batch.name = "gsv-x-" + std::to_string(number);
    batch.runs_per_task = 2;
    batch.runs = {0, 1, 2, 3};
    return batch;
  }
  void Answer(const std::string& output, const std::string& ending = "exit code 0") {
    slurm_.answer = CommandOutcome{ending, output};
  }

  const base::TemporaryFolder temporary_ = *base::TemporaryFolder::Make("gsv-slurm-queue");
  const Spool spool_ = *Spool::Make(temporary_.path() / "c.runs", FourRuns());
  FakeSlurm slurm_;
};

TEST_F(SlurmQueueTest, SubmitsABatchAsOneJobArrayWithTheOptionsOfTheFileFirst) {
  EngineRequest request{.name = "slurm"};
  request.options["--partition"] = {"long"};
  request.options["--sbatch"] = {"--mem=2G"};
  const auto queue =
      Queue("{partition: short, time_limit: '0:30:00', options: [--account=lab]}", request);
  Answer("sbatch: remark\n4711;cluster\n");
  const auto job = queue->Submit(spool_, TwoTasks());
  ASSERT_TRUE(job) << job.error().Sentence();
  EXPECT_EQ(*job, "4711");
  const std::string folder = temporary_.path() / "c.runs";
  EXPECT_THAT(
      slurm_.asked,
      ElementsAre(ElementsAre(
          "sbatch", "--parsable", "--requeue", "--job-name=gsv-x-1", "--array=0-1",
          "--output=" + folder + "/logs/gsv-x-1-%a.log", "--open-mode=append", "--partition=long",
          "--time=0:30:00", "--account=lab", "--mem=2G",
          "--wrap=exec '/opt/g'\\''s v/gsv' campaign task '" + folder +
              "/batch-0001.json' --task \"$SLURM_ARRAY_TASK_ID\" --job \"$SLURM_ARRAY_JOB_ID\" "
              "--node \"$SLURMD_NODENAME\" --jobs \"${SLURM_CPUS_PER_TASK:-1}\"")));
}

TEST_F(SlurmQueueTest, RefusalContainsSlurmsMessage) {
  Answer("sbatch: error: Batch job submission failed: Invalid partition name specified\n",
         "exit code 1");
  const auto job = Queue()->Submit(spool_, TwoTasks());
  ASSERT_FALSE(job);
  EXPECT_EQ(job.error().code, base::ErrorCode::kNotRunning);
  EXPECT_EQ(job.error().Sentence(), "sbatch: Slurm refuses: Invalid partition name specified");
  Answer("sbatch: unrecognized option '--x'\nTry \"sbatch --help\" for more information\n",
         "exit code 255");
  EXPECT_EQ(Queue()->Submit(spool_, TwoTasks()).error().Sentence(),
            "sbatch: Slurm refuses: sbatch: unrecognized option '--x'");
}

TEST_F(SlurmQueueTest, KilledSbatchIsReportedAsPossiblySubmitted) {
  Answer("", "signal 9");
  const auto killed = Queue()->Submit(spool_, TwoTasks());
  ASSERT_FALSE(killed);
  EXPECT_EQ(killed.error().code, base::ErrorCode::kUnavailable);
  EXPECT_EQ(killed.error().Sentence(), "sbatch: it ended with signal 9");
  Answer("Submitted\n");
  EXPECT_EQ(Queue()->Submit(spool_, TwoTasks()).error().Sentence(),
            "sbatch: it printed no job number: Submitted");
}

TEST_F(SlurmQueueTest, MissingCommandsAndTimeoutsAreReportedWithARemedy) {
  Answer("", "exit code 127");
  EXPECT_THAT(Queue()->MaxTasks().error().Sentence(),
              HasSubstr("scontrol: the commands of Slurm are not on the PATH"));
  slurm_.answer = base::Fail(base::ErrorCode::kTimeout, "did not answer within 60 s", "sbatch");
  EXPECT_EQ(
      Queue()->Submit(spool_, TwoTasks()).error().Sentence(),
      "sbatch: did not answer within 60 s; check that Slurm runs, then run the same command again");
}

TEST_F(SlurmQueueTest, MaxTasksIsTheLengthOfAnArray) {
  Answer("Configuration data\nMaxArraySize            = 31\nMaxJobCount = 10000\n");
  EXPECT_EQ(*Queue()->MaxTasks(), 31u);
  EXPECT_THAT(slurm_.asked, ElementsAre(ElementsAre("scontrol", "show", "config")));
  Answer("an old Slurm\n");
  EXPECT_EQ(*Queue()->MaxTasks(), 1001u);
  Answer("MaxArraySize = 1\n");
  EXPECT_THAT(Queue()->MaxTasks().error().Sentence(), HasSubstr("allows no job arrays"));
}

TEST_F(SlurmQueueTest, TasksAreFoundByTheNamesOfTheirBatches) {
  Answer(
      "gsv-x-1|0|RUNNING|None\ngsv-x-2|1|PENDING|Resources\ngsv-y-1|0|RUNNING|None\n"
      "gsv-x-1|N/A|PENDING|None\nnonsense\n");
  const auto tasks = Queue()->TasksOf({TwoTasks(1), TwoTasks(2)});
  ASSERT_TRUE(tasks);
  std::map<std::string, std::string> states;
  for (const auto& [share, task] : *tasks) states[share] = task.state + " " + task.reason;
  EXPECT_THAT(states, UnorderedElementsAre(Pair("batch-0001-task-0000", "RUNNING None"),
                                           Pair("batch-0002-task-0001", "PENDING Resources")));
  EXPECT_THAT(slurm_.asked,
              ElementsAre(ElementsAre("squeue", "--noheader", "--array", "--name=gsv-x-1,gsv-x-2",
                                      "--format=%j|%K|%T|%r")));
  slurm_.asked.clear();
  EXPECT_TRUE(Queue()->TasksOf({})->empty());
  EXPECT_TRUE(slurm_.asked.empty());
}

}  // namespace
}  // namespace gsv::campaign
