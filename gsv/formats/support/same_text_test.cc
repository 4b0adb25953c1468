#include "gsv/formats/support/same_text.h"

#include <gtest/gtest.h>

namespace gsv::formats {
namespace {

TEST(SameText, ComparesNumbersByTheirValue) {
  EXPECT_TRUE(SaysTheSame("0 0 0", " 0.0\n-0 0e5 "));
  EXPECT_TRUE(SaysTheSame("1e12", "1000000000000.0"));
  EXPECT_TRUE(SaysTheSame("inf", "+inf"));
  EXPECT_FALSE(SaysTheSame("0.2", "0.21"));
  EXPECT_FALSE(SaysTheSame("0 0 0", "0 0"));
  EXPECT_FALSE(SaysTheSame("0 0", "0 0 0"));
}

TEST(SameText, ComparesBooleansAndWords) {
  EXPECT_TRUE(SaysTheSame("true", "1"));
  EXPECT_TRUE(SaysTheSame("false", "0"));
  EXPECT_TRUE(SaysTheSame("", "  "));
  EXPECT_FALSE(SaysTheSame("true", "false"));
  EXPECT_FALSE(SaysTheSame("NED", "ENU"));
  EXPECT_FALSE(SaysTheSame("", "0"));
}

}  // namespace
}  // namespace gsv::formats
