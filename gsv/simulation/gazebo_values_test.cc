// Compares worlds like those of gz-sim's integration tests (gazebosim/gz-sim, test/integration)
// with the values that those tests expect. The SDFormat texts were written for this test.
#include <set>

#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/base/test_within.h"
#include "gsv/formats/sdf_reader.h"
#include "gsv/formats/testing/real_folder.h"
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
  // Creates a simulation of a world with this content. It does not run before RunUntil().
  void Start(const std::string& content, const std::string& settings = "") {
    const auto file = folder_.Write(
        "w.sdf",
        "<sdf version='1.9' xmlns:gsv='https://gsv/'><world name='w'><physics name='p' "
        "type='ignored'><max_step_size>0.001</max_step_size></physics>" +
            settings + content + "</world></sdf>");
    StartFile(file);
  }

  void StartFile(const std::filesystem::path& file) {
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

  // Expects four contact points, at which two spheres rest on the edges of two boxes.
  void ExpectFourCorners(const std::string& robot, const std::string& sensor) {
    const std::vector<double> touches = Read(robot, sensor);
    ASSERT_EQ(touches.size(), 4 * 11u);
    std::set<std::pair<double, double>> corners;
    for (std::size_t i = 0; i < touches.size(); i += 11) {
      const Vector3 point = At(robot) * Vector3{touches[i], touches[i + 1], touches[i + 2]};
      EXPECT_WITHIN(std::abs(point.x), 0.25, 0.05, "m");
      EXPECT_WITHIN(std::abs(point.y), 1, 0.05, "m");
      EXPECT_WITHIN(point.z, 1, 0.05, "m");
      corners.insert({std::copysign(1, point.x), std::copysign(1, point.y)});
    }
    EXPECT_EQ(corners.size(), 4u);
  }

  base::testing::TestFolder folder_;
  std::shared_ptr<Simulation> simulation_;
};

TEST_F(GazeboValues, SphereFallsAndComesToRest) {
  // The link is a sphere of 1 m radius, 5 m above the model's origin. When it rests on the ground,
  // the origin is at -4 m.
  Start(std::string(kGround) +
        "<model name='ball'><pose>0 0 2 0 0 0</pose><link name='l'><pose>0 0 5 0 0 0</pose>" +
        Inertial("1", Moments("0.4", "0.4", "0.4")) + "<collision name='c'>" + Sphere("1") +
        "</collision></link></model>");
  RunUntil(10ms);
  EXPECT_WITHIN(At("ball").position.z, 2 - 9.8 * 0.01 * 0.01 / 2, 2e-4, "m");
  RunUntil(2s);
  EXPECT_WITHIN(At("ball").position.z, -4, 0.05, "m");
}

TEST_F(GazeboValues, BoxesSlideDownAnInclineAccordingToTheirFriction) {
  // The plane is inclined by 30 degrees and goes down along +y.
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

TEST_F(GazeboValues, ArmKeepsItsDistanceFromItsJoint) {
  // A rod starts 30 degrees off the vertical and swings about x, 0.15 m from its joint.
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
    // The engine uses joint coordinates, so the arm cannot stretch. The base must not move.
    EXPECT_WITHIN(Norm(At("m").position - Vector3{0, 0, 0.005}), 0, 1e-3, "m");
  }
  EXPECT_GT(most - least, 0.5);
}

// A robot that is one box with a sensor, and moves by rigid-body dynamics.
std::string Carrier(const std::string& pose, const std::string& sensor) {
  return "<model name='robot'><pose>" + pose +
         "</pose><gsv:movement>rigid</gsv:movement><link name='l'><pose>0.05 0.05 0.05 0 0 "
         "0</pose>" +
         Inertial("0.1", Moments("0.000166667", "0.000166667", "0.000166667")) +
         "<collision name='c'>" + Box("0.1 0.1 0.1") + "</collision><sensor name='s' " + sensor +
         "</sensor></link><plugin filename='gz-sim-velocity-control-system' "
         "name='gz::sim::systems::VelocityControl'/></model>";
}

TEST_F(GazeboValues, VelocityControlMovesARigidBaseAsCommanded) {
  // A box without wheels is driven on ground with a friction coefficient of 1. Friction must not
  // stop the box, and the box must not tip over.
  Start(kGround + Carrier("0 0 0 0 0 1", "type='imu'>"));
  ASSERT_TRUE(simulation_->SetBehaviour(
      "robot", std::make_shared<ThreadBehaviour>([](Agent& agent, ClockId clock) {
        (void)agent.Command({0.3, 0, 0});
        if (!SleepFor(agent, clock, 4s)) return;
        (void)agent.Command({0, 0, 0.5});
        (void)SleepFor(agent, clock, 4s);
      })));
  RunUntil(500ms);
  const Pose start = At("robot");
  RunUntil(3500ms);
  const Pose ahead = Inverse(start) * At("robot");
  EXPECT_WITHIN(ahead.position.x, 0.3 * 3, 1e-3, "m");
  EXPECT_WITHIN(ahead.position.y, 0, 1e-3, "m");
  EXPECT_WITHIN(ahead.position.z, 0, 1e-3, "m");
  RunUntil(4500ms);
  const double yaw = geometry::Yaw(At("robot").orientation);
  RunUntil(7500ms);
  EXPECT_WITHIN(geometry::Yaw(At("robot").orientation) - yaw, 0.5 * 3, 1e-3, "rad");
  const Vector3 up = At("robot").orientation * Vector3{0, 0, 1};
  EXPECT_WITHIN(std::acos(std::min(up.z, 1.0)), 0, 1e-3, "rad");
}

TEST_F(GazeboValues, IncludedActorWalksItsTrajectory) {
  std::filesystem::create_directories(folder_.path() / "walker");
  folder_.Write("walker/model.config",
                "<model><name>walker</name><sdf version='1.6'>model.sdf</sdf></model>");
  folder_.Write(
      "walker/model.sdf",
      "<sdf version='1.6'><actor name='walker'><script><loop>true</loop><trajectory id='0' "
      "type='walk'><waypoint><time>0</time><pose>0 0 1 0 0 0</pose></waypoint><waypoint>"
      "<time>2</time><pose>2 0 1 0 0 0</pose></waypoint></trajectory></script></actor>"
      "</sdf>");
  Start(std::string(kGround) +
        "<include><uri>model://walker</uri><name>guide</name><pose>0 5 0 0 0 0</pose></include>");
  for (const SimTime time : {SimTime(500ms), SimTime(1s), SimTime(1500ms), SimTime(2500ms)}) {
    RunUntil(time);
    // Gazebo's spline: the tangent at each waypoint is half of the vector to the other waypoint.
    const double u = std::fmod(base::ToSeconds(time), 2) / 2;  // the script loops after 2 s
    EXPECT_WITHIN(At("guide").position.x, u + 3 * u * u - 2 * u * u * u, 1e-6, "m") << u;
    EXPECT_WITHIN(At("guide").position.y, 5, 1e-6, "m");
  }
}

TEST_F(GazeboValues, AltimeterReadsTheHeightOfAFallingBody) {
  Start(kGround + Carrier("4 0 3 0 0 3.14", "type='altimeter'>"));
  RunUntil(100ms);
  EXPECT_LT(Read("robot", "s")[0], 0);
  EXPECT_LT(Read("robot", "s")[1], 0);
  RunUntil(1100ms);
  // The link's centre is 5 cm above the model's origin.
  EXPECT_WITHIN(At("robot").position.z + 0.05, 0.05, 0.01, "m");
  EXPECT_LT(Read("robot", "s")[0], -2.99);
  EXPECT_WITHIN(Read("robot", "s")[1], 0, 1e-3, "m/s");
}

TEST_F(GazeboValues, ImuReadsZeroInFreeFallAndGravityAtRest) {
  Start(kGround + Carrier("4 0 3 0 0 3.14", "type='imu'>"), "<gravity>0 0 -5</gravity>");
  RunUntil(200ms);
  EXPECT_WITHIN(Read("robot", "s")[5], 0, 1e-2, "m/s²");
  RunUntil(2s);
  EXPECT_WITHIN(Read("robot", "s")[5], 5, 1e-2, "m/s²");
  EXPECT_WITHIN(Read("robot", "s")[3], 0, 1e-2, "m/s²");
}

TEST_F(GazeboValues, MagnetometerRotatesTheFieldIntoItsFrame) {
  Start(kGround + Carrier("4 0 3 0 0 1.57", "type='magnetometer'>"),
        "<magnetic_field>0.94 0.76 -0.12</magnetic_field>");
  RunUntil(200ms);
  const Vector3 expected = Inverse(At("robot").orientation) * Vector3{0.94, 0.76, -0.12};
  const auto field = Read("robot", "s");
  EXPECT_WITHIN(field[0], expected.x, 1e-3, "T");
  EXPECT_WITHIN(field[1], expected.y, 1e-3, "T");
  EXPECT_WITHIN(field[2], expected.z, 1e-3, "T");
}

TEST_F(GazeboValues, NavsatReadsTheGeographicOriginOfTheWorld) {
  Start(kGround + Carrier("0 0 0 0 0 0", "type='navsat'>"),
        "<spherical_coordinates><surface_model>EARTH_WGS84</surface_model><world_frame_orientation>"
        "ENU</world_frame_orientation><latitude_deg>-22.9</latitude_deg><longitude_deg>-43.2"
        "</longitude_deg><elevation>0</elevation><heading_deg>0</heading_deg>"
        "</spherical_coordinates>");
  RunUntil(200ms);
  EXPECT_WITHIN(Read("robot", "s")[0], -22.9, 1e-4, "°");
  EXPECT_WITHIN(Read("robot", "s")[1], -43.2, 1e-4, "°");
}

// A car with two driven wheels in front and a caster, and an odometer of 50 Hz.
std::string Car(const std::string& movement) {
  const auto wheel = [](const std::string& side, const std::string& y) {
    return "<link name='" + side + "'><pose>0.554283 " + y + " -0.025 -1.5707963 0 0</pose>" +
           Inertial("2", Moments("0.1458", "0.1458", "0.125")) + "<collision name='c'>" +
           Sphere("0.3") + "</collision></link><joint name='" + side +
           "_joint' type='revolute'><parent>chassis</parent><child>" + side +
           "</child><axis><xyz>0 0 1</xyz><limit><lower>-1e308</lower><upper>1e308</upper></limit>"
           "</axis></joint>";
  };
  return "<model name='car'><pose>0 0 0.325 0 0 0</pose><gsv:movement>" + movement +
         "</gsv:movement><link name='chassis'><pose>-0.151427 0 0.175 0 0 0</pose>" +
         Inertial("1.14395", Moments("0.126", "0.416", "0.481")) + "<collision name='c'>" +
         Box("2.01142 1 0.568726") +
         "</collision><sensor name='odometer' type='odometry'><update_rate>50</update_rate>"
         "</sensor></link>" +
         wheel("left", "0.625029") + wheel("right", "-0.625029") +
         "<link name='caster'><pose>-0.957138 0 -0.125 0 0 0</pose>" +
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
         "<min_angular_velocity>-1</min_angular_velocity></plugin></model>";
}

class GazeboCar : public GazeboValues, public ::testing::WithParamInterface<const char*> {};

TEST_P(GazeboCar, RespectsItsLimitsAndReportsItsOdometry) {
  Start(std::string(kGround) + Car(GetParam()));
  auto behaviour = std::make_shared<ThreadBehaviour>([](Agent& agent, ClockId clock) {
    do {
      (void)agent.Command({10.5, 0, 0.2});
    } while (SleepFor(agent, clock, 20ms));
  });
  ASSERT_TRUE(simulation_->SetBehaviour("car", behaviour));
  // The odometry describes the point halfway between the wheels.
  const Pose car_from_axle{{0.554283, 0, -0.325}, {}};
  const Pose start_from_world = Inverse(At("car") * car_from_axle);
  std::set<SimTime> samples;
  std::vector<double> odometry;
  for (SimTime time = 10ms; time <= 3s; time += 10ms) {
    RunUntil(time);
    EXPECT_LE(std::abs(StateOf("car").drive.actual.linear), 0.5 + 1e-9);
    const auto reading = simulation_->Watch("car", "odometer");
    ASSERT_TRUE(reading);
    samples.insert(reading->time);
    odometry.assign(reading->values.begin(), reading->values.end());
    EXPECT_LE(std::abs(odometry[3]), 0.5 + 1e-9);
  }
  EXPECT_EQ(samples.size(), 151u);  // one sample each at 0 s, 0.02 s, ..., 3 s
  const world::BodyState state = StateOf("car");
  EXPECT_WITHIN(state.drive.actual.linear, 0.5, 1e-9, "m/s");
  EXPECT_WITHIN(state.drive.actual.angular, 0.2, 1e-9, "rad/s");
  // The car accelerates for half a second. Its path is an arc.
  const Pose moved = start_from_world * (At("car") * car_from_axle);
  double x = 0, y = 0, yaw = 0;
  for (double time = 0; time < 3; time += 1e-4) {
    yaw += 1e-4 * std::min(0.2, 2 * time);
    x += 1e-4 * std::min(0.5, time) * std::cos(yaw);
    y += 1e-4 * std::min(0.5, time) * std::sin(yaw);
  }
  EXPECT_WITHIN(moved.position.x, x, 0.01, "m");
  EXPECT_WITHIN(moved.position.y, y, 0.01, "m");
  EXPECT_WITHIN(geometry::Yaw(moved.orientation), yaw, 0.01, "rad");
  EXPECT_WITHIN(moved.position.x, odometry[0], 0.01, "m");
  EXPECT_WITHIN(moved.position.y, odometry[1], 0.01, "m");
  EXPECT_WITHIN(geometry::Yaw(moved.orientation), odometry[2], 0.01, "rad");
}

INSTANTIATE_TEST_SUITE_P(Movements, GazeboCar, ::testing::Values("planar", "rigid"));

TEST_F(GazeboValues, ContactSensorReadsEachContactPoint) {
  // A link of two spheres falls onto the edges of two boxes, which are 0.5 m apart.
  const auto box = [](const std::string& name, const std::string& x) {
    return "<model name='" + name + "'><static>1</static><pose>" + x +
           " 0 0.5 0 0 0</pose><link name='l'><collision name='c'>" + Box("1 4 1") +
           "</collision></link></model>";
  };
  const auto sphere = [](const std::string& name, const std::string& y) {
    return "<collision name='" + name + "'><pose>0 " + y + " 0 0 0 0</pose>" + Sphere("0.5") +
           "</collision>";
  };
  Start(box("left", "-0.75") + box("right", "0.75") +
        "<model name='dumbbell'><pose>0 0 3 0 0 0</pose><link name='l'>" + sphere("a", "1") +
        sphere("b", "-1") +
        "<sensor name='s' type='contact'><contact><collision>a</collision><collision>b</collision>"
        "</contact><update_rate>1000</update_rate></sensor></link></model>");
  EXPECT_THAT(Read("dumbbell", "s"), ::testing::IsEmpty());
  for (const SimTime time : {SimTime(1s), SimTime(2s), SimTime(5s)}) {
    RunUntil(time);
    ExpectFourCorners("dumbbell", "s");
    // Both edges stop the link at the same time, so it does not rotate.
    EXPECT_WITHIN(At("dumbbell").position.z, 1 + std::sqrt(0.5 * 0.5 - 0.25 * 0.25), 1e-3, "m");
    EXPECT_WITHIN(At("dumbbell").orientation.y, 0, 1e-3, "rad");
  }
}

// The original worlds of gz-sim. Their folder must be beside the folder of real_files_test. If it
// is absent, the tests are skipped.
class GazeboOriginals : public GazeboValues {
 protected:
  void StartOriginal(const std::string& name) {
    const auto file = formats::RealFolder().parent_path() / "checks" / "gz_sim" / name;
    if (formats::RealFolder().empty() || !std::filesystem::exists(file)) {
      GTEST_SKIP() << "no " << name << " in checks/gz_sim beside the folder in GSV_REAL_DIR";
    }
    StartFile(file);
  }
};

TEST_F(GazeboOriginals, AltimeterEqualsGazebo) {
  StartOriginal("altimeter.sdf");
  if (IsSkipped()) return;
  RunUntil(100ms);
  EXPECT_LT(Read("altimeter_model", "altimeter_sensor")[0], 0);
  EXPECT_LT(Read("altimeter_model", "altimeter_sensor")[1], 0);
  RunUntil(1100ms);
  EXPECT_WITHIN(At("altimeter_model").position.z + 0.05, 0.05, 0.01, "m");
  EXPECT_WITHIN(Read("altimeter_model", "altimeter_sensor")[0], -3, 0.01, "m");
  EXPECT_WITHIN(Read("altimeter_model", "altimeter_sensor")[1], 0, 1e-3, "m/s");
}

TEST_F(GazeboOriginals, ImuEqualsGazebo) {
  StartOriginal("imu.sdf");
  if (IsSkipped()) return;
  RunUntil(200ms);
  EXPECT_WITHIN(Read("imu_model", "imu_sensor")[5], 0, 1e-2, "m/s²");
  RunUntil(3s);
  EXPECT_WITHIN(Read("imu_model", "imu_sensor")[5], 5, 1e-2, "m/s²");
}

TEST_F(GazeboOriginals, ContactSensorEqualsGazebo) {
  StartOriginal("contact.sdf");
  if (IsSkipped()) return;
  RunUntil(2s);
  ExpectFourCorners("contact_model", "sensor_contact");
}

TEST_F(GazeboOriginals, FallingBodyEqualsGazebo) {
  StartOriginal("falling.sdf");
  if (IsSkipped()) return;
  RunUntil(10ms);
  EXPECT_WITHIN(At("sphere").position.z, 2 - 9.8 * 0.01 * 0.01 / 2, 2e-4, "m");
  RunUntil(2s);
  EXPECT_WITHIN(At("sphere").position.z, -4, 0.05, "m");
}

TEST_F(GazeboOriginals, JointControllerEqualsGazebo) {
  StartOriginal("joint_controller.sdf");
  if (IsSkipped()) return;
  RunUntil(100ms);
  EXPECT_WITHIN(Joint("joint_controller_test", 0, true), 5, 1e-2, "rad/s");
}

TEST_F(GazeboOriginals, DifferentialDriveEqualsGazebo) {
  StartOriginal("diff_drive.sdf");
  if (IsSkipped()) return;
  auto behaviour = std::make_shared<ThreadBehaviour>([](Agent& agent, ClockId clock) {
    do {
      (void)agent.Command({10.5, 0, 0.2});
    } while (SleepFor(agent, clock, 20ms));
  });
  ASSERT_TRUE(simulation_->SetBehaviour("vehicle", behaviour));
  const Pose vehicle_from_axle{{0.554283, 0, -0.325}, {}};
  const Pose start_from_world = Inverse(At("vehicle") * vehicle_from_axle);
  for (SimTime time = 20ms; time <= 3s; time += 20ms) {
    RunUntil(time);
    EXPECT_LE(std::abs(StateOf("vehicle").drive.actual.linear), 0.5 + 1e-9);
  }
  const Pose moved = start_from_world * (At("vehicle") * vehicle_from_axle);
  const world::Odometry odometry = StateOf("vehicle").odometry;
  EXPECT_WITHIN(moved.position.x, odometry.place.x, 0.01, "m");
  EXPECT_WITHIN(moved.position.y, odometry.place.y, 0.01, "m");
  EXPECT_WITHIN(geometry::Yaw(moved.orientation),
                std::atan2(odometry.place.sine, odometry.place.cosine), 0.01, "rad");
}

// A scale with a plate of 0.2 kg on a sensor, as in gz-sim's test, with a weight of 10 kg on the
// plate.
TEST_F(GazeboValues, ForceTorqueSensorReadsTheWeightOnAScale) {
  const auto scale = [](const std::string& type) {
    return "<model name='scale'><link name='base'><pose>0 0 0.05 0 0 0</pose>" +
           Inertial("5", Moments("0.1", "0.1", "0.2")) + "<collision name='c'>" +
           Box("0.6 0.6 0.1") +
           "</collision></link><link name='plate'><pose>0 0 0.125 0 0 0</pose>" +
           Inertial("0.2", Moments("0.003", "0.003", "0.006")) + "<collision name='c'>" +
           Box("0.4 0.4 0.05") + "</collision></link><joint name='load_cell' type='" + type +
           "'><parent>base</parent><child>plate</child><axis><xyz>0 0 1</xyz><limit><lower>0"
           "</lower><upper>0</upper></limit></axis><sensor name='s' type='force_torque'>"
           "<force_torque><frame>child</frame><measure_direction>child_to_parent"
           "</measure_direction></force_torque></sensor></joint></model>";
  };
  const std::string weight = "<model name='weight'><pose>0.05 0 0.25 0 0 0</pose><link name='l'>" +
                             Inertial("10", Moments("0.07", "0.07", "0.07")) +
                             "<collision name='c'>" + Box("0.2 0.2 0.2") +
                             "</collision></link></model>";
  for (const std::string type : {"fixed", "prismatic"}) {
    Start(std::string(kGround) + scale(type) + weight);
    RunUntil(2s);
    const std::vector<double> wrench = Read("scale", "s");
    // The engine keeps the pose of a body whose acceleration is at most 0.1 m/s². So forces may be
    // wrong by the force for this acceleration.
    const double force = 0.1 * 10.2, arm = 0.15;
    EXPECT_WITHIN(wrench[0], 0, force, "N") << type;
    EXPECT_WITHIN(wrench[1], 0, force, "N") << type;
    EXPECT_WITHIN(wrench[2], -9.8 * 10.2, force, "N") << type;
    EXPECT_WITHIN(wrench[3], 0, force * arm, "N m") << type;
    EXPECT_WITHIN(wrench[4], 9.8 * 10 * 0.05, force * arm, "N m") << type;
  }
}

// A controller holds the joint of an arm of 2 kg. Another arm spins freely about the vertical.
TEST_F(GazeboValues, ForceTorqueSensorReadsTheLoadOfAnArm) {
  const auto arm = [](const std::string& name, const std::string& pose, const std::string& plugin) {
    return "<model name='" + name + "'><pose>" + pose +
           "</pose><link name='l'><inertial><pose>0.5 0 0 0 0 0</pose><mass>2</mass><inertia>" +
           Moments("0.01", "0.01", "0.01") + "</inertia></inertial><collision name='c'>" +
           Sphere("0.05") +
           "</collision></link><joint name='j' type='revolute'><parent>world</parent>"
           "<child>l</child><axis><xyz>0 1 0</xyz></axis><sensor name='s' type='force_torque'>"
           "<force_torque><measure_direction>parent_to_child</measure_direction></force_torque>"
           "</sensor></joint>" +
           plugin + "</model>";
  };
  Start(arm("held", "0 0 2 0 0 0",
            "<plugin filename='gz-sim-joint-position-controller-system' "
            "name='gz::sim::systems::JointPositionController'><joint_name>j</joint_name>"
            "</plugin>") +
        arm("spun", "0 3 2 1.5707963 0 0",
            "<plugin filename='gz-sim-joint-controller-system' "
            "name='gz::sim::systems::JointController'><joint_name>j</joint_name>"
            "<initial_velocity>3</initial_velocity></plugin>"));
  RunUntil(2s);
  const std::vector<double> held = Read("held", "s");
  EXPECT_WITHIN(held[2], 2 * 9.8, 0.01, "N");
  EXPECT_WITHIN(held[4], -2 * 9.8 * 0.5, 0.01, "N m");
  const std::vector<double> spun = Read("spun", "s");
  EXPECT_WITHIN(spun[0], -2 * 3 * 3 * 0.5, 0.01, "N");
}

}  // namespace
}  // namespace gsv::simulation::gazebo
