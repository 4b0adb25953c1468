#include "gsv/formats/xacro/macro.h"

#include <gtest/gtest.h>

namespace gsv::formats::xacro {
namespace {

TEST(ParseParameters, DistinguishesValuesBlocksAndDefaults) {
  const auto parameters =
      ParseParameters("a  b:=1\n c=x d:=^ e:=^|2 f:='x y' g:=${1 + 2} *h **i j := 3");
  ASSERT_EQ(parameters.size(), 10u);
  EXPECT_EQ(parameters[0].name, "a");
  EXPECT_FALSE(parameters[0].otherwise);
  EXPECT_EQ(parameters[1].otherwise, "1");
  EXPECT_EQ(parameters[2].otherwise, "x");
  EXPECT_TRUE(parameters[3].is_forwarded);
  EXPECT_FALSE(parameters[3].otherwise);
  EXPECT_TRUE(parameters[4].is_forwarded);
  EXPECT_EQ(parameters[4].otherwise, "2");
  EXPECT_EQ(parameters[5].otherwise, "'x y'");
  EXPECT_EQ(parameters[6].otherwise, "${1 + 2}");
  EXPECT_EQ(parameters[7].name, "h");
  EXPECT_EQ(parameters[7].kind, Parameter::Kind::kBlock);
  EXPECT_EQ(parameters[8].kind, Parameter::Kind::kChildren);
  EXPECT_EQ(parameters[9].otherwise, "3");
}

}  // namespace
}  // namespace gsv::formats::xacro
