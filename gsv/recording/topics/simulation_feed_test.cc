#include "gsv/recording/topics/simulation_feed.h"

#include <future>

#include <gtest/gtest.h>

#include "gsv/recording/testing/test_simulation.h"

namespace gsv::recording {
namespace {

TEST(Instants, AreReachedAtTheFirstSnapshotAtOrAfterThem) {
  Instants instants(30ms);
  std::vector<int> taken;
  for (int time = 0; time <= 120; time += 20) {
    if (instants.AdvanceTo(std::chrono::milliseconds(time))) taken.push_back(time);
  }
  // The first snapshots at or after 0, 30, 60, 90 and 120 ms.
  EXPECT_EQ(taken, (std::vector<int>{0, 40, 60, 100, 120}));
}

TEST(Instants, AreNotReachedBeforeTheFirstSnapshot) {
  Instants instants(50ms);
  EXPECT_FALSE(instants.AdvanceTo(70ms));
  EXPECT_FALSE(instants.AdvanceTo(90ms));
  EXPECT_TRUE(instants.AdvanceTo(100ms));
}

TEST(Instants, AreReportedOnceIfSeveralLieBetweenTwoSnapshots) {
  Instants instants(10ms);
  EXPECT_TRUE(instants.AdvanceTo(0ms));
  EXPECT_TRUE(instants.AdvanceTo(55ms));
  EXPECT_FALSE(instants.AdvanceTo(59ms));
}

class SimulationFeedTest : public testing::Test {
 protected:
  const std::shared_ptr<simulation::Simulation> simulation_ = MakeSimulation(1s, nullptr);
};

TEST_F(SimulationFeedTest, InRealTimeExcessSnapshotsAreDroppedAndCounted) {
  SimulationFeed feed(*simulation_, {.when_full = WhenFull::kDrop, .capacity = 2});
  for (int i = 0; i < 5; ++i) feed.OnSnapshot(simulation_->snapshot());
  EXPECT_EQ(feed.dropped(), 3u);
  EXPECT_TRUE(feed.Next(0ms));
  EXPECT_TRUE(feed.Next(0ms));
  EXPECT_FALSE(feed.Next(0ms));
}

TEST_F(SimulationFeedTest, InLockstepTheStepWaitsForSpace) {
  SimulationFeed feed(*simulation_, {.when_full = WhenFull::kWait, .capacity = 1});
  feed.OnSnapshot(simulation_->snapshot());
  auto second = std::async(std::launch::async, [&] { feed.OnSnapshot(simulation_->snapshot()); });
  EXPECT_TRUE(feed.Next(kTimeout));
  EXPECT_TRUE(feed.Next(kTimeout));
  second.get();
  EXPECT_EQ(feed.dropped(), 0u);
}

TEST_F(SimulationFeedTest, ClosingReleasesTheWaitingStep) {
  SimulationFeed feed(*simulation_, {.when_full = WhenFull::kWait, .capacity = 1});
  feed.OnSnapshot(simulation_->snapshot());
  auto second = std::async(std::launch::async, [&] { feed.OnSnapshot(simulation_->snapshot()); });
  feed.Close();
  second.get();
  EXPECT_FALSE(feed.is_over());
  EXPECT_TRUE(feed.Next(0ms));
  EXPECT_TRUE(feed.is_over());
}

TEST_F(SimulationFeedTest, SensorsAreListedAtTheFirstSnapshot) {
  SimulationFeed feed(*simulation_, {});
  feed.OnSnapshot(simulation_->snapshot());
  feed.OnSnapshot(simulation_->snapshot());
  const auto first = feed.Next(0ms);
  const auto second = feed.Next(0ms);
  ASSERT_TRUE(first && second);
  const auto& sensors = std::get<Observation>(*first).sensors;
  ASSERT_NE(sensors, nullptr);
  ASSERT_EQ(sensors->at("robot").size(), 1u);
  EXPECT_EQ(sensors->at("robot")[0].name, "front");
  EXPECT_EQ(std::get<Observation>(*second).sensors, nullptr);
}

TEST_F(SimulationFeedTest, CreatedSensorsAreListedAtTheNextSecond) {
  SimulationFeed feed(*simulation_, {});
  const auto lists_at = [&](base::SimTime time) {
    auto snapshot = std::make_shared<world::Snapshot>(*simulation_->snapshot());
    snapshot->state.time = time;
    feed.OnSnapshot(snapshot);
    return std::get<Observation>(*feed.Next(0ms)).sensors;
  };
  EXPECT_NE(lists_at(0s), nullptr);
  EXPECT_EQ(lists_at(1s), nullptr);
  model::SensorDescription back;
  back.name = "back";
  back.type = "sonar";
  const std::shared_ptr<simulation::Agent> agent = simulation_->agent("robot");
  ASSERT_TRUE(agent->CreateSensor(back));
  EXPECT_EQ(lists_at(1500ms), nullptr);
  const auto with_two = lists_at(2s);
  ASSERT_NE(with_two, nullptr);
  EXPECT_EQ(with_two->at("robot").size(), 2u);
  EXPECT_EQ(lists_at(3s), nullptr);
  ASSERT_TRUE(agent->CloseSensor("back"));
  const auto with_one = lists_at(4s);
  ASSERT_NE(with_one, nullptr);
  EXPECT_EQ(with_one->at("robot").size(), 1u);
}

TEST_F(SimulationFeedTest, TheLastSnapshotIsTheCurrentState) {
  SimulationFeed feed(*simulation_, {.capacity = 1});
  feed.OnEvent({0, base::SimTime(0), "started", "", ""});
  feed.CloseAtLatest();
  feed.OnEvent({1, base::SimTime(10ms), "stopped", "", ""});
  ASSERT_TRUE(feed.Next(0ms));
  const auto last = feed.Next(0ms);
  ASSERT_TRUE(last);
  EXPECT_EQ(std::get<Observation>(*last).snapshot, simulation_->snapshot());
  EXPECT_TRUE(std::get<Observation>(*last).status);
  EXPECT_TRUE(feed.is_over());
}

TEST_F(SimulationFeedTest, AResetClosesItAfterTheQueuedSnapshots) {
  SimulationFeed feed(*simulation_, {});
  feed.OnSnapshot(simulation_->snapshot());
  feed.OnEvent({0, base::SimTime(0), "reset", "", ""});
  feed.OnSnapshot(simulation_->snapshot());
  feed.OnEvent({0, base::SimTime(0), "started", "", ""});
  EXPECT_TRUE(feed.was_reset());
  const auto first = feed.Next(0ms);
  ASSERT_TRUE(first);
  EXPECT_TRUE(std::holds_alternative<Observation>(*first));
  EXPECT_TRUE(feed.is_over());
}

}  // namespace
}  // namespace gsv::recording
