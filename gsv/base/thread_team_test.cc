#include "gsv/base/thread_team.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <ctime>
#include <set>
#include <thread>
#include <vector>

namespace gsv::base {
namespace {

TEST(ThreadTeam, EveryPlaceOfTheRangeIsVisitedOnce) {
  for (const int threads : {1, 2, 5}) {
    ThreadTeam team(threads);
    EXPECT_EQ(team.threads(), threads);
    for (const std::size_t count : {0u, 1u, 63u, 64u, 65u, 10'000u}) {
      std::vector<std::atomic<int>> visits(count);
      team.Share(count, 64, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      for (const auto& times : visits) EXPECT_EQ(times, 1);
    }
  }
}

TEST(ThreadTeam, APieceIsNoLongerThanTheGrain) {
  ThreadTeam team(3);
  std::atomic<std::size_t> longest{0};
  team.Share(1000, 7, [&](std::size_t begin, std::size_t end) {
    std::size_t known = longest;
    while (end - begin > known && !longest.compare_exchange_weak(known, end - begin)) {
    }
  });
  EXPECT_EQ(longest, 7u);
}

TEST(ThreadTeam, SmallWorkStaysWithTheCaller) {
  ThreadTeam team(4);
  std::set<std::thread::id> threads;
  team.Share(10, 10, [&](std::size_t, std::size_t) { threads.insert(std::this_thread::get_id()); });
  EXPECT_EQ(threads, std::set{std::this_thread::get_id()});
}

TEST(ThreadTeam, ManyJobsInARowAreAllDone) {
  ThreadTeam team(3);
  std::uint64_t sum = 0;
  for (int job = 0; job < 20'000; ++job) {
    std::atomic<std::uint64_t> part{0};
    team.Share(3, 1, [&](std::size_t begin, std::size_t) { part += begin + 1; });
    sum += part;
  }
  EXPECT_EQ(sum, 20'000u * 6);
}

// Sixteen threads once drew four cameras' pictures with all sixteen processors busy.
TEST(ThreadTeam, AThreadWithoutAPieceCostsNoProcessor) {
  constexpr auto kPiece = std::chrono::milliseconds(200);  // asleep: what is used, others use
  ThreadTeam team(4);
  const std::clock_t before = std::clock();
  team.Share(2, 1, [&](std::size_t, std::size_t) { std::this_thread::sleep_for(kPiece); });
  const double used = static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC;
  EXPECT_LT(used, 0.05) << "s of processor time while two pieces lasted 0.2 s each";
}

}  // namespace
}  // namespace gsv::base
