#include "gsv/gateway/replay/replay_clock.h"

#include <gtest/gtest.h>

namespace gsv::gateway {
namespace {

using namespace std::chrono_literals;
using simulation::Phase;

constexpr ReplayClock::WallTime kNow{1h};

TEST(ReplayClock, AdvancesByTheSpeedTimesWallClockTime) {
  ReplayClock clock(1s, 10s, 3, false);
  ASSERT_TRUE(clock.Start());
  clock.Advance(kNow);
  EXPECT_EQ(clock.position(), 1s);
  clock.Advance(kNow + 100ms);
  clock.Advance(kNow + 200ms);
  EXPECT_EQ(clock.position(), 1600ms);
}

TEST(ReplayClock, ALateUpdateMakesTheReplaySlower) {
  ReplayClock clock(0s, 10s, 1, false);
  ASSERT_TRUE(clock.Start());
  clock.Advance(kNow);
  clock.Advance(kNow + 5s);
  EXPECT_EQ(clock.position(), 200ms);
}

TEST(ReplayClock, DoesNotAdvanceWhilePaused) {
  ReplayClock clock(0s, 10s, 1, false);
  ASSERT_TRUE(clock.Start());
  clock.Advance(kNow);
  ASSERT_TRUE(clock.Pause());
  clock.Advance(kNow + 100ms);
  ASSERT_TRUE(clock.Resume());
  clock.Advance(kNow + 200ms);
  clock.Advance(kNow + 250ms);
  EXPECT_EQ(clock.position(), 50ms);
}

TEST(ReplayClock, FinishesAtTheEnd) {
  ReplayClock clock(0s, 100ms, 1, false);
  ASSERT_TRUE(clock.Start());
  clock.Advance(kNow);
  EXPECT_FALSE(clock.Advance(kNow + 150ms));
  EXPECT_EQ(clock.position(), 100ms);
  EXPECT_EQ(clock.phase(), Phase::kFinished);
}

TEST(ReplayClock, RestartsWithLoop) {
  ReplayClock clock(0s, 100ms, 1, true);
  ASSERT_TRUE(clock.Start());
  clock.Advance(kNow);
  EXPECT_FALSE(clock.Advance(kNow + 150ms));
  EXPECT_EQ(clock.position(), 100ms);
  EXPECT_TRUE(clock.Advance(kNow + 160ms));
  EXPECT_EQ(clock.position(), 0s);
  EXPECT_EQ(clock.phase(), Phase::kRunning);
}

// A round at this speed is longer than the recording.
TEST(ReplayClock, AShortRecordingIsPlayedToItsEndInALoop) {
  ReplayClock clock(0s, 100ms, 1000, true);
  ASSERT_TRUE(clock.Start());
  clock.Advance(kNow);
  for (int i = 1; i <= 4; ++i) {
    EXPECT_EQ(clock.Advance(kNow + i * 30ms), i % 2 == 0);
    EXPECT_EQ(clock.position(), i % 2 == 0 ? 0ms : 100ms);
  }
}

TEST(ReplayClock, StepsAndPauses) {
  ReplayClock clock(0s, 100ms, 1, false);
  ASSERT_TRUE(clock.Step(30ms));
  EXPECT_EQ(clock.position(), 30ms);
  EXPECT_EQ(clock.phase(), Phase::kPaused);
  ASSERT_TRUE(clock.Step(base::SimTime::max()));
  EXPECT_EQ(clock.position(), 100ms);
  EXPECT_EQ(clock.phase(), Phase::kFinished);
}

TEST(ReplayClock, SeeksWithinTheRecording) {
  ReplayClock clock(1s, 2s, 1, false);
  clock.Seek(1500ms);
  EXPECT_EQ(clock.position(), 1500ms);
  EXPECT_EQ(clock.phase(), Phase::kPaused);
  clock.Seek(9s);
  EXPECT_EQ(clock.position(), 2s);
  clock.Seek(-1s);
  EXPECT_EQ(clock.position(), 1s);
}

TEST(ReplayClock, ANewSpeedAppliesFromTheCurrentInstant) {
  ReplayClock clock(0s, 10s, 1, false);
  ASSERT_TRUE(clock.Start());
  clock.Advance(kNow);
  clock.Advance(kNow + 100ms);
  clock.SetSpeed(5);
  clock.Advance(kNow + 200ms);
  EXPECT_EQ(clock.position(), 600ms);
}

TEST(ReplayClock, PausesAtAnInstant) {
  ReplayClock clock(1s, 2s, 1, false);
  ASSERT_TRUE(clock.Start());
  clock.SeekAndPause(3s);
  EXPECT_EQ(clock.position(), 2s);
  EXPECT_EQ(clock.phase(), Phase::kPaused);
}

TEST(ReplayClock, RefusesRequestsThatThePhaseDoesNotAllow) {
  ReplayClock clock(0s, 1s, 1, false);
  EXPECT_FALSE(clock.Pause());
  EXPECT_FALSE(clock.Resume());
  ASSERT_TRUE(clock.Start());
  EXPECT_FALSE(clock.Step(1ms));
  const base::Status again = clock.Start();
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().code, base::ErrorCode::kNotRunning);
  EXPECT_EQ(again.error().message, "to start a replay it must be created, and it is running");
  clock.Rewind();
  EXPECT_EQ(clock.phase(), Phase::kCreated);
}

}  // namespace
}  // namespace gsv::gateway
