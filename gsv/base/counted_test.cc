#include "gsv/base/counted.h"

#include <gtest/gtest.h>

namespace gsv::base {
namespace {

TEST(Counted, OneIsSingular) {
  EXPECT_EQ(Counted(0, "error"), "0 errors");
  EXPECT_EQ(Counted(1, "error"), "1 error");
  EXPECT_EQ(Counted(2, "error"), "2 errors");
}

}  // namespace
}  // namespace gsv::base
