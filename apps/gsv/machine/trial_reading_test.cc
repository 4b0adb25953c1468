#include "apps/gsv/machine/trial_reading.h"

#include <gtest/gtest.h>

namespace gsv::app {
namespace {

TEST(TrialReading, ReportsWhichLimitTheChildExceeded) {
  TrialLimits limits;
  limits.sandbox.memory_bytes = 1000;
  limits.sandbox.processor_time = std::chrono::seconds(20);
  limits.wall_time = std::chrono::seconds(30);
  EXPECT_EQ(WhyTrialFailed("", limits), "reading it takes longer than 30 s");
  EXPECT_EQ(WhyTrialFailed("signal 24", limits),  // SIGXCPU
            "reading it takes more than 20 s of processor time");
  EXPECT_EQ(WhyTrialFailed("signal 11", limits), "reading it crashes (signal 11)");
  EXPECT_EQ(WhyTrialFailed("exit code 1", limits), "reading it fails (exit code 1)");
}

TEST(TrialReading, NamesBothReasonsForWhichTheKernelSendsSigkill) {
  TrialLimits limits;
  limits.sandbox.processor_time = std::chrono::seconds(20);
  EXPECT_EQ(WhyTrialFailed("signal 9", limits),
            "reading it takes more than 20 s of processor time, or this machine has too little "
            "memory");
}

}  // namespace
}  // namespace gsv::app
