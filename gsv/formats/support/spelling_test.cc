#include "gsv/formats/support/spelling.h"

#include <gtest/gtest.h>

namespace gsv::formats {
namespace {

const ElementSupport& Definition(const char* name) { return SupportTable::Get().Definition(name); }

TEST(Spelling, CountsLettersToChange) {
  EXPECT_EQ(SpellingDistance("static", "static", 2), 0);
  EXPECT_EQ(SpellingDistance("statik", "static", 2), 1);
  EXPECT_EQ(SpellingDistance("sttaic", "static", 2), 1);  // adjacent letters are swapped
  EXPECT_EQ(SpellingDistance("colision", "collision", 2), 1);
  EXPECT_EQ(SpellingDistance("mass", "material", 2), 3);  // limited to `limit` + 1
}

TEST(Spelling, SuggestsTheIntendedElement) {
  EXPECT_EQ(AdviceForElement("colision", Definition("link"), "link"), "Did you mean <collision>?");
  EXPECT_EQ(AdviceForElement("inertail", Definition("link"), "link"), "Did you mean <inertial>?");
  EXPECT_EQ(AdviceForElement("wings", Definition("link"), "link"), "");
}

TEST(Spelling, SuggestsWhereAnElementBelongs) {
  EXPECT_EQ(AdviceForElement("limit", Definition("joint"), "joint"), "It belongs in <axis>.");
  EXPECT_EQ(AdviceForElement("friction", Definition("collision"), "collision"),
            "It belongs in <surface>.");
  EXPECT_EQ(AdviceForElement("mass", Definition("link"), "link"), "It belongs in <inertial>.");
  EXPECT_EQ(AdviceForElement("name", Definition("link"), "link"),
            "It is an attribute: <link name=\"…\">.");
  EXPECT_EQ(AdviceForAttribute("static", Definition("model")), "It is an element: <static>.");
  EXPECT_EQ(AdviceForAttribute("naem", Definition("model")), "Did you mean \"name\"?");
}

}  // namespace
}  // namespace gsv::formats
