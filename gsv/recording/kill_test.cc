// Kills recording programs with SIGKILL at 200 random moments, several programs at once. A message
// that was recorded more than a second before the kill must be in the file.
#include <algorithm>
#include <csignal>
#include <filesystem>
#include <random>
#include <set>
#include <vector>

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "gsv/base/sanitizer.h"
#include "gsv/base/temporary_folder.h"
#include "gsv/recording/reading/recording_info.h"
#include "gsv/recording/reading/recover.h"
#include "gsv/recording/testing/hand_over.h"
#include "gsv/recording/testing/test_recording.h"

namespace gsv::recording {
namespace {

constexpr int kMoments = 200;
// Number of programs that run at once; lower on slow machines. A program that waits too long for a
// processor must be started again (see kStall), and many programs would make such waits frequent.
constexpr std::size_t kAtOnce = base::kSlowdown > 1 ? 6 : 20;
constexpr std::int64_t kMillisecond = 1'000'000;  // in ns
constexpr std::int64_t kPromised = 1000 * kMillisecond;
constexpr std::int64_t kMaxLifetime = 2500 * kMillisecond;
// A process that got no processor for this long cannot meet a time limit, so the attempt is
// repeated.
constexpr std::int64_t kStall = 250 * kMillisecond;
constexpr int kMaxRepeats = 200;

// A recording program that the test starts, and kills later.
class Victim {
 public:
  Victim(std::string path, std::int64_t life, int dawdling_us)
      : path_(std::move(path)), dies_at_(WallNow() + life) {
    int ends[2];
    if (pipe2(ends, O_CLOEXEC) != 0) std::abort();
    pipe_ = ends[0];
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, ends[1], STDOUT_FILENO);
    std::string program = GSV_RECORDING_VICTIM, dawdling = std::to_string(dawdling_us);
    char* arguments[]{program.data(), path_.data(), dawdling.data(), nullptr};
    if (posix_spawn(&pid_, program.c_str(), &actions, nullptr, arguments, environ) != 0) {
      std::abort();
    }
    posix_spawn_file_actions_destroy(&actions);
    close(ends[1]);
  }
  Victim(const Victim&) = delete;
  Victim& operator=(const Victim&) = delete;
  ~Victim() {
    if (pid_ > 0) Kill();
  }

  const std::string& path() const { return path_; }
  int pipe() const { return pipe_; }
  std::int64_t dies_at() const { return dies_at_; }

  // Reads once from the program's stdout. Returns false at its end.
  bool Listen() {
    HandOver batch[256];
    const ssize_t size = read(pipe_, batch, sizeof batch);
    if (size <= 0) return false;
    told_.insert(told_.end(), batch, batch + size / static_cast<ssize_t>(sizeof(HandOver)));
    return true;
  }

  void Kill() {
    killed_at_ = WallNow();
    kill(pid_, SIGKILL);
    waitpid(std::exchange(pid_, -1), nullptr, 0);
    while (Listen()) {
    }
    close(pipe_);
  }

  // Returns the simulated time up to which all messages must be in the file. Returns nullopt if the
  // program recorded nothing more than a second before it was killed. Call it after Kill().
  std::optional<base::SimTime> promised() const {
    std::optional<base::SimTime> newest;
    for (const HandOver& each : told_) {
      if (each.wall_ns <= killed_at_ - kPromised) newest = base::SimTime(each.time_ns);
    }
    return newest;
  }

  bool has_stalled() const {
    std::int64_t last = told_.empty() ? killed_at_ : told_.front().wall_ns;
    for (const HandOver& each : told_) {
      if (each.wall_ns - last > kStall) return true;
      last = each.wall_ns;
    }
    return killed_at_ - last > kStall;
  }

 private:
  std::string path_;
  std::int64_t dies_at_;
  std::int64_t killed_at_ = 0;
  int pipe_ = -1;
  pid_t pid_ = -1;
  std::vector<HandOver> told_;
};

std::map<std::string, std::set<base::SimTime>> TimesByTopic(const McapReader& reader) {
  std::map<std::string, std::set<base::SimTime>> times;
  MessageCursor cursor = reader.Messages();
  for (auto next = cursor.Next(); next && *next; next = cursor.Next()) {
    times[reader.summary().channels.at((*next)->channel_id).topic].insert((*next)->log_time);
  }
  return times;
}

// Recovers the victim's file and checks that it contains all required messages.
void Judge(const Victim& victim) {
  const std::string mended = victim.path() + ".mended";
  const auto recovery = Recover(victim.path(), mended);
  const std::optional<base::SimTime> until = victim.promised();
  if (!recovery) {
    EXPECT_FALSE(until) << recovery.error().Sentence();
    return;
  }
  const auto info = ReadInfo(mended);
  ASSERT_TRUE(info) << info.error().Sentence();
  EXPECT_TRUE(info->indexed);
  EXPECT_TRUE(info->problems.empty());
  EXPECT_EQ(info->messages, recovery->messages);
  if (until) {
    auto times = TimesByTopic(**McapReader::Open(mended));
    for (base::SimTime time{}; time <= *until; time += 20ms) {
      ASSERT_TRUE(times["/clock"].contains(time)) << time.count() << " of " << until->count();
    }
    for (base::SimTime time{}; time <= *until; time += 50ms) {
      ASSERT_TRUE(times["/robot/front"].contains(time)) << time.count() << " of " << until->count();
    }
  }
  std::filesystem::remove(mended);
  std::filesystem::remove(victim.path());
}

class Killing {
 public:
  explicit Killing(std::filesystem::path folder) : folder_(std::move(folder)) {}

  // Starts and kills programs until kMoments recordings were checked.
  void Run() {
    while (judged_ < kMoments && !testing::Test::HasFatalFailure()) {
      while (victims_.size() < kAtOnce && started_ - again_ < kMoments) Start();
      ASSERT_FALSE(victims_.empty()) << "this machine stalls too often to tell";
      ListenUntilOneIsDue();
      KillThoseDue();
    }
  }

  int with_a_promise() const { return with_a_promise_; }

 private:
  void Start() {
    std::uniform_int_distribution<std::int64_t> life(0, kMaxLifetime);
    std::uniform_int_distribution<int> dawdling(2'000, 50'000);
    const std::string name = "run_" + std::to_string(started_++) + ".mcap";
    victims_.push_back(std::make_unique<Victim>(folder_ / name, life(random_), dawdling(random_)));
  }

  void ListenUntilOneIsDue() {
    std::int64_t due = victims_.front()->dies_at();
    std::vector<pollfd> pipes;
    for (const auto& victim : victims_) {
      due = std::min(due, victim->dies_at());
      pipes.push_back({victim->pipe(), POLLIN, 0});
    }
    const std::int64_t left = std::max<std::int64_t>(0, due - WallNow());
    poll(pipes.data(), pipes.size(), static_cast<int>(left / kMillisecond) + 1);
    for (std::size_t i = 0; i < pipes.size(); ++i) {
      if ((pipes[i].revents & POLLIN) != 0) victims_[i]->Listen();
    }
  }

  void KillThoseDue() {
    for (auto& victim : victims_) {
      if (victim->dies_at() > WallNow()) continue;
      victim->Kill();
      const bool counts = !victim->has_stalled();
      if (counts) {
        ++judged_;
        with_a_promise_ += victim->promised() ? 1 : 0;
        SCOPED_TRACE(victim->path());
        Judge(*victim);
      } else if (again_ < kMaxRepeats) {
        ++again_;
      }
      victim.reset();
    }
    std::erase(victims_, nullptr);
  }

  const std::filesystem::path folder_;
  std::mt19937_64 random_{1};
  std::vector<std::unique_ptr<Victim>> victims_;
  int started_ = 0, again_ = 0, judged_ = 0, with_a_promise_ = 0;
};

TEST(Promise, KillingLosesAtMostASecondOfARecording) {
  const auto folder = base::TemporaryFolder::Make("gsv-kill");
  ASSERT_TRUE(folder);
  Killing killing(folder->path());
  killing.Run();
  // A program runs for 0 to 2.5 s. Most programs run for more than a second, and have recorded
  // messages that must survive.
  EXPECT_GT(killing.with_a_promise(), kMoments / 4);
}

}  // namespace
}  // namespace gsv::recording
