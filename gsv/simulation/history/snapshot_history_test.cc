#include "gsv/simulation/history/snapshot_history.h"

#include <gtest/gtest.h>

namespace gsv::simulation {
namespace {

using namespace std::chrono_literals;

std::shared_ptr<const world::Snapshot> At(std::int64_t step, base::SimTime step_size) {
  auto snapshot = std::make_shared<world::Snapshot>();
  snapshot->state.step = step;
  snapshot->state.time = step * step_size;
  return snapshot;
}

TEST(SnapshotHistory, ASensorWithoutAPeriodReadsTheLatest) {
  SnapshotHistory history(At(0, 10ms));
  history.Publish(At(1, 10ms));
  EXPECT_EQ(history.At({})->state.step, 1);
}

TEST(SnapshotHistory, SampleIsTakenAtTheFirstStepAtOrAfterItsInstant) {
  // With steps of 10 ms, the samples of the instants 0, 25, 50, 75 and 100 ms are taken at 0, 30,
  // 50, 80 and 100 ms.
  SnapshotHistory history(At(0, 10ms));
  EXPECT_EQ(history.At({25ms})->state.step, 0);
  const int expected[] = {0, 0, 0, 3, 3, 5, 5, 5, 8, 8, 10};
  for (int step = 1; step <= 10; ++step) {
    history.Publish(At(step, 10ms));
    EXPECT_EQ(history.At({25ms})->state.step, expected[step]) << "step " << step;
  }
}

TEST(SnapshotHistory, SensorWithALatencyReadsOlderSamples) {
  // The samples of 0, 20, 40, … ms are available from 35, 55, 75, … ms on. The first steps at which
  // they can be read are at 40, 60, 80, … ms.
  SnapshotHistory history(At(0, 10ms));
  const Cadence late{20ms, 35ms};
  history.Use({20ms});
  EXPECT_EQ(history.At(late)->state.step, 0);
  const int expected[] = {0, 0, 0, 0, 0, 0, 2, 2, 4, 4, 6};
  for (int step = 1; step <= 10; ++step) {
    history.Publish(At(step, 10ms));
    EXPECT_EQ(history.At(late)->state.step, expected[step]) << "step " << step;
    EXPECT_EQ(history.At({20ms})->state.step, step / 2 * 2) << "step " << step;
    SnapshotHistory::Frame frame;
    history.MakeFrame(frame);
    EXPECT_EQ(frame.At(late)->state.step, expected[step]) << "step " << step;
  }
  history.Restart(At(10, 10ms));
  EXPECT_EQ(history.At(late)->state.step, 10);
}

TEST(SnapshotHistory, ReturnsTheNextSamplingInstantUpToALimit) {
  SnapshotHistory history(At(0, 10ms));
  EXPECT_EQ(history.NextSampling(1s), 1s);
  history.Use({25ms, 100ms});
  history.Use({40ms});
  history.Use({});
  EXPECT_EQ(history.NextSampling(1s), 25ms);
  EXPECT_EQ(history.NextSampling(20ms), 20ms);
  history.Publish(At(3, 10ms));
  EXPECT_EQ(history.NextSampling(1s), 40ms);
  history.Publish(At(4, 10ms));
  EXPECT_EQ(history.NextSampling(1s), 50ms);
}

// The samples of 0, 20, 40, … ms are available 15 ms later.
TEST(SnapshotHistory, AChangeOfTheWorldKeepsTheSamples) {
  SnapshotHistory history(At(0, 10ms));
  const Cadence late{20ms, 15ms};
  history.Use(late);
  for (int step = 1; step <= 3; ++step) history.Publish(At(step, 10ms));
  const auto carry_over = [](const world::Snapshot& earlier) {
    auto snapshot = std::make_shared<world::Snapshot>(earlier);
    snapshot->step_length = 1ms;  // marks a changed snapshot
    return snapshot;
  };
  history.Change(At(3, 10ms), carry_over);
  EXPECT_EQ(history.At(late)->state.step, 0);
  EXPECT_EQ(history.At(late)->step_length, 1ms);
  EXPECT_EQ(history.latest()->state.step, 3);
  history.Publish(At(4, 10ms));
  EXPECT_EQ(history.At(late)->state.step, 2);
  EXPECT_EQ(history.At(late)->step_length, 1ms);
}

TEST(SnapshotHistory, RestartRemovesOlderSnapshots) {
  SnapshotHistory history(At(0, 10ms));
  history.At({1s});
  history.Publish(At(1, 10ms));
  history.Restart(At(1, 10ms));
  EXPECT_EQ(history.At({1s})->state.step, 1);
}

}  // namespace
}  // namespace gsv::simulation
