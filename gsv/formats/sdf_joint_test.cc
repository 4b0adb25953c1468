// Tests joints, their controllers, and the parameters of surfaces and links for forces.
#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/sdf_reader.h"

namespace gsv::formats {
namespace {

using geometry::Vector3;
using model::JointKind;
using model::JointTarget;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

class SdfJointTest : public testing::Test {
 protected:
  std::shared_ptr<const model::Model> Read(const std::string& content) {
    const auto file =
        folder_.Write("m.sdf", "<sdf version='1.9'><model name='m'>" + content + "</model></sdf>");
    auto model = ModelLibrary().ReadModel(file.string(), problems_);
    EXPECT_TRUE(model.has_value()) << (model ? "" : model.error().Sentence());
    return model.value_or(std::make_shared<const model::Model>());
  }
  std::shared_ptr<const model::Model> ReadJoint(const std::string& type, const std::string& content,
                                                const std::string& more = "") {
    return Read(
        "<link name='a'/><link name='b'><pose>0 0 1 0 0 0</pose></link><joint name='j' type='" +
        type + "'><parent>a</parent><child>b</child>" + content + "</joint>" + more);
  }

  base::testing::TestFolder folder_;
  base::Problems problems_;
};

TEST_F(SdfJointTest, AUniversalJointBecomesTwoJointsWithACrossBetweenThem) {
  for (const char* type : {"universal", "revolute2"}) {
    const auto model =
        ReadJoint(type,
                  "<axis><xyz>1 0 0</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis>"
                  "<axis2><xyz>0 1 0</xyz><dynamics><damping>0.3</damping></dynamics></axis2>");
    ASSERT_THAT(model->joints, SizeIs(2));
    const model::Joint &first = model->joints[0], &second = model->joints[1];
    EXPECT_EQ(first.name, "j");
    EXPECT_EQ(first.kind, JointKind::kRevolute);
    EXPECT_EQ(first.axis, (Vector3{1, 0, 0}));
    EXPECT_EQ(first.position_limits.max, 1);
    EXPECT_EQ(second.name, "j::axis2");
    EXPECT_EQ(second.kind, JointKind::kContinuous);
    EXPECT_EQ(second.axis, (Vector3{0, 1, 0}));
    EXPECT_EQ(second.damping, 0.3);
    ASSERT_THAT(model->links, SizeIs(3));
    const model::Link& cross = model->links[static_cast<std::size_t>(first.child)];
    EXPECT_EQ(cross.name, "j::cross");
    EXPECT_EQ(cross.inertial.mass, 0);
    EXPECT_EQ(cross.model_from_link.position, (Vector3{0, 0, 1}));
    EXPECT_EQ(second.parent, first.child);
    EXPECT_EQ(model->links[static_cast<std::size_t>(second.child)].name, "b");
  }
  EXPECT_THAT(problems_, IsEmpty());
}

TEST_F(SdfJointTest, AJointWithoutAnAxisIsReported) {
  const auto model = ReadJoint("prismatic", "");
  ASSERT_THAT(model->joints, SizeIs(1));
  EXPECT_EQ(model->joints[0].axis, (Vector3{0, 0, 1}));
  ASSERT_THAT(problems_, testing::Not(IsEmpty()));
  EXPECT_THAT(problems_[0].message, HasSubstr("the joint has no <axis>; the z axis is used"));
}

TEST_F(SdfJointTest, APlaneWithoutANormalIsReported) {
  const auto model = Read(
      "<link name='a'><collision name='c'><geometry><plane><normal>0 0 0</normal></plane>"
      "</geometry></collision></link>");
  ASSERT_THAT(model->links, SizeIs(1));
  ASSERT_THAT(model->links[0].collisions, SizeIs(1));
  const auto* plane = std::get_if<geometry::Plane>(&model->links[0].collisions[0].shape);
  ASSERT_NE(plane, nullptr);
  EXPECT_EQ(plane->normal, (Vector3{0, 0, 1}));
  ASSERT_THAT(problems_, testing::Not(IsEmpty()));
  EXPECT_THAT(problems_[0].message, HasSubstr("the plane's normal is zero; the z axis is used"));
}

TEST_F(SdfJointTest, ABallJointBecomesThreeJoints) {
  const auto model = ReadJoint("ball", "");
  ASSERT_THAT(model->joints, SizeIs(3));
  ASSERT_THAT(model->links, SizeIs(4));
  int link = 0;
  for (const model::Joint& joint : model->joints) {
    EXPECT_EQ(joint.kind, JointKind::kBall);
    EXPECT_EQ(joint.parent, link);
    link = joint.child;
  }
  EXPECT_EQ(model->links[static_cast<std::size_t>(link)].name, "b");
  EXPECT_THAT(problems_, IsEmpty());
}

TEST_F(SdfJointTest, AScrewHasItsPitchInMetresPerRadian) {
  // <thread_pitch>, the older element, is in rad/m, and positive for a left-handed thread. So 4
  // means -1/4 m/rad.
  const auto old =
      ReadJoint("screw", "<thread_pitch>4</thread_pitch><axis><xyz>0 0 1</xyz></axis>");
  EXPECT_EQ(old->joints.at(0).kind, JointKind::kScrew);
  EXPECT_DOUBLE_EQ(old->joints.at(0).thread_pitch, -0.25);
  EXPECT_THAT(problems_, IsEmpty());
  const auto none =
      ReadJoint("screw", "<thread_pitch>0</thread_pitch><axis><xyz>0 0 1</xyz></axis>");
  EXPECT_EQ(none->joints.at(0).kind, JointKind::kFixed);
  ASSERT_THAT(problems_, SizeIs(1));
  EXPECT_THAT(problems_[0].message, HasSubstr("the pitch of a screw joint must not be 0"));
}

// SDFormat defines: seen from the reference body, the child rotates by -ratio times the angle of
// the parent. If the axis of the child's joint is reversed, its angle has the opposite sign.
TEST_F(SdfJointTest, GearboxCouplesTheJointsOfItsTwoLinks) {
  const auto shaft = [](const std::string& name, const std::string& parent,
                        const std::string& child, const std::string& axis) {
    return "<joint name='" + name + "' type='revolute'><parent>" + parent + "</parent><child>" +
           child + "</child><axis><xyz>" + axis + "</xyz></axis></joint>";
  };
  const std::string links = "<link name='frame'/><link name='motor'/><link name='wheel'/>";
  const auto gearbox = [](const std::string& reference, const std::string& axis) {
    return "<joint name='gears' type='gearbox'><parent>motor</parent><child>wheel</child>"
           "<gearbox_ratio>4</gearbox_ratio><gearbox_reference_body>" +
           reference + "</gearbox_reference_body><axis><xyz>" + axis +
           "</xyz></axis><axis2><xyz>0 1 0</xyz></axis2></joint>";
  };
  const std::string shafts = shaft("in", "frame", "motor", "0 1 0");
  const auto model =
      Read(links + shafts + shaft("out", "frame", "wheel", "0 1 0") + gearbox("frame", "0 1 0"));
  EXPECT_THAT(problems_, IsEmpty());
  ASSERT_THAT(model->joints, SizeIs(2));
  ASSERT_TRUE(model->joints[1].mimic);
  EXPECT_EQ(model->joints[1].mimic->leader, 0);
  EXPECT_EQ(model->joints[1].mimic->multiplier, -4);
  const auto reversed =
      Read(links + shafts + shaft("out", "frame", "wheel", "0 -1 0") + gearbox("frame", "0 1 0"));
  EXPECT_EQ(reversed->joints[1].mimic->multiplier, 4);

  for (const std::string& wrong : {gearbox("nothing", "0 1 0"), gearbox("frame", "1 0 0")}) {
    problems_.clear();
    const auto free = Read(links + shafts + shaft("out", "frame", "wheel", "0 1 0") + wrong);
    ASSERT_THAT(problems_, SizeIs(1));
    EXPECT_THAT(problems_[0].Sentence(), HasSubstr("the gearbox \"gears\""));
    EXPECT_FALSE(free->joints[1].mimic);
  }
}

TEST_F(SdfJointTest, ReadsTheTargetsOfGazebosControllers) {
  const auto model = Read(
      "<link name='a'/><link name='b'/><link name='c'/>"
      "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz>"
      "</axis></joint><joint name='k' type='prismatic'><parent>a</parent><child>c</child><axis>"
      "<xyz>0 0 1</xyz><limit><effort>50</effort></limit></axis></joint>"
      "<plugin filename='gz-sim-joint-controller-system' name='gz::sim::systems::JointController'>"
      "<joint_name>j</joint_name><initial_velocity>1.5</initial_velocity></plugin>"
      "<plugin filename='ignition-gazebo-joint-position-controller-system' "
      "name='ignition::gazebo::systems::JointPositionController'><joint_name>k</joint_name>"
      "<initial_position>0.2</initial_position><cmd_max>30</cmd_max></plugin>");
  EXPECT_THAT(problems_, IsEmpty());
  ASSERT_THAT(model->joint_targets, SizeIs(2));
  EXPECT_EQ(model->joint_targets[0].joint, 0);
  EXPECT_EQ(model->joint_targets[0].kind, JointTarget::Kind::kVelocity);
  EXPECT_EQ(model->joint_targets[0].value, 1.5);
  EXPECT_EQ(model->joint_targets[1].joint, 1);
  EXPECT_EQ(model->joint_targets[1].kind, JointTarget::Kind::kPosition);
  EXPECT_EQ(model->joint_targets[1].value, 0.2);
  EXPECT_EQ(model->joints[1].effort_limit, 30);
  EXPECT_FALSE(model->drive.has_value());
}

TEST_F(SdfJointTest, ReadsTheGainsOfGazebosControllers) {
  const auto model = Read(
      "<link name='a'/><link name='b'/><link name='c'/>"
      "<joint name='j' type='revolute'><parent>a</parent><child>b</child><axis><xyz>0 0 1</xyz>"
      "</axis></joint><joint name='k' type='prismatic'><parent>a</parent><child>c</child><axis>"
      "<xyz>0 0 1</xyz><limit><effort>50</effort></limit></axis></joint>"
      "<plugin filename='gz-sim-joint-controller-system' name='gz::sim::systems::JointController'>"
      "<joint_name>j</joint_name><use_force_commands>true</use_force_commands><p_gain>0.2</p_gain>"
      "<i_gain>0.01</i_gain></plugin>"
      "<plugin filename='gz-sim-joint-position-controller-system' "
      "name='gz::sim::systems::JointPositionController'><joint_name>k</joint_name>"
      "<p_gain>300</p_gain><i_max>4</i_max><i_min>-3</i_min><cmd_max>30</cmd_max>"
      "<cmd_min>-20</cmd_min><cmd_offset>2</cmd_offset></plugin>");
  EXPECT_THAT(problems_, IsEmpty());
  const auto& turns = model->joints[0].velocity_gains;
  ASSERT_TRUE(turns);
  EXPECT_FALSE(model->joints[0].position_gains);
  EXPECT_EQ(turns->p, 0.2);
  EXPECT_EQ(turns->i, 0.01);
  EXPECT_EQ(turns->d, 0);
  EXPECT_EQ(turns->effort.max, 1000);
  const auto& slides = model->joints[1].position_gains;
  ASSERT_TRUE(slides);
  EXPECT_EQ(slides->p, 300);
  EXPECT_EQ(slides->i, 0.1);   // Gazebo's default
  EXPECT_EQ(slides->d, 0.01);  // Gazebo's default
  EXPECT_EQ(slides->integral.min, -3);
  EXPECT_EQ(slides->integral.max, 4);
  EXPECT_EQ(slides->effort.min, -20);
  EXPECT_EQ(slides->effort.max, 30);
  EXPECT_EQ(slides->offset, 2);
  EXPECT_EQ(model->joints[1].effort_limit, 50);
}

TEST_F(SdfJointTest, IgnoresGainsThatGazeboDoesNotUse) {
  const auto model = Read(
      "<link name='a'/><link name='b'/><joint name='j' type='revolute'><parent>a</parent>"
      "<child>b</child><axis><xyz>0 0 1</xyz></axis></joint>"
      "<plugin filename='gz-sim-joint-position-controller-system' name='x'><joint_name>j"
      "</joint_name><use_velocity_commands>true</use_velocity_commands><p_gain>300</p_gain>"
      "<cmd_max>3</cmd_max></plugin>");
  EXPECT_FALSE(model->joints[0].position_gains);
  EXPECT_EQ(model->joints[0].velocity_limit, 3);
}

TEST_F(SdfJointTest, ReadsTheControllersOfGazeboClassic) {
  const auto model = Read(
      "<link name='a'/><link name='b'/><link name='c'/><joint name='j' type='revolute'><parent>a"
      "</parent><child>b</child><axis><xyz>0 0 1</xyz></axis></joint><joint name='k' "
      "type='revolute'><parent>a</parent><child>c</child><axis><xyz>0 0 1</xyz></axis></joint>"
      "<plugin filename='libJointControlPlugin.so' name='x'><controller type='position'>"
      "<joint>j</joint><target>0.7</target><pid_gains>10 0.5 2</pid_gains></controller>"
      "<controller type='force'><joint>k</joint><target>3</target></controller></plugin>");
  EXPECT_THAT(problems_, IsEmpty());
  ASSERT_TRUE(model->joints[0].position_gains);
  EXPECT_EQ(model->joints[0].position_gains->p, 10);
  EXPECT_EQ(model->joints[0].position_gains->i, 0.5);
  EXPECT_EQ(model->joints[0].position_gains->d, 2);
  ASSERT_THAT(model->joint_targets, SizeIs(2));
  EXPECT_EQ(model->joint_targets[0].value, 0.7);
  EXPECT_EQ(model->joint_targets[1].kind, JointTarget::Kind::kEffort);
  EXPECT_EQ(model->joint_targets[1].value, 3);
}

TEST_F(SdfJointTest, ReportsNegativeGains) {
  const auto model = Read(
      "<link name='a'/><link name='b'/><joint name='j' type='revolute'><parent>a</parent>"
      "<child>b</child><axis><xyz>0 0 1</xyz></axis></joint>"
      "<plugin filename='gz-sim-joint-position-controller-system' name='x'><joint_name>j"
      "</joint_name><p_gain>-5</p_gain></plugin>");
  ASSERT_THAT(problems_, SizeIs(1));
  EXPECT_THAT(problems_[0].Sentence(), HasSubstr("must not be negative"));
  EXPECT_EQ(model->joints[0].position_gains->p, 0);
}

TEST_F(SdfJointTest, ReadsTheSlipOfWheelsAndSurfaces) {
  const auto model = Read(
      "<gsv:slip><gsv:longitudinal>0.1</gsv:longitudinal><gsv:lateral>0.2</gsv:lateral></gsv:slip>"
      "<link name='a'><collision name='c'><geometry><sphere><radius>0.1</radius></sphere>"
      "</geometry><surface>"
      "<gsv:slip><gsv:lateral>0.5</gsv:lateral></gsv:slip></surface></collision></link>"
      "<link name='b'><collision name='c'><geometry><sphere><radius>0.2</radius></sphere>"
      "</geometry></collision></link><joint name='j' type='revolute'><parent>a</parent><child>b"
      "</child><axis><xyz>0 1 0</xyz></axis></joint>"
      "<plugin filename='gz-sim-velocity-control-system' name='gz::sim::systems::VelocityControl'/>"
      "<plugin filename='gz-sim-wheel-slip-system' name='gz::sim::systems::WheelSlip'>"
      "<wheel link_name='b'><slip_compliance_lateral>1.5</slip_compliance_lateral>"
      "<slip_compliance_longitudinal>0.25</slip_compliance_longitudinal><wheel_normal_force>70"
      "</wheel_normal_force></wheel><wheel link_name='gone'/></plugin>");
  ASSERT_THAT(problems_, SizeIs(1));
  EXPECT_THAT(problems_[0].Sentence(), HasSubstr("\"gone\""));
  EXPECT_EQ(model->drive->slip.longitudinal, 0.1);
  EXPECT_EQ(model->drive->slip.lateral, 0.2);
  const model::Surface& surface = model->links[0].collisions[0].surface;
  EXPECT_EQ(surface.wheel_slip.longitudinal, 0);
  EXPECT_EQ(surface.wheel_slip.lateral, 0.5);
  ASSERT_TRUE(model->links[1].wheel);
  EXPECT_EQ(model->links[1].wheel->slip.lateral, 1.5);
  EXPECT_EQ(model->links[1].wheel->slip.longitudinal, 0.25);
  EXPECT_EQ(model->links[1].wheel->normal_force, 70);
  EXPECT_EQ(model->links[1].wheel->radius, 0.2);
}

TEST_F(SdfJointTest, ReportsControllersOfMissingJoints) {
  (void)Read(
      "<link name='a'/>\n<plugin filename='gz-sim-joint-controller-system' name='x'>"
      "<joint_name>nowhere</joint_name></plugin>");
  ASSERT_THAT(problems_, SizeIs(1));
  EXPECT_EQ(problems_[0].severity, base::Problem::Severity::kWarning);
  EXPECT_THAT(problems_[0].Sentence(), AllOf(HasSubstr("m.sdf:2"), HasSubstr("\"nowhere\"")));
}

TEST_F(SdfJointTest, UsesTheFirstFrictionInEveryDirectionIfThereIsNoSecond) {
  for (const char* friction :
       {"<ode><mu>0.4</mu></ode>", "<bullet><friction>0.4</friction></bullet>"}) {
    const auto model =
        Read(std::string("<link name='a'><collision name='c'><geometry><sphere><radius>1</radius>"
                         "</sphere></geometry><surface><friction>") +
             friction + "</friction></surface></collision></link>");
    const model::Surface& surface = model->links.at(0).collisions.at(0).surface;
    EXPECT_EQ(surface.friction, 0.4);
    EXPECT_EQ(surface.friction2, 0.4);
  }
}

TEST_F(SdfJointTest, ReadsBothFrictionsAndTheirDirectionAndLinksWithoutGravity) {
  const auto model = Read(
      "<link name='a'><gravity>0</gravity><collision name='c'><geometry><sphere><radius>1</radius>"
      "</sphere></geometry><surface><friction><ode><mu>0.5</mu><mu2>0.1</mu2><fdir1>0 2 0</fdir1>"
      "</ode></friction></surface></collision></link><link name='b'/>");
  const model::Surface& surface = model->links.at(0).collisions.at(0).surface;
  EXPECT_EQ(surface.friction, 0.5);
  EXPECT_EQ(surface.friction2, 0.1);
  EXPECT_EQ(surface.friction_direction, (Vector3{0, 1, 0}));
  EXPECT_FALSE(model->links[0].has_gravity);
  EXPECT_TRUE(model->links[1].has_gravity);
}

}  // namespace
}  // namespace gsv::formats
