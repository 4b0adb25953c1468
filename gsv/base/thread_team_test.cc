#include "gsv/base/thread_team.h"

#include <unistd.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <latch>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

namespace gsv::base {
namespace {

TEST(ThreadTeam, VisitsEachIndexOnce) {
  for (const int threads : {1, 2, 5}) {
    ThreadTeam team(threads);
    EXPECT_EQ(team.threads(), threads);
    for (const std::size_t count : {0u, 1u, 63u, 64u, 65u, 10'000u}) {
      std::vector<std::atomic<int>> visits(count);
      team.ParallelFor(count, 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      for (const auto& times : visits) EXPECT_EQ(times, 1);
    }
  }
}

TEST(ThreadTeam, PiecesAreAtMostAsLongAsTheGrain) {
  ThreadTeam team(3);
  std::atomic<std::size_t> longest{0};
  team.ParallelFor(1000, 7, [&](std::size_t begin, std::size_t end) {
    std::size_t known = longest;
    while (end - begin > known && !longest.compare_exchange_weak(known, end - begin)) {
    }
  });
  EXPECT_EQ(longest, 7u);
}

TEST(ThreadTeam, PassesADifferentIndexForEachThread) {
  for (const int threads : {1, 3}) {
    ThreadTeam team(threads);
    Mutex mutex;
    std::map<std::thread::id, std::size_t> index_of;
    std::set<std::size_t> indices;
    for (int job = 0; job < 1000; ++job) {
      team.ParallelFor(12, 1, [&](std::size_t, std::size_t, std::size_t thread) {
        const MutexLock lock(mutex);
        EXPECT_EQ(index_of.try_emplace(std::this_thread::get_id(), thread).first->second, thread);
        indices.insert(thread);
      });
    }
    EXPECT_EQ(index_of.at(std::this_thread::get_id()), 0u) << "the index of the caller";
    EXPECT_EQ(indices.size(), index_of.size());
    EXPECT_LT(*indices.rbegin(), static_cast<std::size_t>(threads));
  }
}

TEST(ThreadTeam, CallerDoesItsOwnWorkOnce) {
  for (const int threads : {1, 3}) {
    ThreadTeam team(threads);
    for (const std::size_t count : {0u, 1u, 100u}) {
      std::atomic<std::size_t> visited{0};
      std::vector<std::thread::id> own;
      team.ParallelFor(
          count, 7, [&](std::size_t begin, std::size_t end) { visited += end - begin; },
          [&] { own.push_back(std::this_thread::get_id()); });
      EXPECT_EQ(visited, count);
      EXPECT_EQ(own, std::vector{std::this_thread::get_id()});
    }
  }
}

// Counts the visited indices of each thread, and passes the counts on in End().
struct CountingWork {
  void operator()(std::size_t begin, std::size_t end, std::size_t thread) const {
    visited[thread] += end - begin;
  }
  void End(std::size_t thread) const { ended += std::exchange(visited[thread], 0); }

  std::vector<std::size_t>& visited;  // by each thread since its last End()
  std::atomic<std::size_t>& ended;
};

TEST(ThreadTeam, EachThreadEndsAfterItsLastPiece) {
  for (const int threads : {1, 3}) {
    ThreadTeam team(threads);
    for (const std::size_t count : {0u, 1u, 5u, 1000u}) {
      std::vector<std::size_t> visited(static_cast<std::size_t>(threads));
      std::atomic<std::size_t> ended{0};
      team.ParallelFor(count, 7, CountingWork{visited, ended});
      EXPECT_EQ(ended, count) << threads;
    }
  }
}

TEST(ThreadTeam, CallerDoesASinglePieceAlone) {
  ThreadTeam team(4);
  std::set<std::thread::id> threads;
  team.ParallelFor(10, 10,
                   [&](std::size_t, std::size_t) { threads.insert(std::this_thread::get_id()); });
  EXPECT_EQ(threads, std::set{std::this_thread::get_id()});
}

TEST(ThreadTeam, CompletesManyJobsInSuccession) {
  ThreadTeam team(3);
  std::uint64_t sum = 0;
  for (int job = 0; job < 20'000; ++job) {
    std::atomic<std::uint64_t> part{0};
    team.ParallelFor(3, 1, [&](std::size_t begin, std::size_t) { part += begin + 1; });
    sum += part;
  }
  EXPECT_EQ(sum, 20'000u * 6);
}

// Whether the kernel reports all threads of this process but the caller as sleeping.
bool AllOthersSleep() {
  const std::string self = std::to_string(gettid());
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    if (task.path().filename() == self) continue;
    std::string stat;
    std::getline(std::ifstream(task.path() / "stat"), stat);
    const std::size_t name_end = stat.rfind(')');  // "TID (NAME) STATE …"
    if (name_end != std::string::npos && stat.substr(name_end + 2, 1) != "S") return false;
  }
  return true;
}

// Regression: threads without a piece of work kept their processors busy.
TEST(ThreadTeam, ThreadsWithoutAPieceSleep) {
  // Number of consecutive successful checks; one is not enough, because a thread that polls may
  // also sleep for a moment.
  constexpr int kLooks = 200;
  constexpr auto kTimeout = std::chrono::seconds(30);
  std::latch begun(2), end(1);
  std::thread job([&] {
    ThreadTeam team(4);
    team.ParallelFor(2, 1, [&](std::size_t, std::size_t) {
      begun.count_down();
      end.wait();
    });
  });
  begun.wait();
  const auto give_up = std::chrono::steady_clock::now() + kTimeout;
  int looks = 0;
  while (looks < kLooks && std::chrono::steady_clock::now() < give_up)
    looks = AllOthersSleep() ? looks + 1 : 0;
  EXPECT_EQ(looks, kLooks) << "a thread is busy though two pieces are all there is";
  end.count_down();
  job.join();
}

}  // namespace
}  // namespace gsv::base
