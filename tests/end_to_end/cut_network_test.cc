// Offers of a service whose host can no longer be reached.
#include <csignal>
#include <cstdlib>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;

// The program that carries the packets between two network namespaces stands still: nothing is
// refused and nothing answers, as when a cable is pulled.
TEST(CutNetwork, TheOffersOfAHostThatCannotBeReachedGoAway) {
  Running link(std::string(std::getenv("GSV_SOURCE_DIR")) + "/tests/end_to_end/slow_link.py",
               {"1"});
  const auto line = link.process().ReadLine(kPatience);
  if (!line) {
    const Outcome outcome = link.AwaitEnd();
    ASSERT_EQ(outcome.ending, "exit code 77") << outcome.err;
    GTEST_SKIP() << outcome.err;
  }
  std::istringstream words(*line);
  std::string ready, network, here;
  ASSERT_TRUE(words >> ready >> network >> here) << *line;

  Running broker("gsv", {"broker", "--listen", here, "--port", "0", "--memory", "--liveness-period",
                         "0.2", "--liveness-patience", "3"});
  const std::string reference = broker.AwaitLine("corbaloc");
  Running behaviour("gsv-wander", {"--broker", reference}, {"ip", "netns", "exec", network});
  behaviour.AwaitLine("offered at");
  const auto offers = [&] {
    return RunProgram("gsv", {"offers", "--broker", reference, "--json"}).out;
  };
  ASSERT_THAT(offers(), HasSubstr("AgentBehaviourFactory"));
  link.process().Signal(SIGSTOP);
  while (!offers().empty()) {
  }
  EXPECT_THAT(broker.errors(), HasSubstr("withdrawn: it has not answered for too long"));
  link.process().Signal(SIGCONT);
}

}  // namespace
}  // namespace gsv::testing
