// Tests the offers of a service whose host is no longer reachable.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/group.h"
#include "tests/support/other_host.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;

TEST(CutNetwork, OffersOfAnUnreachableHostAreWithdrawn) {
  OtherHost host(1);
  if (!host.refusal().empty()) GTEST_SKIP() << host.refusal();
  const Group group;
  Running broker("gsv", {"broker", "--listen", host.address_here(), "--port", "0", "--memory",
                         "--liveness-period", "0.2", "--liveness-patience", "3"});
  const std::string reference = broker.AwaitLine("corbaloc");
  Running behaviour("gsv-wander", {"--broker", reference}, host.wrapper());
  behaviour.AwaitLine("offered at");
  const auto offers = [&] {
    return RunProgram("gsv", {"offers", "--broker", reference, "--json"}).out;
  };
  ASSERT_THAT(offers(), HasSubstr("AgentBehaviourFactory"));
  host.Cut();
  while (!offers().empty()) {
  }
  EXPECT_THAT(broker.errors(), HasSubstr("it has not responded for too long"));
  host.Mend();
}

}  // namespace
}  // namespace gsv::testing
