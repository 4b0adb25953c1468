#include "gsv/formats/support/spelling.h"

#include <gtest/gtest.h>

namespace gsv::formats {
namespace {

const ElementSupport& Definition(const char* name) { return SupportTable::Get().Definition(name); }

TEST(ElementSpelling, SuggestsTheIntendedElement) {
  EXPECT_EQ(AdviceForElement("colision", Definition("link"), "link"), "Did you mean <collision>?");
  EXPECT_EQ(AdviceForElement("inertail", Definition("link"), "link"), "Did you mean <inertial>?");
  EXPECT_EQ(AdviceForElement("wings", Definition("link"), "link"), "");
}

TEST(ElementSpelling, SuggestsWhereAnElementBelongs) {
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
