// What is wrong with a file is said in a sentence that names the place.
#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/sdf_reader.h"

namespace gsv::formats {
namespace {

using base::ErrorCode;
using testing::Contains;
using testing::HasSubstr;

class BadInputTest : public testing::Test {
 protected:
  base::Error ErrorOf(const std::string& text) {
    const auto world = ModelLibrary(options_).ReadWorld(folder_.Write("w.sdf", text), problems_);
    EXPECT_FALSE(world.has_value()) << text;
    if (world) return {};
    EXPECT_EQ(world.error().code, ErrorCode::kBadModel);
    return world.error();
  }
  // The errors, not warnings, of a model that is read none the less.
  std::vector<std::string> ErrorsIn(const std::string& model_content) {
    problems_.clear();
    const auto model =
        ModelLibrary().ReadModel(folder_
                                     .Write("m.sdf", "<sdf version='1.9'>\n<model name='m'>\n" +
                                                         model_content + "</model></sdf>")
                                     .string(),
                                 problems_);
    EXPECT_TRUE(model.has_value()) << model.error().Sentence();
    std::vector<std::string> errors;
    for (const auto& problem : problems_) {
      if (problem.severity == base::Problem::Severity::kError) errors.push_back(problem.Sentence());
    }
    return errors;
  }

  base::testing::TestFolder folder_;
  ReadOptions options_;
  base::Problems problems_;
};

TEST_F(BadInputTest, RefusesFilesThatAreNoWorlds) {
  EXPECT_THAT(
      ModelLibrary().ReadWorld(folder_.path() / "absent.world", problems_).error().Sentence(),
      HasSubstr("absent.world: there is no such file"));
  EXPECT_THAT(ErrorOf("").Sentence(), HasSubstr("w.sdf"));
  EXPECT_THAT(ErrorOf("<sdf version='1.9'>\n<world name='w'>\n<model>").Sentence(),
              HasSubstr("w.sdf:3: the XML is malformed"));
  EXPECT_THAT(ErrorOf("<html/>").Sentence(), HasSubstr("found <html>"));
  EXPECT_THAT(ErrorOf("<sdf version='1.9'/>").Sentence(), HasSubstr("no model inside"));
  EXPECT_THAT(ErrorOf("<sdf><world name='w'/></sdf>").Sentence(), HasSubstr("needs a version"));
  EXPECT_THAT(ErrorOf("<sdf version='1.2'><world name='w'/></sdf>").Sentence(),
              HasSubstr("too old"));
  EXPECT_THAT(ErrorOf("<gazebo version='1.2'/>").Sentence(), HasSubstr("too old"));
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

TEST_F(BadInputTest, RefusesIncludesThatGoRound) {
  const auto including = [](const std::string& other) {
    return "<sdf version='1.9'><model name='m'><link name='l'/><include><uri>model://" + other +
           "</uri></include></model></sdf>";
  };
  folder_.Write("a/model.sdf", including("b"));
  folder_.Write("b/model.sdf", including("a"));
  EXPECT_THAT(ErrorOf("<sdf version='1.9'><world "
                      "name='w'><include><uri>model://a</uri></include></world></sdf>")
                  .Sentence(),
              HasSubstr("the includes go round"));
  EXPECT_THAT(ErrorOf(including("a")).Sentence(), HasSubstr("the includes go round"));
}

TEST_F(BadInputTest, RefusesValuesThatAreNoNumbersWithTheirLine) {
  EXPECT_THAT(ErrorOf("<sdf version='1.9'>\n<world name='w'>\n<model name='m'>\n<link name='l'>\n"
                      "<inertial>\n<mass>heavy</mass></inertial></link></model></world></sdf>")
                  .Sentence(),
              HasSubstr("w.sdf:6: /sdf/world[@name=\"w\"]/model[@name=\"m\"]"));
}

TEST_F(BadInputTest, ComplainsOfMassesAndInertiasThatNoBodyHas) {
  EXPECT_THAT(ErrorsIn("<link name='l'>\n<inertial><mass>-1</mass></inertial></link>"),
              Contains(AllOf(HasSubstr("m.sdf:4"), HasSubstr("mass must be above zero"))));
  EXPECT_THAT(ErrorsIn("<link "
                       "name='l'><inertial><mass>1</mass><inertia><ixx>1</ixx><iyy>-1</iyy><izz>1</"
                       "izz></inertia></inertial></link>"),
              Contains(HasSubstr("not positive definite")));
}

TEST_F(BadInputTest, ComplainsOfJointsThatCannotBe) {
  const auto joint = [](const std::string& content) {
    return "<link name='a'/><link name='b'/>\n<joint name='j' "
           "type='revolute'><parent>a</parent><child>b</child><axis>" +
           content + "</axis></joint>";
  };
  EXPECT_FALSE(ErrorsIn(joint("<xyz>0 0 0</xyz>")).empty());
  EXPECT_THAT(ErrorsIn(joint("<xyz>0 0 1</xyz><limit><lower>1</lower><upper>-1</upper></limit>")),
              Contains(AllOf(HasSubstr("m.sdf:4"), HasSubstr("above its <upper>"))));
  EXPECT_FALSE(ErrorsIn("<link name='a'/><joint name='j' "
                        "type='fixed'><parent>a</parent><child>nowhere</child></joint>")
                   .empty());
}

TEST_F(BadInputTest, ComplainsOfShapesWithoutSize) {
  for (const char* shape :
       {"<box><size>1 0 1</size></box>", "<sphere><radius>-1</radius></sphere>",
        "<cylinder><radius>0</radius><length>1</length></cylinder>",
        "<polyline><point>0 0</point><point>1 1</point><height>1</height></polyline>"}) {
    EXPECT_THAT(ErrorsIn("<link name='l'><collision name='c'><geometry>" + std::string(shape) +
                         "</geometry></collision></link>"),
                Contains(HasSubstr("the collision is left out")))
        << shape;
  }
}

TEST_F(BadInputTest, SaysThatAWorldIsNoRobot) {
  const auto file = folder_.Write("w.sdf", "<sdf version='1.9'><world name='w'/></sdf>");
  EXPECT_THAT(ModelLibrary().ReadModel(file.string(), problems_).error().Sentence(),
              HasSubstr("holds a world"));
}

}  // namespace
}  // namespace gsv::formats
