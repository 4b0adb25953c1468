// Tests the engine `ssh` with a fake of ssh and a fake clock.
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "gsv/base/temporary_folder.h"
#include "gsv/campaign/engine.h"
#include "gsv/scenario/yaml_mapping.h"

namespace gsv::campaign {
namespace {

using std::chrono::seconds;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

// A started ssh process. The test may use it even after the queue has dropped it.
struct Session {
  std::vector<std::string> command;
  std::string output, ending;
  bool is_killed = false;

  std::string host() const { return command[command.size() - 2]; }
  void Begin() { output += std::string(kTaskBegins) + "it\n"; }
  void End(const std::string& how, const std::string& last_words = "") {
    output += last_words;
    ending = how;
  }
};

class FakeProgram final : public StartedProgram {
 public:
  explicit FakeProgram(std::shared_ptr<Session> session) : session_(std::move(session)) {}
  ~FakeProgram() override { session_->is_killed = session_->ending.empty(); }
  std::string Output() override { return session_->output; }
  std::string Ending() override { return session_->ending; }

 private:
  const std::shared_ptr<Session> session_;
};

class FakeSsh final : public CommandRunner {
 public:
  base::Result<CommandOutcome> Run(const std::vector<std::string>&) override {
    return base::Fail(base::ErrorCode::kUnavailable, "every ssh goes on");
  }
  base::Result<std::unique_ptr<StartedProgram>> Start(
      const std::vector<std::string>& command) override {
    sessions.push_back(std::make_shared<Session>(Session{command}));
    return std::make_unique<FakeProgram>(sessions.back());
  }

  std::vector<std::shared_ptr<Session>> sessions;  // in the order in which they were started
};

class SshQueueTest : public ::testing::Test {
 protected:
  void MakeQueue(const std::string& ssh) {
    base::Problems problems;
    const scenario::YamlPlace place(scenario::YamlPlace::Naming::kLines, "c.yaml", problems);
    scenario::YamlMapping mapping(YAML::Load("engine: ssh\nssh: " + ssh), "", place);
    const Engine engine = ReadEngine(mapping, {});
    ASSERT_TRUE(problems.empty()) << problems.front().Sentence();
    queue_ = engine.make_queue({ssh_, "/usr/bin/gsv",
                                [this](const std::string& text) { said_.push_back(text); },
                                [this] { return now_; }});
  }
  // Submits a batch with one task per run.
  void Submit(std::size_t tasks) {
    Batch batch;
    batch.name = "gsv-x-1";
    batch.timeout = 100;
    for (std::size_t run = 0; run < tasks; ++run)
      batch.runs.push_back(static_cast<std::int64_t>(run));
    const auto job = queue_->Submit(spool_, batch);
    ASSERT_TRUE(job);
    EXPECT_EQ(*job, batch.name);
  }
  // Queries the queue. Returns its tasks as "0:RUNNING", ordered by number, or the error.
  std::vector<std::string> QueryTasks() {
    const auto tasks = queue_->TasksOf({});
    if (!tasks) return {tasks.error().Sentence()};
    std::vector<std::string> states;
    for (const auto& [share, task] : *tasks)
      states.push_back(std::to_string(std::stoi(share.substr(share.size() - 4))) + ":" +
                       task.state);
    return states;
  }
  std::vector<std::string> Hosts() const {
    std::vector<std::string> hosts;
    for (const auto& session : ssh_.sessions) hosts.push_back(session->host());
    return hosts;
  }
  Session& session(std::size_t index) { return *ssh_.sessions.at(index); }

  const base::TemporaryFolder temporary_ = *base::TemporaryFolder::Make("gsv-ssh-queue");
  const Spool spool_ = *Spool::Make(temporary_.path() / "c.runs", [] {
    Campaign campaign;
    campaign.scenario = "world: maze\n";
    return campaign;
  }());
  std::chrono::steady_clock::time_point now_{};
  FakeSsh ssh_;
  std::vector<std::string> said_;
  std::unique_ptr<JobQueue> queue_;
};

TEST_F(SshQueueTest, TaskIsOneCommandOverSsh) {
  MakeQueue("{hosts: ['me@n1:2'], program: /opt/ssh, options: [-p, '2222'], gsv: /opt/gsv}");
  Submit(1);
  EXPECT_THAT(QueryTasks(), ElementsAre("0:RUNNING"));
  const std::string folder = temporary_.path() / "c.runs";
  EXPECT_THAT(
      session(0).command,
      ElementsAre("/opt/ssh", "-p", "2222", "-o", "BatchMode=yes", "-o", "ConnectTimeout=10", "-o",
                  "ServerAliveInterval=15", "-o", "ServerAliveCountMax=3", "-T", "me@n1",
                  "exec '/opt/gsv' campaign task '" + folder +
                      "/batch-0001.json' --task 0 --job 'gsv-x-1' --node 'n1' --jobs 1 "
                      "--until-stdin-closes"));
}

TEST_F(SshQueueTest, FillsTheSlotsEvenlyAndLetsOtherTasksWait) {
  MakeQueue("{hosts: [n1, 'n2:2']}");
  EXPECT_EQ(*queue_->MaxTasks(), 24u);  // eight tasks per slot
  Submit(5);
  EXPECT_THAT(QueryTasks(),
              ElementsAre("0:RUNNING", "1:RUNNING", "2:RUNNING", "3:PENDING", "4:PENDING"));
  EXPECT_THAT(Hosts(), ElementsAre("n2", "n1", "n2"));
  session(1).Begin();
  session(1).End("exit code 0");
  EXPECT_THAT(QueryTasks(), ElementsAre("0:RUNNING", "2:RUNNING", "3:RUNNING", "4:PENDING"));
  EXPECT_THAT(Hosts(), ElementsAre("n2", "n1", "n2", "n1"));
}

TEST_F(SshQueueTest, ConnectsAtMostEightTasksPerHostAtOnce) {
  MakeQueue("{hosts: ['n1:20']}");
  Submit(20);
  QueryTasks();
  EXPECT_EQ(ssh_.sessions.size(), 8u);
  for (int i = 0; i < 8; ++i) session(static_cast<std::size_t>(i)).Begin();
  QueryTasks();
  EXPECT_EQ(ssh_.sessions.size(), 16u);
}

TEST_F(SshQueueTest, TasksOfAHostThatCannotBeReachedGoToAnother) {
  MakeQueue("{hosts: ['n1:2', 'n2:2']}");
  Submit(4);
  QueryTasks();
  EXPECT_THAT(Hosts(), ElementsAre("n1", "n2", "n1", "n2"));
  for (const int i : {0, 2})
    session(static_cast<std::size_t>(i))
        .End("exit code 255", "ssh: connect to host n1 port 22: Connection refused\r\n");
  for (const int i : {1, 3}) session(static_cast<std::size_t>(i)).Begin();
  EXPECT_THAT(QueryTasks(), ElementsAre("0:PENDING", "1:RUNNING", "2:PENDING", "3:RUNNING"));
  EXPECT_THAT(said_, ElementsAre("host n1 failed: ssh: connect to host n1 port 22: Connection "
                                 "refused; it gets no tasks for 5 s"));
  session(1).End("exit code 0");
  EXPECT_THAT(QueryTasks(), ElementsAre("0:RUNNING", "2:PENDING", "3:RUNNING"));
  EXPECT_EQ(Hosts().back(), "n2");
  // The host n1 is paused for 5 s. After that, it gets one task. When that task has begun, all
  // slots of the host get tasks.
  now_ += seconds(5);
  EXPECT_THAT(QueryTasks(), ElementsAre("0:RUNNING", "2:RUNNING", "3:RUNNING"));
  EXPECT_EQ(Hosts().back(), "n1");
  Batch more;
  more.number = 2;
  more.runs = {7, 8};
  ASSERT_TRUE(queue_->Submit(spool_, more));
  QueryTasks();
  EXPECT_EQ(ssh_.sessions.size(), 6u);
  session(5).Begin();
  QueryTasks();
  EXPECT_EQ(ssh_.sessions.size(), 7u);
}

TEST_F(SshQueueTest, FailingHostIsPausedLongerEachTime) {
  MakeQueue("{hosts: [n1, n2]}");
  Submit(2);
  QueryTasks();
  session(0).Begin();  // n1 executes this task throughout, so the other task goes to n2
  for (const int rest : {5, 10, 20, 40, 60}) {
    ASSERT_EQ(Hosts().back(), "n2");
    ssh_.sessions.back()->End("exit code 127", "sh: 1: exec: /usr/bin/gsv: not found\n");
    QueryTasks();
    EXPECT_THAT(said_.back(), HasSubstr("gets no tasks for " + std::to_string(rest) + " s"));
    now_ += seconds(rest) - std::chrono::milliseconds(1);
    const std::size_t before = ssh_.sessions.size();
    QueryTasks();
    EXPECT_EQ(ssh_.sessions.size(), before);
    now_ += std::chrono::milliseconds(1);
    QueryTasks();
    EXPECT_EQ(ssh_.sessions.size(), before + 1);
  }
}

TEST_F(SshQueueTest, FailsWithTheErrorOfEachHostIfNoHostAcceptsATask) {
  MakeQueue("{hosts: [n1, n2]}");
  Submit(1);
  for (int failure = 0; failure < 6; ++failure) {
    EXPECT_THAT(QueryTasks(), ElementsAre("0:RUNNING")) << failure;
    ssh_.sessions.back()->End("exit code 255", "Permission denied (publickey).\n");
    const auto after = QueryTasks();
    if (failure < 5 && after.front() == "0:PENDING") now_ += seconds(60);
  }
  EXPECT_THAT(
      QueryTasks(),
      ElementsAre("ssh: no host accepts a task; n1: Permission denied (publickey).; n2: "
                  "Permission denied (publickey).; run the same command again to continue"));
  EXPECT_EQ(queue_->TasksOf({}).error().code, base::ErrorCode::kNotFound);
}

TEST_F(SshQueueTest, BrokenConnectionLosesTheTaskAndPausesTheHost) {
  MakeQueue("{hosts: [n1]}");
  Submit(2);
  QueryTasks();
  session(0).Begin();
  session(0).End("exit code 255", "Timeout, server n1 not responding.\n");
  EXPECT_THAT(QueryTasks(), ElementsAre("1:PENDING"))
      << "the driver hands out what is left of task 0";
  EXPECT_THAT(said_.back(), HasSubstr("host n1 failed: Timeout, server n1 not responding."));
  std::ostringstream log;
  log << std::ifstream(temporary_.path() / "c.runs/logs/gsv-x-1-0.log").rdbuf();
  EXPECT_THAT(log.str(), HasSubstr("server n1 not responding"));
}

TEST_F(SshQueueTest, KilledTaskIsLostAndItsHostContinues) {
  MakeQueue("{hosts: [n1]}");
  Submit(2);
  QueryTasks();
  session(0).Begin();
  session(0).End("exit code 137", "Killed\n");
  EXPECT_THAT(QueryTasks(), ElementsAre("1:RUNNING"));
  EXPECT_THAT(said_, IsEmpty());
}

TEST_F(SshQueueTest, TaskThatDoesNotBeginInTimeFailsItsHost) {
  MakeQueue("{hosts: [n1, n2]}");
  Submit(1);
  QueryTasks();
  now_ += seconds(59);
  EXPECT_THAT(QueryTasks(), ElementsAre("0:RUNNING"));
  EXPECT_EQ(ssh_.sessions.size(), 1u);
  now_ += seconds(1);
  EXPECT_THAT(QueryTasks(), ElementsAre("0:RUNNING"));
  EXPECT_TRUE(session(0).is_killed);
  EXPECT_THAT(Hosts(), ElementsAre("n1", "n2"));
  EXPECT_THAT(said_, ElementsAre(HasSubstr("host n1 failed: no response in time")));
}

TEST_F(SshQueueTest, TaskThatExceedsTheTimeOfItsRunsIsEnded) {
  MakeQueue("{hosts: [n1]}");
  Submit(1);
  QueryTasks();
  session(0).Begin();
  QueryTasks();
  now_ += seconds(159);  // the time limit is 100 s for the task's run plus 60 s
  EXPECT_THAT(QueryTasks(), ElementsAre("0:RUNNING"));
  now_ += seconds(1);
  EXPECT_THAT(QueryTasks(), IsEmpty());
  EXPECT_TRUE(session(0).is_killed);
}

TEST_F(SshQueueTest, EveryTaskEndsWithTheQueue) {
  MakeQueue("{hosts: ['n1:2']}");
  Submit(2);
  QueryTasks();
  session(0).Begin();
  queue_.reset();
  EXPECT_TRUE(session(0).is_killed);
  EXPECT_TRUE(session(1).is_killed);
}

}  // namespace
}  // namespace gsv::campaign
