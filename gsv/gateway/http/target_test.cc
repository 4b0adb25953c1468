#include "gsv/gateway/http/target.h"

#include <gtest/gtest.h>

namespace gsv::gateway {
namespace {

using Segments = std::vector<std::string>;

TEST(Target, SplitsPathAndQueryAndDecodesEach) {
  const auto target =
      ParseTarget("/api/simulations/two%20words/x%2Fy?simulation=a%26b&empty&c=1=2");
  ASSERT_TRUE(target);
  EXPECT_EQ(target->segments, (Segments{"api", "simulations", "two words", "x/y"}));
  EXPECT_EQ(target->query, (std::map<std::string, std::string>{
                               {"simulation", "a&b"}, {"empty", ""}, {"c", "1=2"}}));
}

TEST(Target, RootHasNoSegments) {
  for (const char* root : {"/", "/?x=1", "/#part"}) {
    const auto target = ParseTarget(root);
    ASSERT_TRUE(target) << root;
    EXPECT_TRUE(target->segments.empty()) << root;
  }
}

TEST(Target, KeepsEmptySegmentsButNotAFinalSlash) {
  EXPECT_EQ(ParseTarget("/a//b/")->segments, (Segments{"a", "", "b"}));
}

TEST(Target, RefusesInvalidTargets) {
  for (const std::string& bad : {std::string(), std::string("api"), std::string("http://h/x"),
                                 std::string("/%"), std::string("/%4"), std::string("/%zz"),
                                 std::string("/a?b=%-1"), "/" + std::string(5000, 'a')}) {
    const auto target = ParseTarget(bad);
    ASSERT_FALSE(target) << bad.substr(0, 20);
    EXPECT_EQ(target.error().code, base::ErrorCode::kInvalidArgument);
  }
}

TEST(Target, HasAtMost4096Bytes) {
  EXPECT_EQ(ParseTarget("/" + std::string(4095, 'a'))->segments, Segments{std::string(4095, 'a')});
  EXPECT_FALSE(ParseTarget("/" + std::string(4096, 'a')));
}

TEST(Target, ParseReversesEscape) {
  std::string all;
  for (int c = 0; c < 256; ++c) all += static_cast<char>(c);
  const auto target = ParseTarget("/" + Escape(all) + "?q=" + Escape(all));
  ASSERT_TRUE(target);
  EXPECT_EQ(target->segments, Segments{all});
  EXPECT_EQ(target->query.at("q"), all);
}

}  // namespace
}  // namespace gsv::gateway
