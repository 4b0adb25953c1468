// Tests the broker with programs of another ORB: tests/end_to_end/trading_client.tcl, on Combat.
#include <cstdlib>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;

TEST(ForeignTrading, TclClientExportsQueriesLinksAndWithdraws) {
  const BrokerProcess near;
  const BrokerProcess far;
  const std::string client =
      std::string(std::getenv("GSV_SOURCE_DIR")) + "/tests/end_to_end/trading_client.tcl";
  const Outcome outcome = RunProgram(client, {near.reference(), far.reference()});
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.out << outcome.err;
  // These are all policies that the OMG Trading Service defines.
  for (const char* policy :
       {"search_card", "match_card", "return_card", "exact_type_match", "use_modifiable_properties",
        "use_dynamic_properties", "use_proxy_offers", "hop_count", "link_follow_rule",
        "starting_trader", "request_id"}) {
    EXPECT_THAT(outcome.out, HasSubstr("policy " + std::string(policy) + "\n"));
  }
  for (const char* done :
       {"queries", "iterates", "asks through a proxy", "links", "follows the link",
        "starts elsewhere", "unlinks", "withdraws", "withdraws by constraint"}) {
    EXPECT_THAT(outcome.out, HasSubstr(std::string(done) + "\n"));
  }
}

}  // namespace
}  // namespace gsv::testing
