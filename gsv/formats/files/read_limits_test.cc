#include "gsv/formats/files/read_limits.h"

#include <gmock/gmock.h>

namespace gsv::formats {
namespace {

using testing::HasSubstr;

TEST(ReadLimits, AreSetByName) {
  ReadLimits limits;
  EXPECT_TRUE(SetLimit("mesh_triangles=20000000", limits));
  EXPECT_TRUE(SetLimit("texture_side=16384", limits));
  EXPECT_EQ(limits.mesh_triangles, 20'000'000u);
  EXPECT_EQ(limits.texture_side, 16384);
}

TEST(ReadLimits, RefuseInvalidTexts) {
  for (const char* text : {"mesh_triangles", "mesh_triangles=", "mesh_triangles=0",
                           "mesh_triangles=-1", "texture_side=3000000000", "xml_depth=7 levels"}) {
    ReadLimits limits;
    EXPECT_FALSE(SetLimit(text, limits)) << text;
    EXPECT_EQ(limits.mesh_triangles, ReadLimits().mesh_triangles);
  }
  ReadLimits limits;
  EXPECT_THAT(SetLimit("polygons=5", limits).error().Sentence(), HasSubstr("mesh_triangles"));
}

}  // namespace
}  // namespace gsv::formats
