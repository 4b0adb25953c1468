// Tests that behaviours inside and outside of the simulation's process command and read joints.
#include <gmock/gmock.h>

#include "gsv/hosting/hosted_behaviour.h"
#include "gsv/simulation/testing/test_simulation.h"

namespace gsv::hosting {
namespace {

using simulation::Lockstep;
using simulation::Phase;
using simulation::RunToEnd;
using ::testing::HasSubstr;

model::Link Box(const std::string& name, const geometry::Vector3& size, double z, double mass) {
  model::Link link;
  link.name = name;
  link.model_from_link = {{0, 0, z}, {}};
  link.inertial = {mass, {}, 0.1, 0.1, 0.1};
  link.collisions.push_back({name, {}, geometry::Box{size}, {}});
  return link;
}

// A box with a vertical slider (a lift) on top. The lift weighs 19.6 N.
std::shared_ptr<const model::Model> Lift(model::Movement movement) {
  auto model = std::make_shared<model::Model>();
  model->name = "lift";
  model->links = {Box("base", {0.5, 0.5, 0.3}, 0.15, 20), Box("fork", {0.4, 0.4, 0.05}, 0.4, 2)};
  model::Joint joint;
  joint.name = "lift";
  joint.kind = model::JointKind::kPrismatic;
  joint.parent = 0;
  joint.child = 1;
  joint.position_limits = {0, 0.5};
  joint.velocity_limit = 0.4;
  joint.effort_limit = 100;
  model->joints = {joint};
  model->drive.emplace();
  model->drive->kind = model::DriveKind::kVelocity;
  model->movement = movement;
  return model;
}

simulation::RobotSpecification LiftWith(std::shared_ptr<simulation::BehaviourPort> behaviour,
                                        model::Movement movement = model::Movement::kRigid) {
  simulation::RobotSpecification robot = simulation::Robot("lift", 0, 0, std::move(behaviour));
  robot.model = Lift(movement);
  return robot;
}

std::shared_ptr<simulation::Simulation> OnGround(SimTime duration) {
  simulation::Specification specification = Lockstep(duration);
  auto world = std::make_shared<model::WorldDescription>(*specification.world);
  auto ground = std::make_shared<model::Model>();
  ground->links.resize(1);
  ground->links[0].collisions.push_back({"ground", {}, geometry::Plane{}, {}});
  world->models.push_back({"ground", ground, {}, true});
  specification.world = world;
  return simulation::Make(specification);
}

class Lifting final : public Behaviour {
 public:
  using Body = std::function<void(gsv::Robot&, Joint&)>;
  explicit Lifting(Body body) : body_(std::move(body)) {}
  base::Status Init(gsv::Robot& robot) override {
    auto joint = robot.OpenJoint("lift");
    if (!joint) return base::Fail(joint.error());
    joint_ = *std::move(joint);
    return {};
  }
  void Run(gsv::Robot& robot) override { body_(robot, *joint_); }

 private:
  const Body body_;
  std::unique_ptr<Joint> joint_;
};

std::shared_ptr<HostedBehaviour> Hosted(Lifting::Body body) {
  return std::make_shared<HostedBehaviour>("lifting",
                                           [body] { return std::make_unique<Lifting>(body); });
}

TEST(LocalJoint, MovesToItsTarget) {
  auto simulation = OnGround(4s);
  std::vector<double> positions, velocities;
  ASSERT_TRUE(simulation->AddRobot(LiftWith(Hosted([&](gsv::Robot& robot, Joint& joint) {
    const auto after = [&](SimTime duration) {
      if (!robot.SleepFor(duration)) return;
      positions.push_back(joint.Read().position);
      velocities.push_back(joint.Read().velocity);
    };
    EXPECT_EQ(joint.traits().kind, "prismatic");
    EXPECT_EQ(joint.traits().max_position, 0.5);
    joint.MoveTo(0.3);
    after(2s);
    joint.MoveAt(0.1);
    after(1s);
    // The lift falls, but not faster than its velocity limit.
    joint.Release();
    after(500ms);
  }))));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  ASSERT_EQ(positions.size(), 3u);
  EXPECT_NEAR(positions[0], 0.3, 1e-3);
  EXPECT_NEAR(positions[1], 0.4, 2e-3);
  EXPECT_NEAR(velocities[1], 0.1, 1e-6);
  // The velocity changes from 0.1 m/s upwards to 0.4 m/s downwards at 9.8 m/s². Until the end of
  // the half second, the lift falls at this limit.
  const double free_fall = 0.5 / 9.8;
  const double way = (0.16 - 0.01) / (2 * 9.8) + 0.4 * (0.5 - free_fall);
  EXPECT_NEAR(positions[2], positions[1] - way, 2e-3);
}

TEST(LocalJoint, RejectsCommandsThatAreNotFiniteAndContinues) {
  auto simulation = OnGround(2s);
  double position = 0;
  std::vector<std::string> errors;
  ASSERT_TRUE(simulation->AddRobot(LiftWith(Hosted([&](gsv::Robot& robot, Joint& joint) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double infinite = std::numeric_limits<double>::infinity();
    joint.MoveTo(0.3);
    const std::vector<std::function<void()>> calls = {
        [&] { joint.MoveTo(nan); }, [&] { joint.MoveAt(-infinite); },
        [&] { joint.Apply(infinite); }, [&] { robot.Drive(0, nan); }};
    for (const auto& call : calls) {
      try {
        call();
      } catch (const std::invalid_argument& error) {
        errors.emplace_back(error.what());
      }
    }
    if (robot.SleepFor(1900ms)) position = joint.Read().position;
  }))));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  EXPECT_THAT(errors,
              ::testing::ElementsAre(
                  HasSubstr("the position of the joint \"lift\" must be finite, found nan"),
                  HasSubstr("the velocity of the joint \"lift\" must be finite, found -inf"),
                  HasSubstr("the effort of the joint \"lift\" must be finite, found inf"),
                  HasSubstr("the angular velocity of lift must be finite, found nan")));
  EXPECT_NEAR(position, 0.3, 1e-3);
}

TEST(LocalJoint, EffortLiftsAWeightAgainstGravity) {
  auto simulation = OnGround(1s);
  double velocity = 0;
  ASSERT_TRUE(simulation->AddRobot(LiftWith(Hosted([&](gsv::Robot& robot, Joint& joint) {
    joint.Apply(2 * 9.8 + 1);
    if (robot.SleepFor(500ms)) velocity = joint.Read().velocity;
  }))));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  // The commanded force is 1 N more than the weight of the lift, whose mass is 2 kg.
  EXPECT_NEAR(velocity, 0.25, 0.005);
}

TEST(LocalJoint, HasTheSameHashAsAJointCommandedRemotely) {
  auto inside = OnGround(2s), outside = OnGround(2s);
  ASSERT_TRUE(inside->AddRobot(LiftWith(Hosted([](gsv::Robot& robot, Joint& joint) {
    joint.MoveTo(0.2);
    if (robot.SleepFor(500ms)) joint.MoveTo(joint.Read().position / 2);
    while (robot.SleepFor(500ms)) {
    }
  }))));
  ASSERT_TRUE(outside->AddRobot(LiftWith(std::make_shared<simulation::ThreadBehaviour>(
      [](simulation::Agent& agent, simulation::ClockId clock) {
        using Kind = world::JointCommand::Kind;
        ASSERT_TRUE(agent.CommandJoint(0, {Kind::kPosition, 0.2}));
        ASSERT_TRUE(simulation::SleepFor(agent, clock, 500ms));
        const double half = agent.ReadJoint(0)->position / 2;
        ASSERT_TRUE(agent.CommandJoint(0, {Kind::kPosition, half}));
        while (simulation::SleepFor(agent, clock, 500ms)) {
        }
      }))));
  ASSERT_EQ(RunToEnd(*inside), Phase::kFinished);
  ASSERT_EQ(RunToEnd(*outside), Phase::kFinished);
  EXPECT_EQ(inside->state_hash(), outside->state_hash());
}

TEST(LocalJoint, MovesAtItsVelocityLimitOnAPlanarRobot) {
  auto simulation = OnGround(4s);
  std::vector<JointState> reached;
  ASSERT_TRUE(simulation->AddRobot(LiftWith(Hosted([&](gsv::Robot& robot, Joint& joint) {
                                              const auto after = [&](SimTime duration) {
                                                if (!robot.SleepFor(duration)) return;
                                                reached.push_back(joint.Read());
                                              };
                                              joint.MoveTo(0.3);
                                              after(500ms);
                                              after(500ms);
                                              joint.MoveAt(-0.1);
                                              after(1s);
                                              joint.Release();
                                              after(500ms);
                                              joint.MoveAt(1);
                                              after(1s);
                                            }),
                                            model::Movement::kPlanar)));
  ASSERT_EQ(RunToEnd(*simulation), Phase::kFinished);
  const std::vector<std::pair<double, double>> expected = {
      {0.2, 0.4}, {0.3, 0}, {0.2, -0.1}, {0.2, 0}, {0.5, 0}};
  ASSERT_EQ(reached.size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NEAR(reached[i].position, expected[i].first, 1e-9) << i;
    EXPECT_NEAR(reached[i].velocity, expected[i].second, 1e-9) << i;
  }
}

TEST(LocalJoint, RejectsAnEffortOnAPlanarRobot) {
  auto simulation = OnGround(1s);
  std::string error;
  ASSERT_TRUE(simulation->AddRobot(LiftWith(Hosted([&](gsv::Robot& robot, Joint& joint) {
                                              joint.Apply(3);
                                              error = robot.error();
                                            }),
                                            model::Movement::kPlanar)));
  RunToEnd(*simulation);
  EXPECT_THAT(error, HasSubstr("--movement lift=rigid"));
}

TEST(LocalJoint, RejectsAnUnknownName) {
  auto simulation = OnGround(1s);
  auto robot = LiftWith(std::make_shared<HostedBehaviour>(
      "lifting", [] { return std::make_unique<Lifting>([](gsv::Robot&, Joint&) {}); }));
  auto model = std::make_shared<model::Model>(*robot.model);
  model->joints[0].name = "other";
  robot.model = model;
  const auto added = simulation->AddRobot(robot);
  ASSERT_FALSE(added);
  EXPECT_THAT(added.error().Sentence(), HasSubstr("no joint \"lift\""));
}

}  // namespace
}  // namespace gsv::hosting
