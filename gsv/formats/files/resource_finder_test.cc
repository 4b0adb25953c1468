#include "gsv/formats/files/resource_finder.h"

#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"

namespace gsv::formats {
namespace {

using testing::HasSubstr;

std::string Empty(const std::string& version) { return "<sdf version='" + version + "'/>"; }

TEST(ResourceFinder, FindsModelsBesideTheFileInItsParentsAndTheirModelsFolders) {
  const base::testing::TestFolder folder;
  const auto world = folder.Write("worlds/w.sdf", "");
  const auto sibling = folder.Write("models/chair/model.sdf", "");
  const auto inner = folder.Write("worlds/desk/model.sdf", "");
  const ResourceFinder finder;
  EXPECT_EQ(finder.Find("model://chair/model.sdf", world).value(), sibling);
  EXPECT_EQ(finder.Find("package://chair/model.sdf", world).value(), sibling);
  EXPECT_EQ(finder.Find("model://desk/model.sdf", world).value(), inner);
  EXPECT_EQ(finder.Find("model:///desk/model.sdf", world).value(), inner);
  EXPECT_EQ(finder.Find("desk/model.sdf", world).value(), inner);
  EXPECT_EQ(finder.Find("file://desk/model.sdf", world).value(), inner);
}

TEST(ResourceFinder, SearchesTheGivenPathAfterTheFoldersAroundTheFile) {
  const base::testing::TestFolder here, library;
  const auto world = here.Write("w.sdf", "");
  library.Write("chair/model.sdf", "");
  const auto lamp = library.Write("lamp/model.sdf", "");
  const auto nearer = here.Write("chair/model.sdf", "");
  const ResourceFinder finder({library.path()});
  EXPECT_EQ(finder.Find("model://chair/model.sdf", world).value(), nearer);
  EXPECT_EQ(finder.Find("model://lamp/model.sdf", world).value(), lamp);
}

TEST(ResourceFinder, AcceptsBackslashesAndNamesThatDifferInCase) {
  const base::testing::TestFolder folder;
  const auto model = folder.Write("m/model.sdf", "");
  const auto mesh = folder.Write("m/Meshes/Wheel.STL", "");
  const ResourceFinder finder;
  EXPECT_EQ(finder.Find("meshes\\wheel.stl", model).value(), mesh);
}

TEST(ResourceFinder, RefusesNamesThatLeaveTheFolder) {
  const base::testing::TestFolder folder;
  folder.Write("secret.txt", "");
  folder.Write("a/other/mesh.stl", "");
  const auto model = folder.Write("a/b/model.sdf", "");
  const ResourceFinder finder;
  EXPECT_TRUE(finder.Find("../other/mesh.stl", model).has_value());  // a sibling model
  for (const char* name :
       {"../../secret.txt", "model://../secret.txt", "model://b/../../../secret.txt"}) {
    const auto found = finder.Find(name, model);
    ASSERT_FALSE(found.has_value()) << name;
    EXPECT_THAT(found.error().message, HasSubstr("is outside the model folders"));
  }
}

TEST(ResourceFinder, RefusesAbsolutePathsWhereTheyAreNotAllowed) {
  const base::testing::TestFolder folder;
  const auto mesh = folder.Write("mesh.stl", "");
  EXPECT_EQ(ResourceFinder().Find("file://" + mesh.string()).value(), mesh);
  EXPECT_FALSE(ResourceFinder({}, false).Find("file://" + mesh.string()).has_value());
}

TEST(ResourceFinder, ReportsThatModelsOnTheWebAreNotSearched) {
  const auto found = ResourceFinder().Find("https://fuel.gazebosim.org/1.0/x/models/Cone");
  ASSERT_FALSE(found.has_value());
  EXPECT_THAT(found.error().message, HasSubstr("on the web"));
}

TEST(ResourceFinder, ListsTheFoldersThatContainAModelOfAnyFormat) {
  const base::testing::TestFolder library;
  library.Write("chair/model-1_4.sdf", "");
  library.Write("arm/arm.urdf", "");
  library.Write("rover/rover.urdf.xacro", "");
  library.Write("meshes/wheel.stl", "");
  library.Write("README.sdf", "");
  const auto names = ResourceFinder({library.path()}).ModelNames();
  ASSERT_GE(names.size(), 3u);
  EXPECT_THAT(std::vector(names.begin(), names.begin() + 3),
              testing::ElementsAre("arm", "chair", "rover"));
  EXPECT_THAT(names, testing::Not(testing::Contains("meshes")));
}

TEST(ModelFileIn, SelectsTheNewestReadableVersion) {
  const base::testing::TestFolder folder;
  for (const char* version : {"1.2", "1.4", "1.9", "1.11"}) {
    folder.Write(std::string(version) + ".sdf", Empty(version));
  }
  folder.Write("model.config",
               "<model><sdf version='1.2'>1.2.sdf</sdf><sdf version='1.11'>1.11.sdf</sdf>"
               "<sdf version='1.9'>1.9.sdf</sdf><sdf version='1.4'>1.4.sdf</sdf>"
               "<sdf version='1.8'>absent.sdf</sdf></model>");
  EXPECT_EQ(ModelFileIn(folder.path()).value().filename(), "1.9.sdf");
}

TEST(ModelFileIn, ReportsAFolderWithoutAModel) {
  const base::testing::TestFolder folder;
  const auto file = ModelFileIn(folder.path());
  ASSERT_FALSE(file.has_value());
  EXPECT_EQ(file.error().code, base::ErrorCode::kBadModel);
  EXPECT_EQ(file.error().where, folder.path().string());
}

}  // namespace
}  // namespace gsv::formats
