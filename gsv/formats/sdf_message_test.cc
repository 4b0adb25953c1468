// Tests the warnings about bad values of joints, controllers, gearboxes and the slip of wheels: one
// warning for each bad value, with its file, line and element.
#include <gmock/gmock.h>

#include "gsv/formats/testing/sdf_reader_fixture.h"

namespace gsv::formats {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Flaw {
  std::string content;  // from line 7 of the file
  std::vector<std::string> parts;
};

// A model with the links a, b and c, and the revolute joint j between a and b.
std::string WithFlaw(const std::string& flaw) {
  return "<model name='m'><link name='a'/><link name='b'/><link name='c'/>\n"
         "<joint name='j' type='revolute'><parent>a</parent><child>b</child>\n"
         "<axis><xyz>0 1 0</xyz></axis></joint>\n\n" +
         flaw + "\n</model>";
}

std::string WheelSlip(const std::string& wheels) {
  return "<plugin filename='gz-sim-wheel-slip-system' name='gz::sim::systems::WheelSlip'>\n" +
         wheels + "</plugin>";
}

std::string Controller(const std::string& content) {
  return "<plugin filename='gz-sim-joint-position-controller-system' name='c'>\n" + content +
         "</plugin>";
}

std::string Classic(const std::string& content) {
  return "<plugin filename='libJointControlPlugin.so' name='c'>\n<controller type='position'>" +
         content + "</controller></plugin>";
}

class SdfMessages : public SdfReaderTest, public testing::WithParamInterface<Flaw> {};

TEST_P(SdfMessages, StateFileLineAndElementOnce) {
  (void)Model(WithFlaw(GetParam().content));
  const auto sentences = Sentences();
  ASSERT_EQ(sentences.size(), 1u) << testing::PrintToString(sentences);
  for (const std::string& part : GetParam().parts) EXPECT_THAT(sentences[0], HasSubstr(part));
}

const std::string kDrive =
    "<plugin filename='gz-sim-velocity-control-system' name='gz::sim::systems::VelocityControl'/>";

INSTANTIATE_TEST_SUITE_P(
    OfSlip, SdfMessages,
    testing::Values(
        Flaw{kDrive + "\n<gsv:slip>0.3</gsv:slip>",
             {"m.sdf:8: ", "/gsv:slip: ", "must contain <gsv:longitudinal>", "not \"0.3\""}},
        Flaw{kDrive + "<gsv:slip/>", {"m.sdf:7: ", "/gsv:slip: ", "must contain"}},
        Flaw{kDrive + "<gsv:slip>\n<lateral>1</lateral></gsv:slip>",
             {"m.sdf:8: ", "/gsv:slip/lateral: ", "Did you mean <gsv:lateral>?"}},
        Flaw{kDrive + "<gsv:slip>\n<gsv:lateral>soft</gsv:lateral></gsv:slip>",
             {"m.sdf:8: ", "/gsv:slip/gsv:lateral: ", "at least 0, not \"soft\""}},
        Flaw{"<gsv:slip><gsv:lateral>1</gsv:lateral></gsv:slip>", {"m.sdf:3: ", "no drive"}},
        Flaw{"<link name='d'>\n<gsv:slip><gsv:lateral>1</gsv:lateral></gsv:slip></link>",
             {"m.sdf:8: ", "link[d]/gsv:slip", "in <link> is ignored"}},
        Flaw{WheelSlip(""),
             {"m.sdf:7: ", "/plugin[@name=\"gz::sim::systems::WheelSlip\"]: ", "no wheel slips"}},
        Flaw{WheelSlip("<wheel><wheel_normal_force>9</wheel_normal_force></wheel>"),
             {"m.sdf:8: ", "/wheel: ", "no link_name"}},
        Flaw{WheelSlip("\n<wheel link_name='wheel_7'/>"), {"m.sdf:9: ", "\"wheel_7\""}},
        Flaw{WheelSlip("<wheel link_name='b'><wheel_radius>1</wheel_radius>\n"
                       "<wheel_normal_force>-9</wheel_normal_force></wheel>"),
             {"m.sdf:9: ", "/wheel/wheel_normal_force: ", "not \"-9\""}},
        Flaw{WheelSlip("<wheel link_name='b'><wheel_radius>1</wheel_radius></wheel>"),
             {"m.sdf:8: ", "needs a <wheel_normal_force> above 0"}}));

INSTANTIATE_TEST_SUITE_P(
    OfControllers, SdfMessages,
    testing::Values(Flaw{Controller("<joint_name>jj</joint_name>"),
                         {"m.sdf:8: ", "/joint_name: ", "which the model does not have"}},
                    Flaw{Controller("<joint_name>j</joint_name>\n<p_gain>high</p_gain>"),
                         {"m.sdf:9: ", "/p_gain: ", "must be a number, not \"high\""}},
                    Flaw{Controller("<joint_name>j</joint_name><joint_index>2</joint_index>"),
                         {"m.sdf:8: ", "\"j::axis3\"", "which the model does not have"}},
                    Flaw{Controller("<joint_name>j</joint_name>") + "\n" +
                             Controller("<joint_name>j</joint_name>"),
                         {"m.sdf:10: ", "\"j\" has several controllers", "the last one is used"}},
                    Flaw{Classic("<joint>x</joint>"), {"m.sdf:8: ", "/controller: ", "\"x\""}},
                    Flaw{Classic("<joint>j</joint>\n<target>far</target>"),
                         {"m.sdf:9: ", "/controller/target: ", "not \"far\""}},
                    Flaw{"<plugin filename='libJointControlPlugin.so' name='c'>\n"
                         "<controller type='positn'><joint>j</joint></controller></plugin>",
                         {"m.sdf:8: ", "not \"positn\"; position is used"}}));

INSTANTIATE_TEST_SUITE_P(
    OfJoints, SdfMessages,
    testing::Values(
        Flaw{"<joint name='k' type='ball'><parent>b</parent><child>a</child></joint>",
             {"m.sdf:7: ", "joint[@name=\"k\"]: ", "the joint \"k\" closes a loop"}},
        Flaw{"<joint name='k' type='revolute'><parent>b</parent><child>a</child><axis><xyz>0 1 0"
             "</xyz><limit><lower>0</lower><upper>1</upper></limit></axis></joint>",
             {"m.sdf:7: ", "\"k\" closes a loop; its limits"}},
        Flaw{"<joint name='k' type='revolute'><parent>b</parent><child>a</child><axis><xyz>0 1 0"
             "</xyz></axis></joint>\n" +
                 Controller("<joint_name>k</joint_name>"),
             {"m.sdf:9: ", "closes a loop and takes no commands; name another joint"}},
        Flaw{"<joint name='k' type='gearbox'><parent>a</parent><child>b</child><gearbox_ratio>2"
             "</gearbox_ratio><gearbox_reference_body>q</gearbox_reference_body><axis><xyz>0 1 0"
             "</xyz></axis><axis2><xyz>0 1 0</xyz></axis2></joint>",
             {"m.sdf:7: ", "<gearbox_reference_body> \"q\", which is not a link"}},
        Flaw{"<joint name='k' type='revolute'><parent>a</parent><child>c</child><axis><xyz>0 1 0"
             "</xyz></axis>\n<sensor name='ft' type='force_torque'/></joint>"
             "<joint name='l' type='revolute'><parent>c</parent><child>b</child><axis><xyz>0 1 0"
             "</xyz></axis></joint>",
             {"m.sdf:8: ", "\"ft\" is on a joint of a closed loop", "the force of \"l\""}},
        Flaw{"<link name='d'><inertial auto='maybe'/></link>",
             {"m.sdf:7", "@auto of <inertial> must be true or false, not \"maybe\""}}));

TEST_F(SdfReaderTest, AControllerNamesTheSecondAxisOfAJointByItsIndex) {
  const auto model = Model(WithFlaw(
      "<joint name='u' type='universal'><parent>b</parent><child>c</child><axis><xyz>1 0 0</xyz>"
      "</axis><axis2><xyz>0 1 0</xyz></axis2></joint>" +
      Controller("<joint_name>u</joint_name><joint_index>1</joint_index>")));
  EXPECT_THAT(Sentences(), testing::IsEmpty());
  ASSERT_EQ(model->joint_targets.size(), 1u);
  EXPECT_EQ(model->joints[static_cast<std::size_t>(model->joint_targets[0].joint)].name,
            "u::axis2");
}

}  // namespace
}  // namespace gsv::formats
