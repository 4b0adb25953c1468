#include "gsv/base/late_library.h"

#include <gtest/gtest.h>

namespace {

// This test loads libm, because every machine has it.
TEST(LateLibrary, FindsAFunctionInALibrary) {
  const auto absolute =
      reinterpret_cast<double (*)(double)>(gsv_late_function("libm.so.6", "fabs"));
  EXPECT_EQ(absolute(-2.5), 2.5);
  EXPECT_EQ(gsv_late_function("libm.so.6", "fabs"), reinterpret_cast<void*>(absolute));
}

TEST(LateLibraryDeathTest, ExitsIfTheLibraryOrTheFunctionIsMissing) {
  EXPECT_EXIT(gsv_late_function("libnowhere.so.1", "f"), ::testing::ExitedWithCode(127),
              "gsv: cannot load libnowhere.so.1: .*No such file");
  EXPECT_EXIT(gsv_late_function("libm.so.6", "no_such_function"), ::testing::ExitedWithCode(127),
              "gsv: cannot load libm.so.6: .*no_such_function");
}

}  // namespace
