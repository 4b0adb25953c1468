// Tests that the reader reports each error in a file, with a sentence and its place.
#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/sdf_reader.h"

namespace gsv::formats {
namespace {

using base::ErrorCode;
using testing::AllOf;
using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

class BadInputTest : public testing::Test {
 protected:
  base::Error ErrorOf(const std::string& text) {
    const auto world = ModelLibrary(options_).ReadWorld(folder_.Write("w.sdf", text), problems_);
    EXPECT_FALSE(world.has_value()) << text;
    if (world) return {};
    EXPECT_EQ(world.error().code, ErrorCode::kBadModel);
    return world.error();
  }
  // Reads a model, which must have no errors, and returns the warnings.
  std::vector<std::string> WarningsIn(const std::string& model_content) {
    problems_.clear();
    const auto model =
        ModelLibrary().ReadModel(folder_
                                     .Write("m.sdf", "<sdf version='1.9'>\n<model name='m'>\n" +
                                                         model_content + "</model></sdf>")
                                     .string(),
                                 problems_);
    EXPECT_TRUE(model.has_value()) << model.error().Sentence();
    std::vector<std::string> warnings;
    for (const auto& problem : problems_) {
      EXPECT_EQ(problem.severity, base::Problem::Severity::kWarning) << problem.Sentence();
      warnings.push_back(problem.Sentence());
    }
    return warnings;
  }

  base::testing::TestFolder folder_;
  ReadOptions options_;
  base::Problems problems_;
};

TEST_F(BadInputTest, RefusesFilesThatAreNotWorlds) {
  EXPECT_THAT(
      ModelLibrary().ReadWorld(folder_.path() / "absent.world", problems_).error().Sentence(),
      HasSubstr("absent.world: there is no such file"));
  EXPECT_THAT(ErrorOf("").Sentence(), HasSubstr("w.sdf"));
  EXPECT_THAT(ErrorOf("<sdf version='1.9'>\n<world name='w'>\n<model>").Sentence(),
              HasSubstr("w.sdf:3:1: the XML is malformed: <model> is not closed. Add </model>"));
  EXPECT_THAT(ErrorOf("<html/>").Sentence(), HasSubstr("found <html>"));
  EXPECT_THAT(ErrorOf("<sdf version='1.9'/>").Sentence(), HasSubstr("contains no"));
  EXPECT_THAT(ErrorOf("<sdf><world name='w'/></sdf>").Sentence(), HasSubstr("needs a version"));
  EXPECT_THAT(ErrorOf("<sdf version='1.2'><world name='w'/></sdf>").Sentence(),
              HasSubstr("not supported"));
  EXPECT_THAT(ErrorOf("<gazebo version='1.2'/>").Sentence(), HasSubstr("not supported"));
  EXPECT_THAT(ErrorOf(std::string("\0\1\2\3", 4)).Sentence(), HasSubstr("w.sdf"));
}

TEST_F(BadInputTest, RefusesFilesBeyondTheLimits) {
  std::string deep = "<sdf version='1.9'><world name='w'>";
  for (int i = 0; i < 80; ++i) deep += "<model name='m'>";
  for (int i = 0; i < 80; ++i) deep += "</model>";
  EXPECT_THAT(ErrorOf(deep + "</world></sdf>").Sentence(), HasSubstr("deeper than 64"));
  options_.limits.xml_bytes = 20;
  EXPECT_THAT(ErrorOf("<sdf version='1.9'><world name='w'/></sdf>").Sentence(),
              HasSubstr("limit of 20 bytes"));
  options_.limits = {};
  options_.limits.models_in_world = 1;
  EXPECT_THAT(ErrorOf("<sdf version='1.9'><world name='w'><model name='a'><link name='l'/></model>"
                      "<model name='b'><link name='l'/></model></world></sdf>")
                  .Sentence(),
              HasSubstr("limit of 1 models"));
}

TEST_F(BadInputTest, SkipsTheIncludeThatClosesACycle) {
  const auto including = [](const std::string& other) {
    return "<sdf version='1.9'><model name='m'><link name='l'/><include><uri>model://" + other +
           "</uri></include></model></sdf>";
  };
  folder_.Write("a/model.sdf", including("b"));
  folder_.Write("b/model.sdf", including("a"));
  const auto world = ModelLibrary().ReadWorld(
      folder_.Write("w.sdf",
                    "<sdf version='1.9'><world "
                    "name='w'><include><uri>model://a</uri></include></world></sdf>"),
      problems_);
  ASSERT_TRUE(world.has_value()) << world.error().Sentence();
  ASSERT_EQ(world->models.size(), 1u);
  EXPECT_EQ(world->models[0].model->links.size(), 2u);
  ASSERT_EQ(problems_.size(), 1u);
  EXPECT_THAT(problems_[0].Sentence(),
              AllOf(HasSubstr("b/model.sdf:1"), HasSubstr("the includes form a cycle: "),
                    HasSubstr("a/model.sdf → "), HasSubstr("b/model.sdf → ")));
}

// These models have no links of their own. Without the include, which is left out, they are empty.
TEST_F(BadInputTest, NamesTheCycleOfModelsThatContainOnlyEachOther) {
  const auto including = [](const std::string& other) {
    return "<sdf version='1.9'><model name='m'><include><uri>model://" + other +
           "</uri></include></model></sdf>";
  };
  folder_.Write("a/model.sdf", including("b"));
  folder_.Write("b/model.sdf", including("a"));
  const auto names_the_cycle =
      AllOf(HasSubstr("form a cycle: "), HasSubstr("a/model.sdf → "), HasSubstr("b/model.sdf → "));
  const auto world = ModelLibrary().ReadWorld(
      folder_.Write("w.sdf",
                    "<sdf version='1.9'><world "
                    "name='w'><include><uri>model://a</uri></include></world></sdf>"),
      problems_);
  ASSERT_TRUE(world.has_value()) << world.error().Sentence();
  ASSERT_GE(problems_.size(), 2u);
  EXPECT_THAT(problems_.front().Sentence(), names_the_cycle);
  EXPECT_THAT(problems_.back().Sentence(), HasSubstr("has no links"));
  for (const auto& problem : problems_) EXPECT_THAT(problem.Sentence(), Not(HasSubstr("Graph")));
  problems_.clear();
  EXPECT_FALSE(ModelLibrary().ReadModel((folder_.path() / "a/model.sdf").string(), problems_));
  ASSERT_FALSE(problems_.empty());
  EXPECT_THAT(problems_.front().Sentence(), names_the_cycle);
}

TEST_F(BadInputTest, ExpandsEntitiesInNamesAndValues) {
  const auto world = ModelLibrary().ReadWorld(
      folder_.Write("w.sdf",
                    "<!DOCTYPE sdf [<!ENTITY hall 'lobby'><!ENTITY x '1.5'>]>"
                    "<sdf version='1.9'><world name='&hall;'><model name='&hall;_box'>"
                    "<pose>&x; 0 0 0 0 0</pose><link name='l'/></model></world></sdf>"),
      problems_);
  ASSERT_TRUE(world.has_value()) << world.error().Sentence();
  EXPECT_TRUE(problems_.empty());
  EXPECT_EQ(world->name, "lobby");
  ASSERT_EQ(world->models.size(), 1u);
  EXPECT_EQ(world->models[0].name, "lobby_box");
  EXPECT_EQ(world->models[0].world_from_model.position.x, 1.5);
}

TEST_F(BadInputTest, ReportsAQuaternionOfLengthZero) {
  EXPECT_THAT(
      WarningsIn("<link name='l'><pose rotation_format='quat_xyzw'>1 2 3 0 0 0 0</pose></link>"),
      ElementsAre(
          HasSubstr("a rotation needs a quaternion of a length above 0; 1 2 3 0 0 0 1 is used")));
}

TEST_F(BadInputTest, ReportsAnExtensionOfAMissingPart) {
  const auto file = folder_.Write("r.urdf",
                                  "<robot name='r'><link name='base'/>\n"
                                  "<gazebo reference='base'><mu1>1</mu1></gazebo>\n"
                                  "<gazebo reference='bas'><mu1>1</mu1></gazebo></robot>");
  ASSERT_TRUE(ModelLibrary().ReadModel(file.string(), problems_));
  std::vector<std::string> sentences;
  for (const auto& problem : problems_) sentences.push_back(problem.Sentence());
  EXPECT_THAT(sentences,
              Contains(HasSubstr("r.urdf:3: <gazebo> is ignored: its @reference names \"bas\"")));
  EXPECT_THAT(sentences, Not(Contains(HasSubstr("\"base\""))));
}

TEST_F(BadInputTest, ReportsTextBesideElements) {
  EXPECT_THAT(WarningsIn("<link name='l'/> left over\n"),
              ElementsAre(HasSubstr("the text \"left over\" in <model> is ignored")));
}

TEST_F(BadInputTest, ReportsImpossibleMassesAndInertias) {
  EXPECT_THAT(WarningsIn("<link name='l'>\n<inertial><mass>-1</mass></inertial></link>"),
              Contains(AllOf(HasSubstr("m.sdf:4"), HasSubstr("mass must be above zero"))));
  EXPECT_THAT(
      WarningsIn("<link "
                 "name='l'><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>-1</iyy><izz>1</"
                 "izz></inertia></inertial></link>"),
      Contains(HasSubstr("not positive definite")));
}

TEST_F(BadInputTest, ReportsImpossibleJoints) {
  const auto joint = [](const std::string& content) {
    return "<link name='a'/><link name='b'/>\n<joint name='j' "
           "type='revolute'><parent>a</parent><child>b</child><axis>" +
           content + "</axis></joint>";
  };
  EXPECT_FALSE(WarningsIn(joint("<xyz>0 0 0</xyz>")).empty());
  EXPECT_THAT(WarningsIn(joint("<xyz>0 0 1</xyz><limit><lower>1</lower><upper>-1</upper></limit>")),
              Contains(AllOf(HasSubstr("m.sdf:4"), HasSubstr("above its <upper>"))));
  EXPECT_FALSE(WarningsIn("<link name='a'/><joint name='j' "
                          "type='fixed'><parent>a</parent><child>nowhere</child></joint>")
                   .empty());
}

TEST_F(BadInputTest, ReportsShapesWithoutSize) {
  for (const char* shape :
       {"<box><size>1 0 1</size></box>", "<sphere><radius>-1</radius></sphere>",
        "<cylinder><radius>0</radius><length>1</length></cylinder>",
        "<polyline><point>0 0</point><point>1 1</point><height>1</height></polyline>"}) {
    EXPECT_THAT(WarningsIn("<link name='l'><collision name='c'><geometry>" + std::string(shape) +
                           "</geometry></collision></link>"),
                Contains(HasSubstr("the collision is ignored")))
        << shape;
  }
}

TEST_F(BadInputTest, ReportsAWorldThatIsGivenAsARobot) {
  const auto file = folder_.Write("w.sdf", "<sdf version='1.9'><world name='w'/></sdf>");
  EXPECT_THAT(ModelLibrary().ReadModel(file.string(), problems_).error().Sentence(),
              HasSubstr("contains a world"));
}

}  // namespace
}  // namespace gsv::formats
