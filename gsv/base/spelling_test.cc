#include "gsv/base/spelling.h"

#include <gtest/gtest.h>

namespace gsv::base {
namespace {

TEST(Spelling, DistanceCountsChangedLetters) {
  EXPECT_EQ(SpellingDistance("static", "static", 2), 0);
  EXPECT_EQ(SpellingDistance("statik", "static", 2), 1);
  EXPECT_EQ(SpellingDistance("sttaic", "static", 2), 1);  // two adjacent letters are swapped
  EXPECT_EQ(SpellingDistance("colision", "collision", 2), 1);
  // The distance exceeds the limit, so the result is the limit plus one.
  EXPECT_EQ(SpellingDistance("mass", "material", 2), 3);
  EXPECT_EQ(SpellingDistance(std::string(65, 'a'), std::string(65, 'a'), 2), 3);
}

TEST(Spelling, SuggestsTheClosestKnownName) {
  const std::vector<std::string> worlds{"hall", "maze", "office", "playground", "warehouse"};
  EXPECT_EQ(ClosestName("offise", worlds), "office");
  // Two wrong letters are accepted only in names of eight or more letters.
  EXPECT_EQ(ClosestName("wharehuose", worlds), "warehouse");
  EXPECT_EQ(ClosestName("ofise", worlds), "");
  EXPECT_EQ(ClosestName("office", worlds), "");
  EXPECT_EQ(ClosestName("rn", {"run"}), "");
  EXPECT_EQ(ClosestName("wells", {"wall", "walls"}), "walls");
  EXPECT_EQ(ClosestName("ware", worlds), "warehouse");
  // Both names begin with "wall", so the function returns neither.
  EXPECT_EQ(ClosestName("wall", {"wallpaper", "wallflower"}), "");
  EXPECT_EQ(ClosestName("pss", {"ps", "pause"}), "ps");
  EXPECT_EQ(ClosestName("wa", worlds), "");
}

TEST(Spelling, DidYouMeanFormatsTheEndOfAMessage) {
  EXPECT_EQ("there is no command rnu" + DidYouMean("rnu", {"rec", "run"}),
            "there is no command rnu. Did you mean run?");
  EXPECT_EQ(DidYouMean("fly", {"rec", "run"}), "");
}

}  // namespace
}  // namespace gsv::base
