// Tests drives and sensors in the files of robots.
#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/sdf_reader.h"

namespace gsv::formats {
namespace {

using model::DriveKind;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

// A base with four wheels of radius 0.15 at x = ±0.4, y = ±0.3, each rotating about y.
std::string Robot(const std::string& more, const std::string& base_more = "") {
  std::string sdf = "<sdf version='1.9'><model name='r'><link name='base'>" + base_more + "</link>";
  for (const auto& [name, x, y] :
       {std::tuple{"fl", 0.4, 0.3}, {"fr", 0.4, -0.3}, {"rl", -0.4, 0.3}, {"rr", -0.4, -0.3}}) {
    const std::string wheel = name;
    sdf += "<link name='" + wheel + "'><pose>" + std::to_string(x) + " " + std::to_string(y) +
           " 0 -1.5707963 0 0</pose><collision name='c'><geometry><cylinder><radius>0.15</radius>"
           "<length>0.05</length></cylinder></geometry></collision></link><joint name='" +
           wheel + "_joint' type='revolute'><parent>base</parent><child>" + wheel +
           "</child><axis><xyz>0 0 1</xyz></axis></joint>";
  }
  return sdf + more + "</model></sdf>";
}

std::string Plugin(const std::string& file, const std::string& name, const std::string& content) {
  return "<plugin filename='" + file + "' name='" + name + "'>" + content + "</plugin>";
}

class SdfRobotTest : public testing::Test {
 protected:
  std::shared_ptr<const model::Model> Read(const std::string& sdf) {
    auto model = ModelLibrary().ReadModel(folder_.Write("r.sdf", sdf).string(), problems_);
    EXPECT_TRUE(model.has_value()) << (model ? "" : model.error().Sentence());
    return model.value_or(std::make_shared<const model::Model>());
  }
  std::optional<model::Drive> DriveOf(const std::string& plugin) {
    return Read(Robot(plugin))->drive;
  }

  base::testing::TestFolder folder_;
  base::Problems problems_;
};

TEST_F(SdfRobotTest, ReadsGazebosDiffDriveWithItsLimits) {
  for (const char* name : {"gz::sim::systems::DiffDrive", "ignition::gazebo::systems::DiffDrive"}) {
    const auto drive =
        DriveOf(Plugin("gz-sim-diff-drive-system", name,
                       "<left_joint>fl_joint</left_joint><right_joint>fr_joint</right_joint>"
                       "<wheel_separation>0.62</wheel_separation><wheel_radius>0.16</wheel_radius>"
                       "<max_linear_velocity>1.5</max_linear_velocity><min_linear_velocity>-0.5</"
                       "min_linear_velocity>"
                       "<max_angular_velocity>2</max_angular_velocity><max_linear_acceleration>3</"
                       "max_linear_acceleration>"
                       "<command_timeout>0.25</command_timeout>"));
    ASSERT_TRUE(drive.has_value()) << name;
    EXPECT_EQ(drive->kind, DriveKind::kDifferential);
    EXPECT_THAT(drive->left_wheels, ElementsAre(0));
    EXPECT_THAT(drive->right_wheels, ElementsAre(1));
    EXPECT_EQ(drive->wheel_separation, 0.62);
    EXPECT_EQ(drive->wheel_radius, 0.16);
    EXPECT_EQ(drive->linear_velocity.max, 1.5);
    EXPECT_EQ(drive->linear_velocity.min, -0.5);
    EXPECT_EQ(drive->angular_velocity.min, -2);
    EXPECT_EQ(drive->linear_acceleration.min, -3);
    EXPECT_EQ(drive->command_timeout, std::chrono::milliseconds(250));
  }
  EXPECT_THAT(problems_, IsEmpty());
}

TEST_F(SdfRobotTest, MeasuresMissingValues) {
  const auto drive = DriveOf(Plugin(
      "libDiffDrivePlugin.so", "diff_drive",
      "<left_joint>fl_joint</left_joint><right_joint>fr_joint</right_joint><torque>5</torque>"));
  ASSERT_TRUE(drive.has_value());
  EXPECT_NEAR(drive->wheel_separation, 0.6, 1e-12);
  EXPECT_NEAR(drive->wheel_radius, 0.15, 1e-12);
}

TEST_F(SdfRobotTest, ReadsAllVariantsOfDiffDrive) {
  const auto ros1 =
      DriveOf(Plugin("libgazebo_ros_diff_drive.so", "x",
                     "<leftJoint>fl_joint</leftJoint><rightJoint>fr_joint</rightJoint>"
                     "<wheelSeparation>0.7</wheelSeparation><wheelDiameter>0.4</wheelDiameter>"));
  ASSERT_TRUE(ros1.has_value());
  EXPECT_EQ(ros1->wheel_separation, 0.7);
  EXPECT_EQ(ros1->wheel_radius, 0.2);

  const auto ros2 = DriveOf(
      Plugin("libgazebo_ros_diff_drive.so", "x",
             "<left_joint>fl_joint</left_joint><left_joint>rl_joint</left_joint>"
             "<right_joint>fr_joint</right_joint><right_joint>rr_joint</right_joint>"
             "<wheel_separation>0.7</wheel_separation><wheel_diameter>0.4</wheel_diameter>"));
  ASSERT_TRUE(ros2.has_value());
  EXPECT_THAT(ros2->left_wheels, ElementsAre(0, 2));
  EXPECT_EQ(ros2->wheel_radius, 0.2);

  const auto skid =
      DriveOf(Plugin("libSkidSteerDrivePlugin.so", "SkidSteerDrivePlugin",
                     "<right_front>fr_joint</right_front><right_rear>rr_joint</right_rear>"
                     "<left_front>fl_joint</left_front><left_rear>rl_joint</left_rear>"));
  ASSERT_TRUE(skid.has_value());
  EXPECT_EQ(skid->kind, DriveKind::kDifferential);
  EXPECT_THAT(skid->right_wheels, ElementsAre(1, 3));
  EXPECT_NEAR(skid->wheel_separation, 0.6, 1e-12);
}

TEST_F(SdfRobotTest, ReadsTheOtherDrives) {
  const auto mecanum = DriveOf(Plugin(
      "gz-sim-mecanum-drive-system", "gz::sim::systems::MecanumDrive",
      "<front_left_joint>fl_joint</front_left_joint><front_right_joint>fr_joint</front_right_joint>"
      "<back_left_joint>rl_joint</back_left_joint><back_right_joint>rr_joint</back_right_joint>"
      "<min_acceleration>-5</min_acceleration><max_acceleration>4</max_acceleration>"));
  ASSERT_TRUE(mecanum.has_value());
  EXPECT_EQ(mecanum->kind, DriveKind::kMecanum);
  EXPECT_THAT(mecanum->left_wheels, ElementsAre(0, 2));
  EXPECT_NEAR(mecanum->wheel_base, 0.8, 1e-12);
  EXPECT_EQ(mecanum->linear_acceleration.min, -5);
  EXPECT_EQ(mecanum->linear_acceleration.max, 4);

  const auto ackermann =
      DriveOf(Plugin("gz-sim-ackermann-steering-system", "gz::sim::systems::AckermannSteering",
                     "<left_joint>rl_joint</left_joint><right_joint>rr_joint</right_joint>"
                     "<left_steering_joint>fl_joint</"
                     "left_steering_joint><right_steering_joint>fr_joint</right_steering_joint>"
                     "<wheel_base>0.8</wheel_base><steering_limit>0.6</steering_limit>"));
  ASSERT_TRUE(ackermann.has_value());
  EXPECT_EQ(ackermann->kind, DriveKind::kAckermann);
  EXPECT_THAT(ackermann->steered, ElementsAre(0, 1));
  EXPECT_EQ(ackermann->steering_limit, 0.6);

  EXPECT_EQ(
      DriveOf(Plugin("gz-sim-velocity-control-system", "gz::sim::systems::VelocityControl", ""))
          ->kind,
      DriveKind::kVelocity);
  const auto synchro = DriveOf(
      Plugin("gsv-synchro-drive", "gsv::SynchroDrive",
             "<wheel_radius>0.1</wheel_radius><max_linear_velocity>0.9</max_linear_velocity>"));
  ASSERT_TRUE(synchro.has_value());
  EXPECT_EQ(synchro->kind, DriveKind::kSynchro);
  EXPECT_EQ(synchro->wheel_radius, 0.1);
  EXPECT_FALSE(DriveOf(Plugin("gz-sim-joint-state-publisher-system", "JointStatePublisher", ""))
                   .has_value());
  EXPECT_THAT(problems_, IsEmpty());
}

TEST_F(SdfRobotTest, GuessesTheDriveIfThePluginNamesNoUsableWheels) {
  const auto wrong =
      DriveOf(Plugin("gz-sim-diff-drive-system", "DiffDrive",
                     "<left_joint>nowhere</left_joint><right_joint>fr_joint</right_joint>"
                     "<max_linear_velocity>2</max_linear_velocity>"));
  ASSERT_TRUE(wrong.has_value());
  EXPECT_EQ(wrong->origin, model::DriveOrigin::kGuessed);
  EXPECT_THAT(wrong->left_wheels, ElementsAre(0, 2));
  EXPECT_EQ(wrong->linear_velocity.max, 2);
  EXPECT_TRUE(DriveOf(Plugin("gz-sim-diff-drive-system", "DiffDrive", "")).has_value());
  ASSERT_THAT(problems_, SizeIs(4));
  EXPECT_THAT(problems_[0].Sentence(), HasSubstr("nowhere"));
  EXPECT_THAT(problems_[1].Sentence(),
              HasSubstr("the plugin is not used; the drive is skid steering, guessed from wheels "
                        "fl_joint, rl_joint, fr_joint, rr_joint; radius 0.15 m, separation 0.6 m"));
  EXPECT_THAT(problems_[2].Sentence(), HasSubstr("names no joint"));
}

TEST_F(SdfRobotTest, MeasuresTheWheelsInsteadOfUsingImpossibleNumbers) {
  EXPECT_TRUE(DriveOf(Plugin("gz-sim-diff-drive-system", "DiffDrive",
                             "<left_joint>fl_joint</left_joint><right_joint>fr_joint</"
                             "right_joint><wheel_radius>-1</wheel_radius>"
                             "<max_linear_velocity>1</max_linear_velocity><min_linear_velocity>2</"
                             "min_linear_velocity>"))
                  .has_value());
  ASSERT_THAT(problems_, SizeIs(2));
  EXPECT_THAT(problems_[0].Sentence(), HasSubstr("<wheel_radius> must be above zero"));
  EXPECT_THAT(problems_[1].Sentence(), HasSubstr("linear_velocity"));
  for (const auto& problem : problems_) {
    EXPECT_EQ(problem.severity, base::Problem::Severity::kWarning);
  }
}

TEST_F(SdfRobotTest, ASteeringOnlyPluginWithoutWheelsGivesNoDrive) {
  const auto model = Read(
      "<sdf version='1.9'><model name='car'><link name='base'/><link name='ball'><pose>1 0 0 0 0 "
      "0</pose><collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry>"
      "</collision></link><joint name='steer' type='revolute'><parent>base</parent><child>ball"
      "</child><axis><xyz>0 0 1</xyz><limit><lower>-1</lower><upper>1</upper></limit></axis>"
      "</joint>" +
      Plugin("gz-sim-ackermann-steering-system", "gz::sim::systems::AckermannSteering",
             "<steering_only>true</steering_only><left_steering_joint>steer</left_steering_joint>"
             "<right_steering_joint>steer</right_steering_joint>") +
      "</model></sdf>");
  ASSERT_TRUE(model->drive.has_value());
  EXPECT_EQ(model->drive->kind, DriveKind::kNone);
  EXPECT_THAT(model->drive->steered, IsEmpty());
  EXPECT_THAT(problems_, IsEmpty());
}

TEST_F(SdfRobotTest, ReadsATrackedVehicleAsADifferentialDriveWithoutWheels) {
  const auto model =
      Read("<sdf version='1.9'><model name='digger'><link name='base'/>" +
           Plugin("gz-sim-tracked-vehicle-system", "gz::sim::systems::TrackedVehicle",
                  "<left_track><link>base</link></left_track><right_track><link>base</link>"
                  "</right_track><tracks_separation>0.6</tracks_separation>") +
           "</model></sdf>");
  ASSERT_TRUE(model->drive.has_value());
  EXPECT_EQ(model->drive->kind, DriveKind::kDifferential);
  EXPECT_THAT(model->drive->left_wheels, IsEmpty());
  EXPECT_DOUBLE_EQ(model->drive->wheel_separation, 0.6);
  EXPECT_THAT(problems_, IsEmpty());
}

TEST_F(SdfRobotTest, GuessesTheDriveIfTheWheelBaseIsUnknown) {
  const auto model = Read(Robot(Plugin("libgazebo_ros_ackermann_drive.so", "car",
                                       "<front_left_joint>fl_joint</front_left_joint>"
                                       "<front_right_joint>fr_joint</front_right_joint>")));
  ASSERT_TRUE(model->drive.has_value());
  EXPECT_NE(model->drive->kind, DriveKind::kAckermann);
  ASSERT_FALSE(problems_.empty());
  EXPECT_THAT(problems_[0].message, HasSubstr("determine its wheel base"));
}

TEST_F(SdfRobotTest, ReadsRos2ControlWithItsInterfaces) {
  const auto model = Read(Robot(
      "<ros2_control name='base' type='system'><hardware><plugin>some/Hardware</plugin></hardware>"
      "<joint name='fl_joint'><command_interface name='velocity'><param name='min'>-1</param>"
      "</command_interface><state_interface name='position'/><state_interface name='velocity'/>"
      "</joint><joint name='nobody'/></ros2_control>"));
  ASSERT_THAT(model->control_systems, SizeIs(1));
  const model::ControlSystem& system = model->control_systems.front();
  EXPECT_EQ(system.name, "base");
  EXPECT_EQ(system.type, "system");
  EXPECT_EQ(system.hardware, "some/Hardware");
  ASSERT_THAT(system.joints, SizeIs(1));
  EXPECT_EQ(system.joints[0].joint, "fl_joint");
  EXPECT_THAT(system.joints[0].command, ElementsAre("velocity"));
  EXPECT_THAT(system.joints[0].state, ElementsAre("position", "velocity"));
  bool is_said = false;
  for (const auto& problem : problems_) {
    is_said = is_said || problem.message.find("names the joint \"nobody\"") != std::string::npos;
  }
  EXPECT_TRUE(is_said);
}

TEST_F(SdfRobotTest, ReadsSensorsOfKnownAndUnknownTypes) {
  const auto model = Read(Robot("<frame name='mast'><pose>0 0 1 0 0 0</pose></frame>", R"(
    <pose>0 0 0.1 0 0 0</pose>
    <sensor name='scan' type='gpu_lidar'><pose>0.1 0 0.2 0 0 0</pose><update_rate>5</update_rate><visualize>true</visualize>
      <lidar><scan><horizontal><samples>360</samples><min_angle>-1</min_angle><max_angle>1</max_angle></horizontal></scan>
      <range><min>0.1</min><max>3.5</max></range><noise><type>gaussian</type><stddev>0.01</stddev></noise></lidar></sensor>
    <sensor name='eye' type='camera'><pose relative_to='mast'>0 0 0.5 0 0 0</pose>
      <camera><horizontal_fov>1.2</horizontal_fov><image><width>320</width><height>240</height></image>
      <clip><near>0.05</near><far>20</far></clip></camera></sensor>
    <sensor name='echo' type='sonar'><sonar><min>0.2</min><max>4</max><radius>0.3</radius></sonar></sensor>
    <sensor name='where' type='positioning'><noise><stddev>0.02</stddev></noise><frame_id>map</frame_id></sensor>)"));
  EXPECT_THAT(problems_, IsEmpty()) << problems_.front().Sentence();
  ASSERT_THAT(model->sensors, SizeIs(4));
  const auto& scan = model->sensors[0];
  EXPECT_EQ(scan.type, "gpu_lidar");
  EXPECT_EQ(scan.update_rate, 5);
  EXPECT_TRUE(scan.visualize);
  EXPECT_EQ(scan.link, 0);
  EXPECT_EQ(scan.link_from_sensor.position, (geometry::Vector3{0.1, 0, 0.2}));
  EXPECT_EQ(model::NumberOr(scan.parameters, "scan.horizontal.samples", 0), 360);
  EXPECT_EQ(model::NumberOr(scan.parameters, "range.max", 0), 3.5);
  EXPECT_EQ(model::NumberOr(scan.parameters, "noise.stddev", 0), 0.01);
  EXPECT_EQ(model::TextOr(scan.parameters, "noise.type", ""), "gaussian");

  const auto& eye = model->sensors[1];
  EXPECT_EQ(model::NumberOr(eye.parameters, "horizontal_fov", 0), 1.2);
  EXPECT_EQ(model::NumberOr(eye.parameters, "image.width", 0), 320);
  EXPECT_EQ(model::NumberOr(eye.parameters, "clip.near", 0), 0.05);
  EXPECT_NEAR(eye.link_from_sensor.position.z, 1.4,
              1e-12);  // 1 + 0.5 from the model, and 0.1 along the link

  const auto& echo = model->sensors[2];
  EXPECT_EQ(echo.type, "sonar");
  EXPECT_EQ(model::NumberOr(echo.parameters, "min", 0), 0.2);
  EXPECT_EQ(model::NumberOr(echo.parameters, "radius", 0), 0.3);

  const auto& where = model->sensors[3];
  EXPECT_EQ(where.type, "positioning");
  EXPECT_EQ(model::NumberOr(where.parameters, "noise.stddev", 0), 0.02);
  EXPECT_EQ(model::TextOr(where.parameters, "frame_id", ""), "map");
}

TEST_F(SdfRobotTest, ReadsGsvElementsByTheirPrefix) {
  const auto model = Read(Robot("", R"(
    <sensor name='echo' type='sonar'><sonar><gsv:beam>cone</gsv:beam><max>4</max></sonar></sensor>
    <sensor name='feel' type='imu'><imu><angular_velocity><x><noise type='gaussian'><stddev>0.01</stddev>
      <dynamic_bias_stddev>0.02</dynamic_bias_stddev><gsv:dropout_probability>0.1</gsv:dropout_probability>
      </noise></x></angular_velocity></imu></sensor>)"));
  EXPECT_THAT(problems_, IsEmpty()) << problems_.front().Sentence();
  ASSERT_THAT(model->sensors, SizeIs(2));
  EXPECT_EQ(model::TextOr(model->sensors[0].parameters, "beam", ""), "cone");
  EXPECT_EQ(model::NumberOr(model->sensors[0].parameters, "max", 0), 4);
  const auto& feel = model->sensors[1].parameters;
  EXPECT_EQ(model::NumberOr(feel, "angular_velocity.x.noise.stddev", 0), 0.01);
  EXPECT_EQ(model::NumberOr(feel, "angular_velocity.x.noise.dynamic_bias_stddev", 0), 0.02);
  EXPECT_EQ(model::NumberOr(feel, "angular_velocity.x.noise.dropout_probability", 0), 0.1);
  EXPECT_EQ(model::TextOr(feel, "angular_velocity.x.noise.type", ""), "gaussian");
}

TEST_F(SdfRobotTest, ASensorWithAPresetHasOnlyTheParametersThatItsFileGives) {
  const auto model = Read(Robot("", R"(
    <sensor name='scan' type='lidar'><gsv:preset>rplidar_a2</gsv:preset></sensor>
    <sensor name='near' type='lidar'><gsv:preset>rplidar_a2</gsv:preset>
      <lidar><range><max>3</max></range></lidar></sensor>)"));
  EXPECT_THAT(problems_, IsEmpty()) << problems_.front().Sentence();
  ASSERT_THAT(model->sensors, SizeIs(2));
  EXPECT_THAT(model->sensors[0].parameters, SizeIs(1));
  EXPECT_EQ(model::TextOr(model->sensors[0].parameters, "preset", ""), "rplidar_a2");
  EXPECT_THAT(model->sensors[1].parameters, SizeIs(2));
  EXPECT_EQ(model::NumberOr(model->sensors[1].parameters, "range.max", 0), 3);
}

TEST_F(SdfRobotTest, ReadsTheCollisionsOfAContactSensor) {
  const auto model = Read(
      "<sdf version='1.9'><model name='r'><link name='a'>"
      "<collision name='front'><geometry><sphere><radius>1</radius></sphere></geometry></collision>"
      "<collision name='back'><geometry><sphere><radius>1</radius></sphere></geometry></collision>"
      "<sensor name='both' type='contact'><contact><collision>front</collision>"
      "<collision>back</collision></contact></sensor>"
      "<sensor name='numb' type='contact'><contact><collision>nose</collision></contact></sensor>"
      "</link></model></sdf>");
  ASSERT_THAT(model->sensors, SizeIs(2));
  EXPECT_EQ(model::TextOr(model->sensors[0].parameters, "collision", ""), "front\nback");
  ASSERT_THAT(problems_, SizeIs(1));
  EXPECT_EQ(problems_[0].severity, base::Problem::Severity::kWarning);
  EXPECT_THAT(problems_[0].Sentence(), HasSubstr("numb names the collision \"nose\""));
}

TEST_F(SdfRobotTest, MakesDuplicateSensorNamesUnique) {
  const auto model = Read(
      "<sdf version='1.9'><model name='r'><link name='a'><sensor name='s' type='imu'/></link>"
      "<link name='b'><sensor name='s' type='imu'/></link></model></sdf>");
  ASSERT_THAT(model->sensors, SizeIs(2));
  EXPECT_EQ(model->sensors[0].name, "s");
  EXPECT_EQ(model->sensors[1].name, "b::s");
}

TEST_F(SdfRobotTest, ReadsTheMovementOfTheModel) {
  EXPECT_EQ(Read(Robot(""))->movement, model::Movement::kPlanar);
  EXPECT_EQ(Read(Robot("<gsv:movement>rigid</gsv:movement>"))->movement, model::Movement::kRigid);
  EXPECT_THAT(problems_, IsEmpty());
  Read(Robot("<gsv:movement>flying</gsv:movement>"));
  ASSERT_THAT(problems_, SizeIs(1));
  EXPECT_THAT(problems_[0].message, HasSubstr("planar or rigid"));
}

TEST_F(SdfRobotTest, ReadsDifferentRadiiOfLeftAndRightWheels) {
  const auto drive =
      DriveOf(Plugin("gz-sim-diff-drive-system", "gz::sim::systems::DiffDrive",
                     "<left_joint>fl_joint</left_joint><right_joint>fr_joint</right_joint>"
                     "<wheel_separation>0.6</wheel_separation><wheel_radius>0.1</wheel_radius>"
                     "<left_wheel_radius>0.101</left_wheel_radius>"));
  ASSERT_TRUE(drive);
  EXPECT_DOUBLE_EQ(drive->left_wheel_scale, 1.01);
  EXPECT_EQ(drive->right_wheel_scale, 1);
}

TEST_F(SdfRobotTest, UsesTheDriveChosenForItsModel) {
  const auto file = folder_.Write("r.sdf", Robot(""));
  ReadOptions options;
  options.drives = {{"r", "diff,left=fl_joint,right=fr_joint"}, {"other", "omni"}};
  ModelLibrary library(options);
  const auto model = library.ReadModel(file.string(), problems_);
  ASSERT_TRUE(model) << model.error().Sentence();
  ASSERT_TRUE((*model)->drive);
  EXPECT_EQ((*model)->drive->kind, DriveKind::kDifferential);
  EXPECT_EQ(library.ReadModel(file.string(), problems_).value(), *model);
  options.drives = {{"r", "diff,left=none,right=fr_joint"}};
  EXPECT_FALSE(ModelLibrary(options).ReadModel(file.string(), problems_));
}

}  // namespace
}  // namespace gsv::formats
