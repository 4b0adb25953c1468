#include "gsv/recording/run_history.h"

#include <gtest/gtest.h>

#include "gsv/messages/cdr.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/presentation/notes.h"
#include "gsv/recording/testing/test_simulation.h"

namespace gsv::recording {
namespace {

using std::chrono_literals::operator""h;

constexpr std::size_t kCapacity = std::size_t{1} << 20;

std::map<std::string, std::uint64_t> CountsOf(const McapReader& reader) {
  std::map<std::string, std::uint64_t> counts;
  for (const auto& [id, count] : reader.summary().message_counts) {
    counts[reader.summary().channels.at(id).topic] += count;
  }
  return counts;
}

// A robot that drives towards a wall at 2 m/s.
class RunHistoryTest : public ::testing::Test {
 protected:
  // Takes steps and lets the history sample them, as if enough wall-clock time had passed.
  void Advance(int steps, bool is_watched = true) {
    ASSERT_TRUE(simulation_->Step(steps));
    ASSERT_EQ(simulation_->WaitForPhase({simulation::Phase::kPaused}, kTimeout),
              simulation::Phase::kPaused);
    now_ += 1h;
    history_.SampleIfDue(now_, is_watched);
  }
  std::unique_ptr<McapReader> Open() const {
    auto reader = history_.Open();
    EXPECT_TRUE(reader) << reader.error().Sentence();
    return *std::move(reader);
  }

  const std::shared_ptr<simulation::Simulation> simulation_ = MakeSimulation(1h, Drives(2));
  RunHistory history_{simulation_, kCapacity};
  std::chrono::steady_clock::time_point now_ = std::chrono::steady_clock::now();
};

TEST_F(RunHistoryTest, KeepsTheRunAsARecording) {
  EXPECT_FALSE(history_.Open());
  for (int i = 0; i < 5; ++i) Advance(10);
  const auto reader = Open();
  const auto counts = CountsOf(*reader);
  EXPECT_EQ(counts.at("/gsv/poses"), 5u);
  EXPECT_EQ(counts.at("/gsv/status"), 5u);
  EXPECT_GE(counts.at("/robot/front"), 4u);
  EXPECT_EQ(reader->summary().end, 500ms);
  ASSERT_EQ(reader->summary().metadata.size(), 1u);
  EXPECT_EQ(reader->Read(reader->summary().metadata[0]).value().values.at("name"), "simulation");
  ASSERT_GE(reader->summary().attachments.size(), 1u);
  for (const auto& attachment : reader->summary().attachments) {
    // Scenes are the only attachments, because a history contains no models.
    EXPECT_EQ(attachment.name, "scene.json");
  }
}

TEST_F(RunHistoryTest, ReadsNoSensorsWithoutViewers) {
  for (int i = 0; i < 5; ++i) Advance(10, false);
  const auto counts = CountsOf(*Open());
  EXPECT_EQ(counts.at("/gsv/poses"), 5u);
  EXPECT_FALSE(counts.contains("/robot/front"));
  EXPECT_FALSE(counts.contains("/gsv/health"));
}

TEST_F(RunHistoryTest, SamplesAtMostAtItsRates) {
  Advance(10);
  for (int i = 0; i < 100; ++i) {
    ASSERT_TRUE(simulation_->Step(1));
    (void)simulation_->WaitForPhase({simulation::Phase::kPaused}, kTimeout);
    history_.SampleIfDue(now_ + i * 1ms, true);  // at 20 Hz, two samples are due in this time
  }
  EXPECT_LE(CountsOf(*Open()).at("/gsv/poses"), 3u);
}

TEST_F(RunHistoryTest, HasEveryEventNoteAndCollision) {
  Advance(1);
  simulation_->Emit(presentation::kNoteEvent, "", presentation::NoteDetail(5ms, "look here"));
  Advance(200);  // after 4 m, the robot has reached the wall
  ASSERT_EQ(history_.collisions().size(), 1u);
  EXPECT_EQ(history_.collisions()[0].robot, "robot");
  EXPECT_EQ(history_.collisions()[0].other, "wall");
  const auto reader = Open();
  const auto counts = CountsOf(*reader);
  EXPECT_EQ(counts.at("/gsv/contacts"), 1u);
  EXPECT_EQ(counts.at("/gsv/notes"), 1u);
  EXPECT_GE(counts.at("/gsv/events"), 1u);
  auto cursor = reader->Messages();
  for (auto next = cursor.Next(); next && *next; next = cursor.Next()) {
    if (reader->summary().channels.at((*next)->channel_id).topic != "/gsv/notes") continue;
    EXPECT_EQ((*next)->log_time, 5ms);
    const auto note = messages::Decode<messages::gsv_msgs::LifecycleEvent>((*next)->data);
    EXPECT_EQ(note->detail, "look here");
  }
}

TEST_F(RunHistoryTest, StartsANewHistoryAfterAReset) {
  Advance(200);
  ASSERT_EQ(history_.collisions().size(), 1u);
  const auto before = Open();
  ASSERT_TRUE(simulation_->Stop());
  (void)simulation_->WaitForPhase({simulation::Phase::kStopped}, kTimeout);
  ASSERT_TRUE(simulation_->Reset());
  Advance(1);
  EXPECT_TRUE(history_.collisions().empty());
  EXPECT_EQ(Open()->summary().end, 10ms);
  EXPECT_EQ(before->summary().end, 2s);  // a reader does not change after it was opened
}

}  // namespace
}  // namespace gsv::recording
