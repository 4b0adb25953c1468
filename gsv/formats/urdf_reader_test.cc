// Tests how robots in URDF and xacro are read.
#include <gmock/gmock.h>

#include "gsv/formats/testing/sdf_reader_fixture.h"

namespace gsv::formats {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

TEST_F(SdfReaderTest, MergesLinksThatAFixedJointConnectsInUrdf) {
  folder_.Write("robot.urdf", R"(<?xml version='1.0'?>
<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'><xacro:arg name='ns' default=''/><xacro:property name='p' value='$(arg ns)'/>
<link name='${p}base'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial>
<collision><geometry><box size='1 1 1'/></geometry></collision></link>
<link name='wheel'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>
<link name='cap'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>
<joint name='axle' type='continuous'><parent link='base'/><child link='wheel'/><origin xyz='0 0.5 0'/><axis xyz='0 1 0'/></joint>
<joint name='glue' type='fixed'><parent link='base'/><child link='cap'/></joint></robot>)");
  const auto model = ModelLibrary().ReadModel((folder_.path() / "robot.urdf").string(), problems_);
  ASSERT_TRUE(model.has_value()) << model.error().Sentence();
  EXPECT_THAT(Sentences(), IsEmpty());
  ASSERT_THAT((*model)->links, SizeIs(2));
  EXPECT_EQ((*model)->links[0].name, "base");
  EXPECT_EQ((*model)->links[0].inertial.mass, 2);
  EXPECT_EQ((*model)->joints.at(0).kind, model::JointKind::kContinuous);
  ExpectNear((*model)->joints[0].model_from_joint.position, {0, 0.5, 0});
}

TEST_F(SdfReaderTest, ExpandsXacroWithTheArgumentsInItsName) {
  const std::string file = folder_
                               .Write("robot.urdf.xacro", R"(<?xml version='1.0'?>
<robot name='r' xmlns:xacro='http://www.ros.org/wiki/xacro'>
<xacro:arg name='mass' default='2'/>
<xacro:macro name='part' params='name'>
<link name='${name}'><inertial><mass value='$(arg mass)'/>
<inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>
</xacro:macro>
<xacro:part name='base'/>
</robot>)")
                               .string();
  ModelLibrary library;
  const auto plain = library.ReadModel(file, problems_);
  ASSERT_TRUE(plain.has_value()) << plain.error().Sentence();
  EXPECT_EQ((*plain)->links.at(0).inertial.mass, 2);
  const auto heavy = library.ReadModel(file + "?mass=5", problems_);
  ASSERT_TRUE(heavy.has_value()) << heavy.error().Sentence();
  EXPECT_EQ((*heavy)->links.at(0).inertial.mass, 5);
  EXPECT_EQ((*heavy)->source, file + "?mass=5");
  EXPECT_THAT(Sentences(), IsEmpty());
  const auto broken = library.ReadModel(
      folder_.Write("broken.xacro", "<robot name='r'>\n<xacro:none/></robot>").string(), problems_);
  ASSERT_FALSE(broken.has_value());
  EXPECT_THAT(broken.error().Sentence(), HasSubstr("broken.xacro:2: there is no macro \"none\""));
}

TEST_F(SdfReaderTest, ReadsRobotsWithRemainsOfXacroAndALateDeclaration) {
  const std::string link =
      "<link name='base'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' "
      "ixz='0' iyz='0'/></inertial></link>";
  const auto remains = folder_.Write(
      "remains.urdf", "<robot name='r'>" + link + "\n<xacro:pan_tilt name='p'/></robot>");
  EXPECT_TRUE(ModelLibrary().ReadModel(remains.string(), problems_).has_value());
  EXPECT_THAT(Sentences(),
              testing::Contains(testing::AllOf(
                  HasSubstr("remains.urdf:2: the xacro elements of this file are ignored"),
                  HasSubstr("there is no macro \"pan_tilt\""))));
  problems_.clear();
  const auto late =
      folder_.Write("late.urdf", "<!-- made by hand -->\n<?xml version='1.0'?>\n<robot name='r'>" +
                                     link + "</robot>");
  EXPECT_TRUE(ModelLibrary().ReadModel(late.string(), problems_).has_value());
  EXPECT_THAT(Sentences(), testing::Contains(HasSubstr("late.urdf:2: <?xml …?> is preceded by")));
}

TEST_F(SdfReaderTest, ReadsRos2ControlOfAModelInAWorld) {
  const auto world = ModelLibrary().ReadWorld(
      folder_.Write(
          "arm.sdf",
          Sdf("<world name='w'><model name='arm'><link name='base'/><link name='upper'/>"
              "<joint name='shoulder' type='revolute'><parent>base</parent>"
              "<child>upper</child><axis><xyz>0 0 1</xyz></axis></joint>"
              "<ros2_control name='all' type='system'><joint name='shoulder'>"
              "<command_interface name='position'/></joint></ros2_control></model></world>")),
      problems_);
  ASSERT_TRUE(world.has_value());
  ASSERT_THAT(world->models, SizeIs(1));
  const auto& systems = world->models[0].model->control_systems;
  ASSERT_THAT(systems, SizeIs(1));
  ASSERT_THAT(systems[0].joints, SizeIs(1));
  EXPECT_EQ(systems[0].joints[0].joint, "shoulder");
}

TEST_F(SdfReaderTest, WarningsHaveTheFileAndLineOfAMacro) {
  folder_.Write(
      "part.xacro",
      "<robot>\n<xacro:macro name='part' params='name'>\n<link name='${name}'><inertial>\n"
      "<mass value='1'/><inertia ixx='1' iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/>\n"
      "</inertial><colision/></link></xacro:macro></robot>");
  const auto file = folder_.Write("robot.urdf.xacro",
                                  "<robot name='r'>\n<xacro:include filename='part.xacro'/>\n"
                                  "<xacro:part name='base'/>\n</robot>");
  ASSERT_TRUE(ModelLibrary().ReadModel(file.string(), problems_).has_value());
  EXPECT_THAT(Sentences(), testing::Contains(
                               testing::AllOf(HasSubstr("part.xacro:5: "), HasSubstr("colision"))));
}

TEST_F(SdfReaderTest, TakesTwoFreeWheelsOfAUrdfAsADifferentialDrive) {
  const auto wheel = [](const std::string& name, const std::string& y) {
    return "<link name='" + name +
           "'><inertial><mass value='1'/><inertia ixx='1' iyy='1' izz='1' "
           "ixy='0' ixz='0' iyz='0'/></inertial><collision><geometry><cylinder radius='0.07' "
           "length='0.02'/></geometry></collision></link><joint name='" +
           name +
           "_joint' "
           "type='continuous'><parent link='base'/><child link='" +
           name + "'/><origin xyz='0.1 " + y +
           " 0' rpy='-1.5707963 0 0'/><axis xyz='0 0 1'/></joint>";
  };
  folder_.Write("robot.urdf",
                "<robot name='r'><link name='base'><inertial><mass value='1'/><inertia ixx='1' "
                "iyy='1' izz='1' ixy='0' ixz='0' iyz='0'/></inertial></link>" +
                    wheel("right", "-0.15") + wheel("left", "0.25") + "</robot>");
  const auto model = ModelLibrary().ReadModel((folder_.path() / "robot.urdf").string(), problems_);
  ASSERT_TRUE(model.has_value()) << model.error().Sentence();
  ASSERT_TRUE((*model)->drive.has_value());
  const model::Drive& drive = *(*model)->drive;
  EXPECT_EQ((*model)->joints.at(drive.left_wheels.at(0)).name, "left_joint");
  EXPECT_EQ((*model)->joints.at(drive.right_wheels.at(0)).name, "right_joint");
  EXPECT_NEAR(drive.wheel_separation, 0.4, 1e-9);
  EXPECT_NEAR(drive.wheel_radius, 0.07, 1e-9);
  EXPECT_THAT(Sentences(), IsEmpty());
}

}  // namespace
}  // namespace gsv::formats
