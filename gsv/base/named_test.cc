#include "gsv/base/named.h"

#include <gtest/gtest.h>

namespace gsv::base {
namespace {

constexpr Named<int> kSizes[] = {{"int8", 1}, {"int16", 2}};

TEST(Named, FindsTheValueOfAName) {
  ASSERT_NE(FindNamed(kSizes, "int16"), nullptr);
  EXPECT_EQ(*FindNamed(kSizes, "int16"), 2);
}

TEST(Named, ReturnsNullForAnUnknownName) {
  EXPECT_EQ(FindNamed(kSizes, "int"), nullptr);
  EXPECT_EQ(FindNamed(kSizes, ""), nullptr);
}

}  // namespace
}  // namespace gsv::base
