#include "gsv/formats/sdf/shared_descriptions.h"

#include <string>

#include <gtest/gtest.h>
#include <sdf/Element.hh>
#include <sdf/Param.hh>

#include "gsv/formats/sdf/sdf_document.h"
#include "gsv/formats/sdf/sdf_schema.h"

namespace gsv::formats {
namespace {

constexpr char kNested[] = R"(<sdf version="1.4"><world name="w">
  <model name="m"><link name="l"><sensor name="s" type="ray"/>
    <visual name="v"><geometry><box><size>1 2 3</size></box></geometry><extra><any a="1"/></extra></visual></link>
    <model name="inner"><link name="l"/></model></model></world></sdf>)";

// Returns the description of an element, with the descriptions of all elements below it, as text.
std::string AllBelow(const sdf::Element& element) {
  std::string text = "<" + element.GetName() + element.GetRequired();
  for (const sdf::ParamPtr& attribute : element.GetAttributes()) {
    text += " " + attribute->GetKey() + "=" + attribute->GetAsString();
  }
  if (element.GetValue() != nullptr) text += ">" + element.GetValue()->GetAsString();
  for (unsigned i = 0; i < element.GetElementDescriptionCount(); ++i) {
    text += AllBelow(*element.GetElementDescription(i));
  }
  return text + ">";
}

TEST(SharedDescriptions, AreTheSameObjectsInCopies) {
  const base::MutexLock lock(SdformatMutex());
  EXPECT_TRUE(SharesDescriptions());
}

TEST(SharedDescriptions, DoNotChangeAsDocumentsAreRead) {
  base::Problems problems;
  const auto document = ParseSdf({"nested.sdf", kNested}, {}, problems);
  ASSERT_TRUE(document) << document.error().message;
  const base::MutexLock lock(SdformatMutex());
  EXPECT_EQ(AllBelow(*SdfSchema()), AllBelow(*MakeSdfSchema()));
}

TEST(SharedDescriptions, AreSharedByNestedModels) {
  base::Problems problems;
  const auto document = ParseSdf({"nested.sdf", kNested}, {}, problems);
  ASSERT_TRUE(document) << document.error().message;
  const sdf::ElementPtr outer = document->root->Element()->GetElement("world")->GetElement("model");
  const sdf::ElementPtr inner = outer->GetElement("model");
  const base::MutexLock lock(SdformatMutex());
  EXPECT_EQ(AllBelow(*inner->GetElementDescription("joint")),
            AllBelow(*SdfSchema()->GetElementDescription("model")->GetElementDescription("joint")));
}

TEST(SharedDescriptions, KeepCopiesOfElementsIndependent) {
  base::Problems problems;
  const auto document = ParseSdf({"nested.sdf", kNested}, {}, problems);
  ASSERT_TRUE(document) << document.error().message;
  const base::MutexLock lock(SdformatMutex());
  const sdf::ElementPtr original = document->root->Element();
  const std::string text = original->ToString("");
  const sdf::ElementPtr copy = original->Clone();
  EXPECT_EQ(copy->ToString(""), text);
  const sdf::ElementPtr model = copy->GetElement("world")->GetElement("model");
  EXPECT_EQ(model->GetParent(), copy->GetElement("world"));
  EXPECT_EQ(model->FilePath(), original->GetElement("world")->GetElement("model")->FilePath());
  EXPECT_EQ(model->LineNumber(), 2);
  model->GetAttribute("name")->SetFromString("renamed");
  model->GetElement("link")->GetElement("visual")->GetElement("geometry")->ClearElements();
  EXPECT_NE(copy->ToString(""), text);
  EXPECT_EQ(original->ToString(""), text);
}

}  // namespace
}  // namespace gsv::formats
