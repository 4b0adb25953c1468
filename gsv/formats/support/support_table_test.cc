#include "gsv/formats/support/support_table.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <tinyxml2.h>

#include "gsv/formats/support/same_text.h"

namespace gsv::formats {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

TEST(SupportTable, DependsOnTheParentOfAnElement) {
  const ElementSupport* model = SupportTable::Get().sdf().Child("world")->Child("model");
  ASSERT_NE(model, nullptr);
  const ElementSupport* friction =
      model->Child("model")->Child("link")->Child("collision")->Child("surface")->Child("friction");
  ASSERT_NE(friction, nullptr);
  EXPECT_EQ(friction->Child("ode")->Child("mu")->support, Support::kFull);
  EXPECT_EQ(friction->Child("mu"), nullptr);
  EXPECT_NE(model->Child("pose")->Attribute("relative_to"), nullptr);
  EXPECT_EQ(model->Attribute("relative_to"), nullptr);
}

TEST(SupportTable, KnowsVersionsDefaultsAndRepeatableElements) {
  const ElementSupport& joint = SupportTable::Get().Definition("joint");
  const ElementSupport* axis = joint.Child("axis");
  EXPECT_EQ(axis->Child("use_parent_model_frame")->until, 6);
  EXPECT_EQ(axis->Child("limit")->until, 0);
  EXPECT_EQ(axis->Child("mimic")->since, 11);
  EXPECT_FALSE(axis->is_repeatable);
  EXPECT_TRUE(joint.Child("sensor")->is_repeatable);
  EXPECT_EQ(axis->Child("limit")->Child("stiffness")->otherwise, "1e8");
}

TEST(SupportTable, KnowsPluginsByFileOrClass) {
  const SupportTable& table = SupportTable::Get();
  EXPECT_EQ(table.Plugin("gz-sim-diff-drive-system", "gz::sim::systems::DiffDrive")->support,
            Support::kFull);
  EXPECT_EQ(table.Plugin("", "ignition::gazebo::systems::DiffDrive")->support, Support::kFull);
  EXPECT_EQ(table.Plugin("libignition-gazebo-imu-system.so", "")->support, Support::kNoEffect);
  EXPECT_EQ(table.Plugin("libmine.so", "mine"), nullptr);
}

// Reads the description files of libsdformat. Each element and attribute of each version must be in
// the table, and each default in the table must equal the default in the description.
class InstalledSchemaTest : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    folder_ = "/usr/share/sdformat12/1." + std::to_string(GetParam());
    if (!fs::is_directory(folder_)) GTEST_SKIP() << "there is no " << folder_;
  }

  void Compare(const XMLElement& described, const ElementSupport& support,
               const std::string& path) {
    for (auto* attribute = described.FirstChildElement("attribute"); attribute != nullptr;
         attribute = attribute->NextSiblingElement("attribute")) {
      const std::string name = attribute->Attribute("name");
      CompareOne(*attribute, support.Attribute(name), path + "/@" + name);
    }
    for (auto* child = described.FirstChildElement("element"); child != nullptr;
         child = child->NextSiblingElement("element")) {
      if (child->Attribute("copy_data") != nullptr) continue;
      const std::string name = child->Attribute("name");
      const ElementSupport* known = support.Child(name);
      CompareOne(*child, known, path + "/" + name);
      if (known != nullptr) Compare(*child, *known, path + "/" + name);
    }
    for (auto* include = described.FirstChildElement("include"); include != nullptr;
         include = include->NextSiblingElement("include")) {
      tinyxml2::XMLDocument part;
      const fs::path file = folder_ / include->Attribute("filename");
      // The schemas include some files that libsdformat does not install.
      if (part.LoadFile(file.c_str()) != tinyxml2::XML_SUCCESS) continue;
      const std::string name = part.RootElement()->Attribute("name");
      CompareOne(*part.RootElement(), support.Child(name), path + "/" + name);
    }
  }

  void CompareOne(const XMLElement& described, const ElementSupport* known,
                  const std::string& path) {
    ASSERT_NE(known, nullptr) << "no table has " << path;
    ++compared_;
    EXPECT_LE(known->since, GetParam()) << path;
    EXPECT_TRUE(known->until == 0 || known->until >= GetParam()) << path;
    const char* otherwise = described.Attribute("default");
    // GSV's spot lights fall off linearly, so GSV's default is 1, unlike SDFormat's.
    if (path == "light/spot/falloff") return;
    if (GetParam() == 9 && known->otherwise && otherwise != nullptr) {
      EXPECT_TRUE(HasSameMeaning(*known->otherwise, otherwise)) << path << ": " << otherwise;
    }
  }

  fs::path folder_;
  int compared_ = 0;
};

TEST_P(InstalledSchemaTest, HasEveryElementInTheTable) {
  for (const auto& entry : fs::directory_iterator(folder_)) {
    if (entry.path().extension() != ".sdf") continue;
    tinyxml2::XMLDocument described;
    ASSERT_EQ(described.LoadFile(entry.path().c_str()), tinyxml2::XML_SUCCESS) << entry.path();
    const std::string name = entry.path().stem();
    if (described.RootElement()->FirstChildElement("element") == nullptr &&
        described.RootElement()->FirstChildElement("attribute") == nullptr) {
      continue;  // the description of this element does not list its content
    }
    Compare(*described.RootElement(), SupportTable::Get().Definition(name), name);
  }
  EXPECT_GT(compared_, 400);
}

INSTANTIATE_TEST_SUITE_P(Versions, InstalledSchemaTest, testing::Values(4, 5, 6, 7, 8, 9));

}  // namespace
}  // namespace gsv::formats
