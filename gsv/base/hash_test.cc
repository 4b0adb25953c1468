#include "gsv/base/hash.h"

#include <gtest/gtest.h>

namespace gsv::base {
namespace {

TEST(Hash, WithoutInputEqualsXxh3OfTheEmptyInput) {
  EXPECT_EQ(Hash().Digest(), 0x2d06800538d394c2ull);
}

TEST(Hash, DistinguishesMinusZeroFromZero) {
  Hash positive, negative;
  positive.Add(0.0);
  negative.Add(-0.0);
  EXPECT_NE(positive.Digest(), negative.Digest());
}

TEST(Hash, DependsOnTheBoundariesOfStrings) {
  Hash left, right;
  left.Add("ab"), left.Add("c");
  right.Add("a"), right.Add("bc");
  EXPECT_NE(left.Digest(), right.Digest());
  EXPECT_EQ(left.Hex().size(), 16u);
}

}  // namespace
}  // namespace gsv::base
