// The broker as another ORB's programs see it: tests/end_to_end/trading_client.tcl, on Combat.
#include <cstdlib>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/programs.h"

namespace gsv::testing {
namespace {

using ::testing::HasSubstr;

TEST(ForeignTrading, ATclClientExportsQueriesLinksAndWithdraws) {
  const BrokerProcess near;
  const BrokerProcess far;
  const std::string client =
      std::string(std::getenv("GSV_SOURCE_DIR")) + "/tests/end_to_end/trading_client.tcl";
  const Outcome outcome = RunProgram(client, {near.reference(), far.reference()});
  EXPECT_EQ(outcome.ending, "exit code 0") << outcome.out << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("policy request_id\n"));
  EXPECT_THAT(outcome.out, HasSubstr("follows the link\n"));
  EXPECT_THAT(outcome.out, HasSubstr("withdraws by constraint\n"));
}

}  // namespace
}  // namespace gsv::testing
