#include "gsv/formats/sdf/sdf_schema.h"

#include <string>

#include <gtest/gtest.h>
#include <sdf/Param.hh>
#include <sdf/SDFImpl.hh>
#include <sdf/parser.hh>

namespace gsv::formats {
namespace {

std::string TextOf(const sdf::ParamPtr& param) {
  if (param == nullptr) return "none";
  std::string text = param->GetKey() + "|" + param->GetTypeName() + "|" +
                     param->GetDefaultAsString() + "|" + std::to_string(param->GetRequired()) +
                     "|" + param->GetDescription();
  for (const auto& limit : {param->GetMinValueAsString(), param->GetMaxValueAsString()}) {
    text += "|" + limit.value_or("none");
  }
  return text;
}

// Returns the content of an element's description, without the descriptions of its children.
std::string TextOf(const sdf::Element& element) {
  std::string text = element.GetName() + "|" + element.GetRequired() + "|" +
                     element.GetDescription() + "|" + element.ReferenceSDF() + "|" +
                     std::to_string(element.GetCopyChildren()) + "|" + TextOf(element.GetValue());
  for (const sdf::ParamPtr& attribute : element.GetAttributes()) text += "|" + TextOf(attribute);
  return text;
}

// Returns the number of descriptions that were compared.
int ExpectSame(const sdf::Element& ours, const sdf::Element& theirs, const std::string& path) {
  EXPECT_EQ(TextOf(ours), TextOf(theirs)) << path;
  EXPECT_EQ(ours.GetElementDescriptionCount(), theirs.GetElementDescriptionCount()) << path;
  if (::testing::Test::HasFailure()) return 0;
  int compared = 1;
  for (unsigned i = 0; i < ours.GetElementDescriptionCount(); ++i) {
    const sdf::ElementPtr their_child = theirs.GetElementDescription(i);
    compared += ExpectSame(*ours.GetElementDescription(i), *their_child,
                           path + "/" + their_child->GetName());
  }
  return compared;
}

TEST(SdfSchema, EqualsTheSchemaOfLibsdformat) {
  const sdf::SDFPtr theirs(new sdf::SDF);
  ASSERT_TRUE(sdf::init(theirs));
  const sdf::ElementPtr ours = MakeSdfSchema();
  ASSERT_NE(ours, nullptr);
  EXPECT_GT(ExpectSame(*ours, *theirs->Root(), "sdf"), 1000);
}

TEST(SdfSchema, OmitsUnwantedElements) {
  const sdf::ElementPtr schema = MakeSdfSchema({"sensor", "actor", "frame"});
  const sdf::ElementPtr world = schema->GetElementDescription("world");
  EXPECT_FALSE(world->HasElementDescription("actor"));
  const sdf::ElementPtr model = world->GetElementDescription("model");
  EXPECT_FALSE(model->HasElementDescription("frame"));
  EXPECT_TRUE(model->HasElementDescription("joint"));
  const sdf::ElementPtr link = model->GetElementDescription("link");
  EXPECT_FALSE(link->HasElementDescription("sensor"));
  EXPECT_TRUE(link->HasElementDescription("inertial"));
}

}  // namespace
}  // namespace gsv::formats
