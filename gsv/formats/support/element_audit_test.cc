#include "gsv/formats/support/element_audit.h"

#include <gmock/gmock.h>

namespace gsv::formats {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::EndsWith;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;
using testing::StartsWith;

std::vector<std::string> AuditOf(const std::string& text, int minor_version = 9) {
  tinyxml2::XMLDocument document;
  EXPECT_EQ(document.Parse(text.c_str()), tinyxml2::XML_SUCCESS) << text;
  base::Problems problems;
  AuditElements({"f.sdf", document.RootElement(), minor_version}, problems);
  std::vector<std::string> sentences;
  for (const base::Problem& problem : problems) {
    EXPECT_EQ(problem.severity, base::Problem::Severity::kWarning);
    sentences.push_back(problem.Sentence());
  }
  return sentences;
}

std::vector<std::string> AuditOfLink(const std::string& content, int minor_version = 9) {
  return AuditOf("<sdf version='1.9'><world name='w'><model name='m'><link name='l'>" + content +
                     "</link></model></world></sdf>",
                 minor_version);
}

std::vector<std::string> AuditOfJoint(const std::string& content, int minor_version = 9) {
  return AuditOf("<sdf version='1.9'><model name='m'><joint name='j' type='revolute'>" + content +
                     "</joint></model></sdf>",
                 minor_version);
}

TEST(ElementAudit, ReportsUnknownElementsWithFileLineAndPath) {
  EXPECT_THAT(
      AuditOf("<sdf version='1.9'>\n<world name='w'>\n<model name='box'>\n<statik>1</statik>"
              "<link name='l'>\n<colision name='c'/></link></model></world></sdf>"),
      ElementsAre("f.sdf:4: world/model[box]/statik: <statik> is not an element of <model>; it "
                  "is ignored. Did you mean <static>?",
                  "f.sdf:5: world/model[box]/link[l]/colision[c]: <colision> is not an element of "
                  "<link>; it is ignored. Did you mean <collision>?"));
}

TEST(ElementAudit, ReportsWhereMisplacedElementsBelong) {
  EXPECT_THAT(AuditOfJoint("<parent>a</parent><limit><lower>0</lower></limit>"),
              ElementsAre(EndsWith("It belongs in <axis>.")));
  EXPECT_THAT(AuditOfLink("<collision name='c'><surface><friction><mu>1</mu></friction></surface>"
                          "</collision>"),
              ElementsAre(EndsWith("It belongs in <ode>.")));
  EXPECT_THAT(AuditOfLink("<visual name='v'><collision name='c'/></visual>"),
              ElementsAre(EndsWith("It belongs in <link>.")));
  EXPECT_THAT(AuditOf("<sdf version='1.9'><world name='w'/><model name='m'/></sdf>"),
              ElementsAre(HasSubstr("<model> beside a <world> is ignored")));
}

TEST(ElementAudit, ReportsUnknownAttributes) {
  EXPECT_THAT(AuditOf("<sdf version='1.9'><model name='m'><link nmae='l'/></model></sdf>"),
              ElementsAre(AllOf(HasSubstr("<link> has no attribute \"nmae\""),
                                EndsWith("Did you mean \"name\"?"))));
  EXPECT_THAT(AuditOf("<sdf version='1.9'><model name='m' static='1'/></sdf>"),
              ElementsAre(EndsWith("It is an element: <static>.")));
}

TEST(ElementAudit, ReportsDuplicateElementsAndElementsOfOlderVersions) {
  EXPECT_THAT(
      AuditOfLink("<pose>1 0 0 0 0 0</pose><pose>2 0 0 0 0 0</pose>"),
      ElementsAre(HasSubstr("a second <pose> in <link> is ignored; the first one is used")));
  EXPECT_THAT(AuditOfLink("<visual name='v'><geometry><box><size>1 1 1</size></box><sphere/>"
                          "</geometry></visual>"),
              ElementsAre(HasSubstr("a second shape in <geometry>, <sphere>")));
  const std::string axis = "<axis><use_parent_model_frame>1</use_parent_model_frame></axis>";
  EXPECT_THAT(AuditOfJoint(axis, 6), IsEmpty());
  EXPECT_THAT(AuditOfJoint(axis, 7), ElementsAre(HasSubstr("ended with SDFormat 1.6")));
}

TEST(ElementAudit, ReportsUnsupportedElementsUnlessTheyHaveTheDefault) {
  const auto contact = [](const std::string& content) {
    return AuditOfLink("<collision name='c'><surface><contact>" + content +
                       "</contact></surface></collision>");
  };
  EXPECT_THAT(contact("<ode><kp>1e5</kp><kd>1</kd></ode>"),
              ElementsAre(AllOf(StartsWith("f.sdf:1: world/model[m]/link[l]/collision[c]/surface/"
                                           "contact/ode: <ode> is not supported"))));
  EXPECT_THAT(contact("<ode><kp>1000000000000.0</kp><kd>1.0</kd></ode>"), IsEmpty());
  EXPECT_THAT(contact("<ode><kp>1e12</kp><stiffness>3</stiffness></ode>"), SizeIs(1));
  EXPECT_THAT(AuditOfLink("<light name='lamp' type='point'/>"), SizeIs(1));
  EXPECT_THAT(AuditOfLink("<self_collide>1</self_collide>"), SizeIs(1));
  EXPECT_THAT(AuditOfLink("<self_collide>false</self_collide>"), IsEmpty());
}

TEST(ElementAudit, IgnoresForeignElementsAndThoseWithoutEffect) {
  EXPECT_THAT(
      AuditOf("<sdf version='1.9' xmlns:gz='x'><world name='w'><gui><minimal/></gui>"
              "<gz:policies><mine/></gz:policies><model name='m' gz:mark='1'><link name='l'>"
              "<must_be_base_link>1</must_be_base_link></link>"
              "<plugin filename='gz-sim-diff-drive-system' name='d'><left_joint>l"
              "</left_joint><mine/></plugin></model></world></sdf>"),
      IsEmpty());
}

TEST(ElementAudit, IgnoresElementsOfOtherSensorTypes) {
  EXPECT_THAT(AuditOfLink("<sensor name='s' type='positioning'><noise/></sensor>"), IsEmpty());
  EXPECT_THAT(AuditOfLink("<sensor name='s' type='imu'><noise/></sensor>"), SizeIs(1));
}

TEST(ElementAudit, ReportsTextBesideElements) {
  EXPECT_THAT(AuditOf("<sdf version='1.9'>left<model name='m'><link name='l'/>over</model></sdf>"),
              ElementsAre(HasSubstr("the text \"left\" in <sdf> is ignored"),
                          HasSubstr("the text \"over\" in <model> is ignored")));
  EXPECT_THAT(AuditOf("<sdf version='1.9'><![CDATA[ how to ]]><model name='m'/></sdf>"), IsEmpty());
}

TEST(ElementAudit, ReportsParametersThatGsvDoesNotHave) {
  const auto sensor = [](const std::string& type, const std::string& content) {
    return AuditOfLink("<sensor name='s' type='" + type + "'>" + content + "</sensor>");
  };
  EXPECT_THAT(sensor("sonar", "<gsv:beam>cone</gsv:beam><gsv:smell>1</gsv:smell>"),
              ElementsAre(HasSubstr("<gsv:smell> is not a GSV element; it is ignored.")));
  EXPECT_THAT(sensor("sonar", "<gsv:noise><gsv:stdev>1</gsv:stdev></gsv:noise>"),
              ElementsAre(EndsWith("Did you mean <gsv:stddev>?")));
  EXPECT_THAT(
      sensor("odometry", "<scale><linear>1</linear></scale><smell>1</smell>"),
      ElementsAre(HasSubstr("<smell> is not a parameter of a sensor of the type odometry")));
  EXPECT_THAT(sensor("of_a_plugin", "<gsv:smell>1</gsv:smell><smell>1</smell>"), IsEmpty());
}

TEST(ElementAudit, ReportsUnsupportedPlugins) {
  const auto plugin = [](const std::string& text) {
    return AuditOf("<sdf version='1.9'><model name='m'>" + text + "</model></sdf>");
  };
  EXPECT_THAT(plugin("<plugin filename='libwings.so' name='wings'/>"),
              ElementsAre(HasSubstr("the plugin libwings.so is not supported")));
  EXPECT_THAT(plugin("<plugin filename='gz-sim-imu-system' name='gz::sim::systems::Imu'/>"),
              IsEmpty());
  EXPECT_THAT(plugin("<plugin filename='gz-sim-diff-drive-system' name='d'>"
                     "<wheel_seperation>1</wheel_seperation></plugin>"),
              ElementsAre(EndsWith("Did you mean <wheel_separation>?")));
  EXPECT_THAT(plugin("<gsv:movment>rigid</gsv:movment>"),
              ElementsAre(EndsWith("Did you mean <gsv:movement>?")));
}

TEST(ElementAudit, ComparesUrdfWithItsOwnElements) {
  EXPECT_THAT(AuditOf("<robot name='r'><link name='l'><inertial><mass value='1'/></inertial>"
                      "<visual><geometry><box size='1 1 1'/></geometry></visual></link>"
                      "<gazebo reference='l'><mu1>1</mu1><kinematic>0</kinematic></gazebo>"
                      "<gazebo><plugin filename='libgazebo_ros_diff_drive.so' name='d'/></gazebo>"
                      "<transmission name='t'><anything/></transmission></robot>",
                      0),
              IsEmpty());
  EXPECT_THAT(AuditOf("<robot name='r'><ros2_control name='c' type='system'><hardware><plugin>p/P"
                      "</plugin></hardware><joint name='j'><command_interface name='velocity'>"
                      "<param name='min'>-1</param></command_interface>"
                      "<state_interface name='position'/></joint></ros2_control></robot>",
                      0),
              IsEmpty());
  EXPECT_THAT(
      AuditOf("<robot name='r'><link name='l'><visual><geometry><box sise='1 1 1'/></geometry>"
              "</visual></link><joint name='j' type='revolute'><mimic joint='k'/><axs xyz='0 0 1'/>"
              "</joint><gazebo reference='l'><kp>5</kp><colour>red</colour></gazebo></robot>",
              0),
      ElementsAre(HasSubstr("<box> has no attribute \"sise\""),
                  HasSubstr("<axs> is not an element of <joint>"),
                  HasSubstr("robot[r]/gazebo[l]/kp: <kp> is not supported"),
                  HasSubstr("<colour> is not an element of <gazebo>")));
}

TEST(ElementAudit, CountsProblemsBeyondTheLimit) {
  std::string many;
  for (int i = 0; i < kMaxFindings + 7; ++i) many += "<wing/>";
  const auto sentences = AuditOfLink(many);
  ASSERT_THAT(sentences, SizeIs(kMaxFindings + 1));
  EXPECT_THAT(sentences.back(), HasSubstr("7 more elements are unknown or not supported"));
}

}  // namespace
}  // namespace gsv::formats
