// Worlds like those of gz-sim's integration tests, read from SDFormat, and the values that these
// expect (gazebosim/gz-sim, test/integration). The worlds' texts are our own.
#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/base/test_within.h"
#include "gsv/formats/sdf_reader.h"
#include "gsv/geometry/constants.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::simulation::gazebo {
namespace {

using geometry::kPi;
using geometry::Pose;
using geometry::Vector3;

constexpr const char* kGround =
    "<model name='ground'><static>true</static><link name='l'><collision name='c'><geometry><plane>"
    "<normal>0 0 1</normal><size>100 100</size></plane></geometry></collision></link></model>";

std::string Box(const std::string& size) {
  return "<geometry><box><size>" + size + "</size></box></geometry>";
}
std::string Sphere(const std::string& radius) {
  return "<geometry><sphere><radius>" + radius + "</radius></sphere></geometry>";
}
std::string Inertial(const std::string& mass, const std::string& moments) {
  return "<inertial><mass>" + mass + "</mass><inertia>" + moments + "</inertia></inertial>";
}
std::string Moments(const std::string& x, const std::string& y, const std::string& z) {
  return "<ixx>" + x + "</ixx><iyy>" + y + "</iyy><izz>" + z + "</izz>";
}

class GazeboValues : public ::testing::Test {
 protected:
  // Starts a world at rest, paused at its beginning.
  void Start(const std::string& content, const std::string& settings = "") {
    const auto file = folder_.Write(
        "w.sdf",
        "<sdf version='1.9' xmlns:gsv='https://gsv/'><world name='w'><physics name='p' "
        "type='ignored'><max_step_size>0.001</max_step_size></physics>" +
            settings + content + "</world></sdf>");
    base::Problems problems;
    auto world = formats::ModelLibrary().ReadWorld(file, problems);
    ASSERT_TRUE(world) << world.error().Sentence();
    Specification specification;
    specification.world = std::make_shared<model::WorldDescription>(*std::move(world));
    specification.mode = Mode::kLockstep;
    specification.duration = 60s;
    simulation_ = Make(std::move(specification));
  }

  void RunUntil(SimTime time) {
    ASSERT_TRUE(simulation_->RunUntil(time));
    ASSERT_EQ(simulation_->WaitForPhase({Phase::kPaused}, 20s), Phase::kPaused);
  }

  Pose At(const std::string& name) const { return PoseOf(*simulation_, name); }
  world::BodyState StateOf(const std::string& name) const {
    const auto snapshot = simulation_->snapshot();
    return snapshot->state.bodies.at(static_cast<std::size_t>(snapshot->layout->Find(name)));
  }
  double Joint(const std::string& body, int joint, bool velocity = false) const {
    const auto snapshot = simulation_->snapshot();
    const world::Body& of =
        snapshot->layout->bodies.at(static_cast<std::size_t>(snapshot->layout->Find(body)));
    const auto index = static_cast<std::size_t>(of.first_joint + joint);
    return velocity ? snapshot->state.joint_velocities.at(index)
                    : snapshot->state.joint_positions.at(index);
  }
  std::vector<double> Read(const std::string& robot, const std::string& sensor) {
    const auto reading = simulation_->Watch(robot, sensor);
    EXPECT_TRUE(reading) << (reading ? "" : reading.error().Sentence());
    if (!reading) return std::vector<double>(10, 1e9);
    return {reading->values.begin(), reading->values.end()};
  }

  base::testing::TestFolder folder_;
  std::shared_ptr<Simulation> simulation_;
};

TEST_F(GazeboValues, ASphereFallsAndComesToRest) {
  // The link is 5 m above the model's origin, and of 1 m radius: it rests with the origin at -4 m.
  Start(std::string(kGround) +
        "<model name='ball'><pose>0 0 2 0 0 0</pose><link name='l'><pose>0 0 5 0 0 0</pose>" +
        Inertial("1", Moments("0.4", "0.4", "0.4")) + "<collision name='c'>" + Sphere("1") +
        "</collision></link></model>");
  RunUntil(10ms);
  EXPECT_WITHIN(At("ball").position.z, 2 - 9.8 * 0.01 * 0.01 / 2, 2e-4, "m");
  RunUntil(2s);
  EXPECT_WITHIN(At("ball").position.z, -4, 0.05, "m");
}

TEST_F(GazeboValues, BoxesSlideDownAnInclineAsTheirFrictionLetsThem) {
  // Down -y by 30 degrees.
  std::string content =
      "<model name='slope'><static>1</static><pose>0 0 0 -0.52359878 0 0</pose><link name='l'>"
      "<collision name='c'><geometry><plane><normal>0 0 1</normal><size>100 100</size></plane>"
      "</geometry></collision></link></model>";
  const std::vector<std::string> frictions{"0.01", "0.1", "1.0"};
  for (std::size_t i = 0; i < frictions.size(); ++i) {
    content += "<model name='box" + std::to_string(i) + "'><pose>" + std::to_string(2 * i) +
               " -0.8660254 0.5 -0.52359878 0 0</pose><link name='l'><pose>0 0 0.5 0 0 0</pose>" +
               Inertial("60", Moments("10", "10", "10")) + "<collision name='c'>" + Box("1 1 1") +
               "<surface><friction><ode><mu>" + frictions[i] +
               "</mu></ode></friction></surface></collision></link></model>";
  }
  Start(content);
  std::vector<Vector3> start;
  for (int i = 0; i < 3; ++i) start.push_back(At("box" + std::to_string(i)).position);
  RunUntil(1s);
  const double angle = 0.52359878;
  for (std::size_t i = 0; i < 3; ++i) {
    const double mu = std::stod(frictions[i]);
    const double a = std::max(0.0, 9.8 * (std::sin(angle) - mu * std::cos(angle)));
    const Vector3 moved = At("box" + std::to_string(i)).position - start[i];
    EXPECT_WITHIN(Norm(moved), a / 2, 0.015, "m") << mu;
    EXPECT_WITHIN(moved.x, 0, 1e-3, "m") << mu;
  }
}

TEST_F(GazeboValues, AJointTurnsAtItsInitialVelocity) {
  Start(std::string(kGround) + "<model name='m'><pose>0 0 0.005 0 0 0</pose><link name='base'>" +
        Inertial("120", Moments("2.5", "2.5", "5")) + "<collision name='c'>" + Box("0.5 0.5 0.01") +
        "</collision></link><link name='rotor'><pose>0 0 1 0 0 0</pose>" +
        Inertial("0.6", Moments("0.032", "0.032", "0.00012")) + "<collision name='c'>" +
        Box("0.25 0.25 0.05") +
        "</collision></link><joint name='j' type='revolute'><pose>0 0 -0.5 0 0 0</pose><parent>base"
        "</parent><child>rotor</child><axis><xyz>0 0 1</xyz></axis></joint><plugin filename="
        "'gz-sim-joint-controller-system' name='gz::sim::systems::JointController'><joint_name>j"
        "</joint_name><initial_velocity>5</initial_velocity></plugin></model>");
  RunUntil(100ms);
  EXPECT_WITHIN(Joint("m", 0, true), 5, 1e-2, "rad/s");
}

TEST_F(GazeboValues, AnArmKeepsItsDistanceFromItsJoint) {
  // A rod that starts 30 degrees off the vertical and swings about x, 0.15 m from its joint.
  Start(std::string(kGround) + "<model name='m'><pose>0 0 0.005 0 0 0</pose><link name='base'>" +
        Inertial("120", Moments("2.5", "2.5", "5")) + "<collision name='c'>" + Box("0.5 0.5 0.01") +
        "</collision></link><link name='arm'><pose>0.04 -0.075 0.53 0.5236 0 0</pose>" +
        Inertial("0.6", Moments("0.032", "0.032", "0.00012")) +
        "</link><joint name='j' type='revolute'><pose>0 0 -0.15 0 0 0</pose><parent>base</parent>"
        "<child>arm</child><axis><xyz>1 0 0</xyz></axis></joint></model>");
  double least = 10, most = -10;
  for (int i = 1; i <= 20; ++i) {
    RunUntil(i * 50ms);
    least = std::min(least, Joint("m", 0));
    most = std::max(most, Joint("m", 0));
    // In joint coordinates the arm cannot stretch; the base must not move under it.
    EXPECT_WITHIN(Norm(At("m").position - Vector3{0, 0, 0.005}), 0, 1e-3, "m");
  }
  EXPECT_GT(most - least, 0.5);
}

// A robot of one box that its sensors ride on, which forces move.
std::string Carrier(const std::string& pose, const std::string& sensor) {
  return "<model name='robot'><pose>" + pose +
         "</pose><gsv:movement>rigid</gsv:movement><link name='l'><pose>0.05 0.05 0.05 0 0 "
         "0</pose>" +
         Inertial("0.1", Moments("0.000166667", "0.000166667", "0.000166667")) +
         "<collision name='c'>" + Box("0.1 0.1 0.1") + "</collision><sensor name='s' " + sensor +
         "</sensor></link><plugin filename='gz-sim-velocity-control-system' "
         "name='gz::sim::systems::VelocityControl'/></model>";
}

TEST_F(GazeboValues, AnAltimeterFallsAndRests) {
  Start(kGround + Carrier("4 0 3 0 0 3.14", "type='altimeter'>"));
  RunUntil(100ms);
  EXPECT_LT(Read("robot", "s")[0], 0);
  EXPECT_LT(Read("robot", "s")[1], 0);
  RunUntil(1100ms);
  // The link's middle is 5 cm above the model's origin.
  EXPECT_WITHIN(At("robot").position.z + 0.05, 0.05, 0.01, "m");
  EXPECT_LT(Read("robot", "s")[0], -2.99);
  EXPECT_WITHIN(Read("robot", "s")[1], 0, 1e-3, "m/s");
}

TEST_F(GazeboValues, AnImuFeelsNothingFallingAndGravityAtRest) {
  Start(kGround + Carrier("4 0 3 0 0 3.14", "type='imu'>"), "<gravity>0 0 -5</gravity>");
  RunUntil(200ms);
  EXPECT_WITHIN(Read("robot", "s")[5], 0, 1e-2, "m/s²");
  RunUntil(2s);
  EXPECT_WITHIN(Read("robot", "s")[5], 5, 1e-2, "m/s²");
  EXPECT_WITHIN(Read("robot", "s")[3], 0, 1e-2, "m/s²");
}

TEST_F(GazeboValues, AMagnetometerTurnsTheField) {
  Start(kGround + Carrier("4 0 3 0 0 1.57", "type='magnetometer'>"),
        "<magnetic_field>0.94 0.76 -0.12</magnetic_field>");
  RunUntil(200ms);
  const Vector3 expected = Inverse(At("robot").orientation) * Vector3{0.94, 0.76, -0.12};
  const auto field = Read("robot", "s");
  EXPECT_WITHIN(field[0], expected.x, 1e-3, "T");
  EXPECT_WITHIN(field[1], expected.y, 1e-3, "T");
  EXPECT_WITHIN(field[2], expected.z, 1e-3, "T");
}

TEST_F(GazeboValues, ANavsatKnowsWhereItsWorldLies) {
  Start(kGround + Carrier("0 0 0 0 0 0", "type='navsat'>"),
        "<spherical_coordinates><surface_model>EARTH_WGS84</surface_model><world_frame_orientation>"
        "ENU</world_frame_orientation><latitude_deg>-22.9</latitude_deg><longitude_deg>-43.2"
        "</longitude_deg><elevation>0</elevation><heading_deg>0</heading_deg>"
        "</spherical_coordinates>");
  RunUntil(200ms);
  EXPECT_WITHIN(Read("robot", "s")[0], -22.9, 1e-4, "°");
  EXPECT_WITHIN(Read("robot", "s")[1], -43.2, 1e-4, "°");
}

TEST_F(GazeboValues, ADifferentialDriveKeepsItsLimitsAndKnowsWhereItIs) {
  const auto wheel = [](const std::string& side, const std::string& y) {
    return "<link name='" + side + "'><pose>0.554283 " + y + " -0.025 -1.5707963 0 0</pose>" +
           Inertial("2", Moments("0.1458", "0.1458", "0.125")) + "<collision name='c'>" +
           Sphere("0.3") + "</collision></link><joint name='" + side +
           "_joint' type='revolute'><parent>chassis</parent><child>" + side +
           "</child><axis><xyz>0 0 1</xyz><limit><lower>-1e308</lower><upper>1e308</upper></limit>"
           "</axis></joint>";
  };
  Start(std::string(kGround) +
        "<model name='car'><pose>0 0 0.325 0 0 0</pose><link name='chassis'>"
        "<pose>-0.151427 0 0.175 0 0 0</pose>" +
        Inertial("1.14395", Moments("0.126", "0.416", "0.481")) + "<collision name='c'>" +
        Box("2.01142 1 0.568726") + "</collision></link>" + wheel("left", "0.625029") +
        wheel("right", "-0.625029") + "<link name='caster'><pose>-0.957138 0 -0.125 0 0 0</pose>" +
        Inertial("1", Moments("0.1", "0.1", "0.1")) + "<collision name='c'>" + Sphere("0.2") +
        "</collision></link><joint name='caster_joint' type='ball'><parent>chassis</parent><child>"
        "caster</child></joint><plugin filename='gz-sim-diff-drive-system' "
        "name='gz::sim::systems::DiffDrive'><left_joint>left_joint</left_joint><right_joint>"
        "right_joint</right_joint><wheel_separation>1.25</wheel_separation><wheel_radius>0.3"
        "</wheel_radius><max_linear_acceleration>1</max_linear_acceleration>"
        "<min_linear_acceleration>-1</min_linear_acceleration><max_angular_acceleration>2"
        "</max_angular_acceleration><min_angular_acceleration>-2</min_angular_acceleration>"
        "<max_linear_velocity>0.5</max_linear_velocity><min_linear_velocity>-0.5"
        "</min_linear_velocity><max_angular_velocity>1</max_angular_velocity>"
        "<min_angular_velocity>-1</min_angular_velocity></plugin></model>");
  auto behaviour = std::make_shared<ThreadBehaviour>([](Agent& agent, ClockId clock) {
    do {
      (void)agent.Command({10.5, 0, 0.2});
    } while (SleepFor(agent, clock, 20ms));
  });
  ASSERT_TRUE(simulation_->SetBehaviour("car", behaviour));
  RunUntil(3s);
  const world::BodyState state = StateOf("car");
  EXPECT_WITHIN(state.drive.actual.linear, 0.5, 1e-9, "m/s");
  EXPECT_WITHIN(state.drive.actual.angular, 0.2, 1e-9, "rad/s");
  // The odometry is that of the wheels' axle: half a second to get going, of a path along an arc.
  const Pose car_from_axle{{0.554283, 0, -0.325}, {}};
  const Pose moved = At("car") * car_from_axle;
  const Pose start = Pose{{0, 0, 0.325}, {}} * car_from_axle;
  double x = 0, y = 0, yaw = 0;
  for (double time = 0; time < 3; time += 1e-4) {
    yaw += 1e-4 * std::min(0.2, 2 * time);
    x += 1e-4 * std::min(0.5, time) * std::cos(yaw);
    y += 1e-4 * std::min(0.5, time) * std::sin(yaw);
  }
  EXPECT_WITHIN(moved.position.x - start.position.x, x, 0.01, "m");
  EXPECT_WITHIN(moved.position.y - start.position.y, y, 0.01, "m");
  EXPECT_WITHIN(geometry::Yaw(moved.orientation), yaw, 0.01, "rad");
}

}  // namespace
}  // namespace gsv::simulation::gazebo
