#include "gsv/simulation/history/event_log.h"

#include <gmock/gmock.h>

namespace gsv::simulation {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

std::shared_ptr<world::Snapshot> SnapshotAt(std::int64_t step) {
  auto snapshot = std::make_shared<world::Snapshot>();
  snapshot->state.step = step;
  snapshot->state.time = step * 10ms;
  return snapshot;
}

std::vector<std::string> KindsOf(const std::vector<Event>& events) {
  std::vector<std::string> kinds;
  kinds.reserve(events.size());
  for (const Event& event : events) kinds.push_back(event.kind);
  return kinds;
}

class Notebook final : public Observer {
 public:
  void OnSnapshot(const std::shared_ptr<const world::Snapshot>& snapshot) override {
    steps.push_back(snapshot->state.step);
  }
  void OnEvent(const Event& event) override { events.push_back(event); }

  std::vector<std::int64_t> steps;
  std::vector<Event> events;
};

TEST(EventLog, StampsEventsWithTheLatestSnapshot) {
  SnapshotHistory history(SnapshotAt(0));
  EventLog log(history);
  log.Emit("started");
  history.Publish(SnapshotAt(7));
  log.Emit("agent_dead", "robot", "why");
  const std::vector<Event> events = log.Since(0);
  ASSERT_EQ(events.size(), 2u);
  EXPECT_EQ(events[0].step, 0);
  EXPECT_EQ(events[1].step, 7);
  EXPECT_EQ(events[1].time, 70ms);
  EXPECT_EQ(events[1].robot, "robot");
  EXPECT_EQ(events[1].detail, "why");
}

TEST(EventLog, DropsTheOldestEventsAndKeepsTheNumbersOfOthers) {
  const SnapshotHistory history(SnapshotAt(0));
  EventLog log(history, 3);
  for (const char* kind : {"0", "1", "2", "3", "4"}) log.Emit(kind);
  EXPECT_EQ(log.count(), 5u);
  EXPECT_THAT(KindsOf(log.Since(0)), ElementsAre("2", "3", "4"));
  EXPECT_THAT(KindsOf(log.Since(3)), ElementsAre("3", "4"));
  EXPECT_THAT(KindsOf(log.Since(5)), IsEmpty());
  EXPECT_THAT(KindsOf(log.Since(6)), IsEmpty());
}

TEST(EventLog, NotifiesObserversUntilTheyAreRemoved) {
  const SnapshotHistory history(SnapshotAt(0));
  EventLog log(history);
  const auto first = std::make_shared<Notebook>(), second = std::make_shared<Notebook>();
  log.Emit("before");
  log.AddObserver(first);
  log.AddObserver(second);
  log.Emit("both");
  log.Publish(SnapshotAt(1));
  log.RemoveObserver(first);
  log.Emit("second only");
  log.Publish(SnapshotAt(2));
  EXPECT_THAT(KindsOf(first->events), ElementsAre("both"));
  EXPECT_THAT(KindsOf(second->events), ElementsAre("both", "second only"));
  EXPECT_THAT(first->steps, ElementsAre(1));
  EXPECT_THAT(second->steps, ElementsAre(1, 2));
}

// Reads the log inside a callback, which observers may do.
class LogReader final : public Observer {
 public:
  explicit LogReader(const EventLog& log) : log_(log) {}
  void OnSnapshot(const std::shared_ptr<const world::Snapshot>&) override { seen = log_.count(); }
  void OnEvent(const Event&) override {}

  std::uint64_t seen = 0;

 private:
  const EventLog& log_;
};

TEST(EventLog, HoldsNoLockWhileObserversGetASnapshot) {
  const SnapshotHistory history(SnapshotAt(0));
  EventLog log(history);
  const auto asker = std::make_shared<LogReader>(log);
  log.AddObserver(asker);
  log.Emit("started");
  log.Publish(SnapshotAt(1));
  EXPECT_EQ(asker->seen, 1u);
}

}  // namespace
}  // namespace gsv::simulation
