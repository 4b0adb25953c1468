#include "gsv/formats/support/naming_rules.h"

#include <gmock/gmock.h>

namespace gsv::formats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

std::vector<std::string> ErrorsOf(const std::string& content) {
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(("<sdf version='1.9'>" + content + "</sdf>").c_str()),
            tinyxml2::XML_SUCCESS);
  base::Problems problems;
  CheckNamingRules({"f.sdf", document.RootElement(), 9}, problems);
  std::vector<std::string> sentences;
  for (const base::Problem& problem : problems) {
    EXPECT_EQ(problem.severity, base::Problem::Severity::kError);
    sentences.push_back(problem.Sentence());
  }
  return sentences;
}

std::vector<std::string> ErrorsOfModel(const std::string& content) {
  return ErrorsOf("<model name='m'><link name='a'/><link name='b'/>" + content + "</model>");
}

std::string JointOf(const std::string& parent, const std::string& child) {
  return "<joint name='j' type='fixed'><parent>" + parent + "</parent><child>" + child +
         "</child></joint>";
}

TEST(NamingRules, RequireDifferentNamesOfSiblings) {
  EXPECT_THAT(
      ErrorsOfModel("<link name='a'/>"),
      ElementsAre(HasSubstr("f.sdf:1: model[m]/link[a]: the name \"a\" is that of a <link>")));
  EXPECT_THAT(ErrorsOfModel("<frame name='a'/>"), SizeIs(1));
  EXPECT_THAT(ErrorsOfModel("<model name='n'><link name='a'/></model>"), IsEmpty());
  EXPECT_THAT(ErrorsOfModel("<link/>"), ElementsAre(HasSubstr("needs a name")));
  EXPECT_THAT(ErrorsOfModel("<link name='__l__'/>"), ElementsAre(HasSubstr("is reserved")));
  EXPECT_THAT(ErrorsOf("<world name='w'><light name='x'/><model name='x'><link name='l'/></model>"
                       "</world>"),
              SizeIs(1));
  EXPECT_THAT(ErrorsOf("<world name='w'/><world name='w'/>"), SizeIs(1));
  EXPECT_THAT(ErrorsOf("<model name='m'/>"), ElementsAre(HasSubstr("needs a link")));
}

TEST(NamingRules, AllowPartsOfDifferentKindsOrLinksToShareAName) {
  const std::string parts = "<collision name='c'/><visual name='c'/><sensor name='c'/>";
  EXPECT_THAT(ErrorsOf("<model name='m'><link name='a'>" + parts + "</link><link name='b'>" +
                       parts + "</link></model>"),
              IsEmpty());
  EXPECT_THAT(ErrorsOf("<model name='m'><link name='a'>" + parts +
                       "<visual name='c'/></link>"
                       "</model>"),
              ElementsAre(HasSubstr("a second <visual> \"c\"")));
}

TEST(NamingRules, RequireJointsOfTwoLinks) {
  EXPECT_THAT(ErrorsOfModel(JointOf("a", "b")), IsEmpty());
  EXPECT_THAT(ErrorsOfModel(JointOf("world", "b")), IsEmpty());
  EXPECT_THAT(ErrorsOfModel(JointOf("a", "c")), ElementsAre(HasSubstr("child names \"c\"")));
  EXPECT_THAT(ErrorsOfModel(JointOf("a", "world")), ElementsAre(HasSubstr("cannot be the world")));
  EXPECT_THAT(ErrorsOfModel(JointOf("a", "a")), ElementsAre(HasSubstr("to itself")));
  EXPECT_THAT(ErrorsOfModel("<frame name='f' attached_to='b'/>" + JointOf("f", "b")),
              ElementsAre(HasSubstr("the same link, \"b\"")));
}

TEST(NamingRules, RequireExistingReferencesWithoutCycles) {
  EXPECT_THAT(ErrorsOfModel("<frame name='f' attached_to='a'/><frame name='g' attached_to='f'/>"),
              IsEmpty());
  EXPECT_THAT(ErrorsOfModel("<frame name='f' attached_to='nowhere'/>"),
              ElementsAre(HasSubstr("attached_to names \"nowhere\"")));
  EXPECT_THAT(ErrorsOfModel("<frame name='f' attached_to='g'/><frame name='g' attached_to='f'/>"),
              SizeIs(2));
  EXPECT_THAT(ErrorsOfModel("<link name='c'><pose relative_to='c'/></link>"), SizeIs(1));
  EXPECT_THAT(ErrorsOf("<model name='m' canonical_link='x'><link name='a'/></model>"),
              ElementsAre(HasSubstr("canonical_link names \"x\"")));
}

TEST(NamingRules, AssumeThatIncludesDefineNames) {
  EXPECT_THAT(ErrorsOfModel("<include><uri>x</uri></include>" + JointOf("x::l", "b")), IsEmpty());
  EXPECT_THAT(ErrorsOfModel("<include><name>n</name><uri>x</uri></include>" + JointOf("n::l", "b")),
              IsEmpty());
  EXPECT_THAT(ErrorsOfModel("<include><name>n</name><uri>x</uri></include>" + JointOf("o::l", "b")),
              SizeIs(1));
}

}  // namespace
}  // namespace gsv::formats
