// Tests properties that must hold in every world, in random worlds. Overlaps are detected by code
// that shares nothing with the mover: it evaluates the equations of the solids at points of their
// surfaces.

#include <algorithm>

#include <gtest/gtest.h>

#include "gsv/base/random.h"
#include "gsv/dynamics/testing/test_world.h"
#include "gsv/dynamics/world_engine.h"
#include "gsv/geometry/constants.h"

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Shape;
using geometry::Vector3;
using testing::TestWorld;

using geometry::kPi;
constexpr double kClimb = 0.05;  // climb height of robots with the default wheel radius of 0.1

class Random {
 public:
  explicit Random(std::uint64_t seed) : noise_(seed, 1, 2) {}
  double Uniform(double low, double high) { return low + (high - low) * noise_.Uniform(); }
  int Index(int count) { return static_cast<int>(Uniform(0, count)); }

 private:
  base::Noise noise_;
};

// Returns a negative number if the point is inside the shape.
double Depth(const Shape& shape, const Vector3& p) {
  if (const auto* box = std::get_if<geometry::Box>(&shape)) {
    return std::max({std::abs(p.x) - box->size.x / 2, std::abs(p.y) - box->size.y / 2,
                     std::abs(p.z) - box->size.z / 2});
  }
  if (const auto* cylinder = std::get_if<geometry::Cylinder>(&shape)) {
    return std::max(std::hypot(p.x, p.y) - cylinder->radius, std::abs(p.z) - cylinder->length / 2);
  }
  if (const auto* sphere = std::get_if<geometry::Sphere>(&shape)) return Norm(p) - sphere->radius;
  return 1;  // a mesh has no inside
}

// Returns points distributed over the whole surface.
std::vector<Vector3> SurfacePoints(const Shape& shape) {
  std::vector<Vector3> points;
  const auto heights = {-1.0, -0.95, -0.8, -0.4, 0.0, 0.4, 0.8, 1.0};
  if (const auto* box = std::get_if<geometry::Box>(&shape)) {
    for (const double z : heights) {
      for (int i = 0; i <= 20; ++i) {
        const double s = i / 10.0 - 1;
        for (const double side : {-1.0, 1.0}) {
          points.push_back(0.5 * Scaled(box->size, {s, side, z}));
          points.push_back(0.5 * Scaled(box->size, {side, s, z}));
        }
      }
    }
  } else if (const auto* cylinder = std::get_if<geometry::Cylinder>(&shape)) {
    for (const double z : heights) {
      for (int i = 0; i < 360; ++i) {
        const double a = i * kPi / 180;
        points.push_back({cylinder->radius * std::cos(a), cylinder->radius * std::sin(a),
                          z * cylinder->length / 2});
      }
    }
  } else if (const auto* sphere = std::get_if<geometry::Sphere>(&shape)) {
    for (int k = -30; k <= 30; ++k) {
      for (int i = 0; i < 120; ++i) {
        const double a = i * kPi / 60, e = k * kPi / 60;
        points.push_back(sphere->radius * Vector3{std::cos(e) * std::cos(a),
                                                  std::cos(e) * std::sin(a), std::sin(e)});
      }
    }
  } else if (const auto* mesh = std::get_if<geometry::Mesh>(&shape)) {
    for (const auto& t : mesh->triangles->triangles) {
      const auto& p = mesh->triangles->positions;
      for (int i = 0; i <= 40; ++i) {
        for (int k = 0; k <= 40 - i; ++k) {
          points.push_back((i / 40.0) * p[t[0]] + (k / 40.0) * p[t[1]] +
                           ((40 - i - k) / 40.0) * p[t[2]]);
        }
      }
    }
  }
  return points;
}

struct Solid {
  int body;
  Shape shape;
  Pose world_from_solid;
  bool robot;
  double ground;                 // a robot drives over obstacles below this height
  std::vector<Vector3> surface;  // points of the surface, in the solid's own frame
  double radius;                 // radius of a sphere around the points
};

std::vector<Solid> SolidsOf(const world::Layout& layout, const world::State& state) {
  std::vector<Solid> solids;
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    const Pose& pose = state.bodies[b].world_from_model;
    for (const model::Link& link : layout.bodies[b].model->links) {
      for (const model::Collision& collision : link.collisions) {
        solids.push_back({static_cast<int>(b), collision.shape,
                          pose * link.model_from_link * collision.link_from_collision,
                          !layout.bodies[b].is_static(), pose.position.z + kClimb,
                          SurfacePoints(collision.shape), 0});
        for (const Vector3& p : solids.back().surface) {
          solids.back().radius = std::max(solids.back().radius, Norm(p));
        }
      }
    }
  }
  return solids;
}

// The largest depth of a point of one solid in the other.
double DeepestPoint(const Solid& a, const Solid& b) {
  if (Norm(a.world_from_solid.position - b.world_from_solid.position) > a.radius + b.radius)
    return 0;
  // Parts that are low enough to be driven over do not count.
  double ground = -1e9;
  if (!a.robot && b.robot) ground = b.ground;
  if (a.robot && !b.robot) ground = a.ground;
  const Pose b_from_a = Inverse(b.world_from_solid) * a.world_from_solid;
  double deepest = 0;
  for (const Vector3& p : a.surface) {
    if ((a.world_from_solid * p).z <= ground) continue;
    deepest = std::max(deepest, -Depth(b.shape, b_from_a * p));
  }
  return deepest;
}

void ExpectNoOverlaps(const world::Layout& layout, const world::State& state, std::uint64_t seed,
                      int step) {
  const std::vector<Solid> solids = SolidsOf(layout, state);
  for (std::size_t i = 0; i < solids.size(); ++i) {
    for (std::size_t k = 0; k < solids.size(); ++k) {
      if (solids[i].body == solids[k].body || (!solids[i].robot && !solids[k].robot)) continue;
      ASSERT_LE(DeepestPoint(solids[i], solids[k]), 1e-6)
          << layout.bodies[solids[i].body].name << " in " << layout.bodies[solids[k].body].name
          << ", seed " << seed << ", step " << step;
    }
  }
}

std::shared_ptr<model::Model> RobotOfKind(int kind) {
  std::shared_ptr<model::Model> robot;
  if (kind == 0) robot = testing::DiscRobot(0.25);
  if (kind == 1) robot = testing::BoxRobot(0.7, 0.3);
  if (kind == 2)
    robot = testing::RobotOf(geometry::Box{{0.4, 0.4, 0.5}}, 0.5, model::DriveKind::kVelocity);
  if (kind == 3) {
    // A low base whose axle is in front of its origin, with a mast beside the centre.
    robot = testing::BoxRobot(0.6, 0.5);
    robot->links.push_back(
        testing::LinkOf(geometry::Cylinder{0.1, 1}, geometry::PlanarPose(0.4, 0.3, 0.9, 0)));
    model::Joint wheel;
    wheel.kind = model::JointKind::kContinuous;
    wheel.parent = 0, wheel.child = 1;
    wheel.model_from_joint.position = {0.2, 0, 0.1};
    wheel.axis = {0, 1, 0};
    robot->joints.push_back(wheel);
    robot->drive->left_wheels = {0};
  }
  return robot;
}

// Obstacles of all kinds in a fenced square, and robots at free places.
struct RandomWorld {
  explicit RandomWorld(std::uint64_t seed) : random(seed) {
    for (int i = 0; i < 4; ++i) {
      const double a = i * kPi / 2;
      Add("fence" + std::to_string(i), geometry::Box{{0.02, 8.2, 1}},
          geometry::PlanarPose(4 * std::cos(a), 4 * std::sin(a), 0.5, a));
    }
    Add("floor", geometry::Box{{10, 10, 0.1}}, geometry::PlanarPose(0, 0, -0.05, 0));
    for (int i = 0; i < 8; ++i) AddObstacle("obstacle" + std::to_string(i));
    for (int i = 0; i < 6; ++i) AddRobot("robot" + std::to_string(i));
  }

  void Add(const std::string& name, const Shape& shape, const Pose& pose) {
    bodies.push_back({name, testing::ModelOf(shape), pose, true});
  }

  void AddObstacle(const std::string& name) {
    const Pose upright = geometry::PlanarPose(random.Uniform(-3.5, 3.5), random.Uniform(-3.5, 3.5),
                                              random.Uniform(-0.2, 0.8), random.Uniform(-3, 3));
    Pose askew = upright;
    askew.orientation = geometry::FromRollPitchYaw(
        {random.Uniform(-3, 3), random.Uniform(-1.5, 1.5), random.Uniform(-3, 3)});
    switch (random.Index(6)) {
      case 0:
        return Add(name, geometry::Box{{0.6, 0.05, 0.8}}, upright);
      case 1:
        return Add(name, geometry::Box{{1, 0.2, 0.5}}, askew);
      case 2:
        return Add(name, geometry::Cylinder{0.2, 0.6}, upright);
      case 3:
        return Add(name, geometry::Sphere{0.3}, upright);
      case 4:
        return Add(name, geometry::Cylinder{0.2, 0.6}, askew);
      default: {
        auto mesh = std::make_shared<geometry::TriangleMesh>();
        mesh->positions = {{-0.5, 0, -0.5}, {0.5, 0.1, -0.4}, {0.2, 0.3, 0.6}, {-0.4, 0.5, 0}};
        mesh->triangles = {{0, 1, 2}, {0, 2, 3}};
        return Add(name, geometry::Mesh{mesh, {1, 1, 1}}, upright);
      }
    }
  }

  void AddRobot(const std::string& name) {
    const auto model = RobotOfKind(random.Index(4));
    for (int attempt = 0; attempt < 50; ++attempt) {
      bodies.push_back({name, model,
                        geometry::PlanarPose(random.Uniform(-3.3, 3.3), random.Uniform(-3.3, 3.3),
                                             0, random.Uniform(-3, 3)),
                        false});
      TestWorld world = Make(bodies);
      if (world.engine().Overlaps(world.state(), 0).empty()) return;
      bodies.pop_back();
    }
  }

  struct Placed {
    std::string name;
    std::shared_ptr<const model::Model> model;
    Pose pose;
    bool is_static;
  };

  static TestWorld Make(const std::vector<Placed>& placed) {
    TestWorld world(MakeWorldEngine());
    for (const Placed& p : placed) {
      p.is_static ? world.AddStatic(p.name, p.model, p.pose)
                  : world.AddRobot(p.name, p.model, p.pose);
    }
    EXPECT_TRUE(world.Start());
    return world;
  }

  Random random;
  std::vector<Placed> bodies;
};

void CommandAll(TestWorld& world, Random& random) {
  for (const world::Body& body : world.layout().bodies) {
    if (body.is_static() || random.Uniform(0, 1) < 0.3) continue;
    world.Command(body.name, {random.Uniform(-3, 6), random.Uniform(-3, 3),
                              random.Uniform(0, 1) < 0.3 ? 0 : random.Uniform(-4, 4)});
  }
}

TEST(PlanarMoverProperty, OverlapCheckOfThisTestFindsAnOverlap) {
  TestWorld world(MakeWorldEngine());
  world.AddRobot("robot", testing::DiscRobot(0.25), geometry::PlanarPose(0, 0, 0, 0));
  world.AddBox("wall", {0.1, 4, 1}, 0.299, 0);  // the robot is a millimetre deep in the wall
  ASSERT_TRUE(world.Start());
  const std::vector<Solid> solids = SolidsOf(world.layout(), world.state());
  ASSERT_EQ(solids.size(), 2u);
  EXPECT_NEAR(DeepestPoint(solids[0], solids[1]), 1e-3, 1e-9);
}

TEST(PlanarMoverProperty, BodiesNeverOverlap) {
  int contacts = 0;
  for (std::uint64_t seed = 0; seed < 25; ++seed) {
    RandomWorld made(seed);
    TestWorld world = RandomWorld::Make(made.bodies);
    Random commands(1000 + seed);
    const double step = seed % 3 == 0 ? 0.2 : seed % 3 == 1 ? 0.05 : 0.01;
    for (int i = 0; i < 60; ++i) {
      if (i % 5 == 0) CommandAll(world, commands);
      contacts += static_cast<int>(world.Step(step).size());
      if (i % 12 == 11) ExpectNoOverlaps(world.layout(), world.state(), seed, i);
      if (HasFatalFailure()) return;
    }
    EXPECT_TRUE(world.engine().Overlaps(world.state(), 0).empty()) << seed;
  }
  EXPECT_GT(contacts, 500);
}

std::uint64_t DigestAfterRun(std::vector<RandomWorld::Placed> bodies, std::uint64_t seed) {
  TestWorld world = RandomWorld::Make(bodies);
  Random commands(seed);
  for (int i = 0; i < 60; ++i) {
    if (i % 5 == 0) CommandAll(world, commands);
    world.Step(0.05);
  }
  return world.Digest();
}

TEST(PlanarMoverProperty, DoesNotDependOnTheOrderOfInsertion) {
  for (std::uint64_t seed = 0; seed < 8; ++seed) {
    RandomWorld made(seed);
    const std::uint64_t digest = DigestAfterRun(made.bodies, seed);
    EXPECT_EQ(DigestAfterRun(made.bodies, seed), digest);
    std::reverse(made.bodies.begin(), made.bodies.end());
    EXPECT_EQ(DigestAfterRun(made.bodies, seed), digest);
  }
}

TEST(PlanarMoverProperty, CachesDoNotChangeTheResult) {
  RandomWorld made(3);
  TestWorld world = RandomWorld::Make(made.bodies);
  Random commands(3);
  for (int i = 0; i < 100; ++i) {
    if (i % 5 == 0) CommandAll(world, commands);
    // A new engine, without data of earlier steps, computes the same step.
    world::State copy = world.state();
    const auto fresh = MakeWorldEngine();
    ASSERT_TRUE(fresh->SetLayout(std::make_shared<world::Layout>(world.layout())));
    std::vector<world::Contact> expected;
    fresh->Step(base::FromSeconds(0.05), copy, expected);
    const base::SimTime time = world.state().time;
    const auto contacts = world.Step(0.05);
    copy.time = world.state().time;
    copy.step = world.state().step;
    ASSERT_GT(world.state().time, time);
    base::Hash a, b;
    world::AddToHash(world.layout(), copy, a);
    world::AddToHash(world.layout(), world.state(), b);
    ASSERT_EQ(a.Digest(), b.Digest()) << i;
    ASSERT_EQ(contacts.size(), expected.size());
    for (std::size_t k = 0; k < contacts.size(); ++k) {
      EXPECT_EQ(contacts[k].first, expected[k].first);
      EXPECT_EQ(contacts[k].began, expected[k].began);
    }
  }
}

TEST(PlanarMoverProperty, CrowdPassesACorridorWithoutOverlaps) {
  TestWorld world(MakeWorldEngine());
  world.AddBox("left", {40, 0.1, 1}, 0, 1.05);
  world.AddBox("right", {40, 0.1, 1}, 0, -1.05);
  for (int i = 0; i < 20; ++i) {
    world.AddRobot("r" + std::to_string(i), testing::DiscRobot(0.2),
                   geometry::PlanarPose(-0.45 * i, i % 3 * 0.5 - 0.5, 0, 0));
  }
  ASSERT_TRUE(world.Start());
  for (int i = 0; i < 20; ++i) world.Command("r" + std::to_string(i), {0.2 + 0.05 * (i % 7), 0, 0});
  for (int i = 0; i < 300; ++i) {
    world.Step(0.05);
    EXPECT_TRUE(world.engine().Overlaps(world.state(), 0).empty()) << i;
  }
  // The first robot of each lane is not delayed.
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(world.body("r" + std::to_string(i)).distance, 15 * (0.2 + 0.05 * i), 1e-9);
  }
}

}  // namespace
}  // namespace gsv::dynamics
