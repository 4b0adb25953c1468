#include "gsv/formats/sdf/shared_regex.h"

#include <regex>
#include <string>

#include <gtest/gtest.h>

namespace gsv::formats {
namespace {

#ifdef __GLIBCXX__

TEST(SharedRegex, CompilesEqualExpressionsOnce) {
  const std::size_t before = SharedRegexCount();
  const std::regex first("(a+)b_shared"), second("(a+)b_shared");
  EXPECT_EQ(SharedRegexCount(), before + 1);
  const std::regex of_any_case("(a+)b_shared", std::regex::icase);
  EXPECT_EQ(SharedRegexCount(), before + 2);
  for (const std::regex& each : {first, second, of_any_case}) {
    std::cmatch match;
    ASSERT_TRUE(std::regex_match("aaab_shared", match, each));
    EXPECT_EQ(match[1], "aaa");
  }
  EXPECT_FALSE(std::regex_match("AB_SHARED", second));
  EXPECT_TRUE(std::regex_match("AB_SHARED", of_any_case));
}

TEST(SharedRegex, ThrowsForABadExpressionEachTime) {
  for (int times = 0; times < 2; ++times) EXPECT_THROW(std::regex("(a"), std::regex_error);
}

TEST(SharedRegex, IsBounded) {
  for (std::size_t i = 0; i < 2 * kMaxSharedRegexes; ++i) {
    const std::string text = "bounded" + std::to_string(i);
    EXPECT_TRUE(std::regex_match(text, std::regex(text)));
  }
  EXPECT_EQ(SharedRegexCount(), kMaxSharedRegexes);
}

#endif

}  // namespace
}  // namespace gsv::formats
