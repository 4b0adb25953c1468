#include "gsv/formats/support/same_text.h"

#include <gtest/gtest.h>

namespace gsv::formats {
namespace {

TEST(SameText, ComparesNumbersByTheirValue) {
  EXPECT_TRUE(HasSameMeaning("0 0 0", " 0.0\n-0 0e5 "));
  EXPECT_TRUE(HasSameMeaning("1e12", "1000000000000.0"));
  EXPECT_TRUE(HasSameMeaning("inf", "+inf"));
  EXPECT_FALSE(HasSameMeaning("0.2", "0.21"));
  EXPECT_FALSE(HasSameMeaning("0 0 0", "0 0"));
  EXPECT_FALSE(HasSameMeaning("0 0", "0 0 0"));
}

TEST(SameText, ComparesBooleansAndWords) {
  EXPECT_TRUE(HasSameMeaning("true", "1"));
  EXPECT_TRUE(HasSameMeaning("false", "0"));
  EXPECT_TRUE(HasSameMeaning("", "  "));
  EXPECT_FALSE(HasSameMeaning("true", "false"));
  EXPECT_FALSE(HasSameMeaning("NED", "ENU"));
  EXPECT_FALSE(HasSameMeaning("", "0"));
}

}  // namespace
}  // namespace gsv::formats
