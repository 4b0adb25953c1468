// Tests the head of rover4: a behaviour turns the camera by the joints.
#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <gtest/gtest.h>

#include "gsv/formats/sdf_reader.h"
#include "gsv/hosting/hosted_behaviour.h"
#include "gsv/rendering/cameras/camera_sensor.h"
#include "gsv/rendering/testing/test_scene.h"
#include "gsv/sensing/devices/built_in.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv {
namespace {

using geometry::Pose;
using geometry::Vector3;

constexpr double kPan = 0.7, kTilt = 0.3;
// The angle in rad by which the camera points down from its bracket.
constexpr double kMounting = 0.1;

class Looks final : public Behaviour {
 public:
  explicit Looks(std::vector<double>& reached) : reached_(reached) {}

  base::Status Init(Robot& robot) override {
    for (auto& [name, joint] : {std::pair{"pan_joint", &pan_}, {"tilt_joint", &tilt_}}) {
      auto opened = robot.OpenJoint(name);
      if (!opened) return base::Fail(opened.error());
      *joint = *std::move(opened);
    }
    return {};
  }
  void Run(Robot& robot) override {
    pan_->MoveTo(kPan);
    tilt_->MoveTo(kTilt);
    if (robot.SleepFor(2s)) reached_ = {pan_->Read().position, tilt_->Read().position};
  }

 private:
  std::vector<double>& reached_;
  std::unique_ptr<Joint> pan_, tilt_;
};

std::shared_ptr<const model::Model> Rover() {
  const char* const source = std::getenv("GSV_SOURCE_DIR");
  const auto models = std::filesystem::path(source == nullptr ? "." : source) / "assets/models";
  formats::ModelLibrary library{formats::ReadOptions{{models}, true, {}}};
  base::Problems problems;
  const auto model = library.ReadModel((models / "rover4").string(), problems);
  EXPECT_TRUE(model) << model.error().Sentence();
  return model ? *model : nullptr;
}

std::shared_ptr<model::Model> Ball() {
  auto ball = std::make_shared<model::Model>();
  ball->links.resize(1);
  model::Visual visual;
  visual.shape = geometry::Sphere{0.15};
  visual.materials = {rendering::Glowing(1, 0, 0)};
  ball->links[0].visuals.push_back(visual);
  return ball;
}

// The line of sight of the camera: pan about z, then tilt and the mounting angle about y.
Vector3 LineOfSight() {
  const double down = kTilt + kMounting;
  return {std::cos(kPan) * std::cos(down), std::sin(kPan) * std::cos(down), -std::sin(down)};
}

void TurnHead(model::Movement movement) {
  auto renderer = rendering::Renderer::Start();
  if (!renderer) GTEST_SKIP() << renderer.error().Sentence();
  auto sensors = std::make_shared<sensing::SensorRegistry>();
  sensing::AddBuiltInSensors(*sensors);
  ASSERT_TRUE(rendering::AddCameraSensor(*sensors, renderer));

  simulation::Specification specification = simulation::Lockstep(2500ms);
  auto world = std::make_shared<model::WorldDescription>(*specification.world);
  auto ground = std::make_shared<model::Model>();
  ground->links.resize(1);
  ground->links[0].collisions.push_back({"ground", {}, geometry::Plane{}, {}});
  // The head rotates about (0.12, 0, 0.4), and the ball is 0.7 m from there.
  const Vector3 head{0.12, 0, 0.4};
  world->models = {{"ground", ground, {}, true},
                   {"ball", Ball(), {head + 0.7 * LineOfSight(), {}}, true}};
  specification.world = world;
  auto simulation = simulation::Simulation::Create(specification, sensors);
  ASSERT_TRUE(simulation) << simulation.error().Sentence();

  std::vector<double> reached;
  simulation::RobotSpecification robot;
  robot.name = "rover";
  robot.model = Rover();
  ASSERT_NE(robot.model, nullptr);
  robot.movement = movement;
  robot.behaviour = std::make_shared<hosting::HostedBehaviour>(
      "looks", [&] { return std::make_unique<Looks>(reached); });
  const auto added = (*simulation)->AddRobot(std::move(robot));
  ASSERT_TRUE(added) << added.error().Sentence();
  ASSERT_EQ(simulation::RunToEnd(**simulation), simulation::Phase::kFinished);
  ASSERT_EQ(reached.size(), 2u);
  EXPECT_NEAR(reached[0], kPan, 5e-3);
  EXPECT_NEAR(reached[1], kTilt, 5e-3);

  // The rover stands level, except that its wheels penetrate the ground a little.
  const auto snapshot = (*simulation)->snapshot();
  const int body = snapshot->layout->Find("rover");
  for (const model::SensorDescription& sensor : (*simulation)->sensors("rover")) {
    if (sensor.type != "camera") continue;
    const Pose world_from_camera =
        world::LinkPose(*snapshot, body, sensor.link) * sensor.link_from_sensor;
    EXPECT_LT(Norm(world_from_camera.orientation * Vector3{1, 0, 0} - LineOfSight()), 0.02);
  }
  const auto reading = (*simulation)->Watch("rover", "camera");
  ASSERT_TRUE(reading) << reading.error().Sentence();
  const rendering::Blob ball = rendering::FindBlob(*reading->image, 0);
  EXPECT_GT(ball.pixels, 500);
  // The tolerance of 6 pixels corresponds to an angle of about 0.02 rad (5.5 pixels).
  EXPECT_NEAR(ball.u, 160, 6);
  EXPECT_NEAR(ball.v, 120, 6);
}

TEST(PanTilt, CameraTurnsByTheAnglesOfItsJoints) { TurnHead(model::Movement::kRigid); }

TEST(PanTilt, CameraTurnsOnAPlanarRobot) { TurnHead(model::Movement::kPlanar); }

}  // namespace
}  // namespace gsv
