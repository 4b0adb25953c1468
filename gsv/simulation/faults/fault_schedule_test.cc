#include "gsv/simulation/faults/fault_schedule.h"

#include <string>

#include <gmock/gmock.h>

namespace gsv::simulation {
namespace {

using namespace std::chrono_literals;

scenario::Fault At(double time, const std::string& body) {
  scenario::Fault fault;
  fault.at = time;
  fault.body = body;
  return fault;
}

std::vector<std::string> TakeAllDue(FaultSchedule& schedule, base::SimTime now) {
  std::vector<std::string> bodies;
  while (schedule.IsDue(now)) bodies.push_back(schedule.TakeDue().body);
  return bodies;
}

TEST(FaultSchedule, OrdersFaultsByTimeAndThenByPosition) {
  FaultSchedule schedule({At(2, "late"), At(1, "first"), At(1, "second"), At(0, "start")});
  EXPECT_THAT(TakeAllDue(schedule, 0s), testing::ElementsAre("start"));
  EXPECT_THAT(TakeAllDue(schedule, 2s), testing::ElementsAre("first", "second", "late"));
  EXPECT_EQ(schedule.done(), 4u);
  EXPECT_FALSE(schedule.IsDue(1h));
}

TEST(FaultSchedule, FaultIsDueAtItsTime) {
  FaultSchedule schedule({At(0.5, "robot")});
  EXPECT_FALSE(schedule.IsDue(499ms));
  EXPECT_TRUE(schedule.IsDue(500ms));
  EXPECT_TRUE(schedule.IsDue(501ms));
}

TEST(FaultSchedule, ReturnsTheNextInstantUpToALimit) {
  FaultSchedule schedule({At(2, "b"), At(1, "a")});
  EXPECT_EQ(schedule.Next(3s), 1s);
  EXPECT_EQ(schedule.Next(500ms), 500ms);
  TakeAllDue(schedule, 3s);
  EXPECT_EQ(schedule.Next(3s), 3s);
}

TEST(FaultSchedule, RewindRestartsTheFaults) {
  FaultSchedule schedule({At(2, "b"), At(1, "a")});
  const auto once = TakeAllDue(schedule, 3s);
  schedule.Rewind();
  EXPECT_EQ(schedule.done(), 0u);
  EXPECT_EQ(TakeAllDue(schedule, 3s), once);
}

}  // namespace
}  // namespace gsv::simulation
