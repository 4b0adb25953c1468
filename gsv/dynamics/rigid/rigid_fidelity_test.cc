// Tests rigid bodies against mechanics. Every expected value is a closed form; docs/fidelity.md
// lists them.
#include <numbers>

#include <gtest/gtest.h>

#include "gsv/base/test_table.h"
#include "gsv/base/test_within.h"
#include "gsv/dynamics/testing/test_rigid_world.h"

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Vector3;
using testing::At;
using testing::EnergyOf;
using testing::kG;
using testing::SolidOf;
using testing::TestWorld;
using testing::WorldOnGround;

constexpr double kStep = 0.001;

model::Surface SurfaceOf(double friction, double restitution = 0) {
  return {friction, friction, restitution};
}

// A plane inclined about the y axis. It descends along +x.
Pose Inclined(double angle) { return {{0, 0, 0}, geometry::FromAxisAngle({0, 1, 0}, angle)}; }

TEST(RigidFidelity, ABodyFallsAlongTheParabola) {
  TestWorld world = WorldOnGround();
  world.AddRigid("ball", SolidOf(geometry::Sphere{0.1}, 2), At(0, 0, 10));
  ASSERT_TRUE(world.Start());
  world.body("ball").linear_velocity = {3, -1, 2};
  world.Run(1, kStep);
  EXPECT_WITHIN(world.position("ball").x, 3, 1e-9, "m");
  EXPECT_WITHIN(world.position("ball").y, -1, 1e-9, "m");
  EXPECT_WITHIN(world.position("ball").z, 10 + 2 - kG / 2, 1e-9, "m");
  EXPECT_NEAR(world.body("ball").linear_velocity.z, 2 - kG, 1e-9);
}

TEST(RigidFidelity, FallDoesNotDependOnTheStepSize) {
  for (const double step : {0.0005, 0.004, 0.25}) {
    TestWorld world = WorldOnGround();
    world.AddRigid("ball", SolidOf(geometry::Sphere{0.1}, 2), At(0, 0, 10));
    ASSERT_TRUE(world.Start());
    world.Run(1, step);
    EXPECT_WITHIN(world.position("ball").z, 10 - kG / 2, 1e-9, "m") << step;
  }
}

TEST(RigidFidelity, BallBouncesToTheHeightOfItsRestitution) {
  base::testing::Table table("bounce");
  for (const double restitution : {0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9}) {
    TestWorld world = WorldOnGround(SurfaceOf(1, 1));
    world.AddRigid("ball", SolidOf(geometry::Sphere{0.1}, 1, SurfaceOf(1, restitution)),
                   At(0, 0, 1.1));
    ASSERT_TRUE(world.Start());
    world.Run(std::sqrt(2 / kG) + 0.02, kStep);
    double highest = 0;
    for (int i = 0; i < 800; ++i) {
      world.Step(kStep);
      if (world.body("ball").linear_velocity.z < 0) break;
      highest = std::max(highest, world.position("ball").z - 0.1);
    }
    EXPECT_WITHIN(highest, restitution * restitution, 0.01, "m") << restitution;
    table.Row({restitution, highest, restitution * restitution});
  }
}

TEST(RigidFidelity, ASlidingBoxStopsAfterTheFrictionDistance) {
  const double mu = 0.5, speed = 2;
  TestWorld world = WorldOnGround();
  world.AddRigid("box", SolidOf(geometry::Box{{0.4, 0.4, 0.1}}, 3, SurfaceOf(mu)), At(0, 0, 0.05));
  ASSERT_TRUE(world.Start());
  world.body("box").linear_velocity = {speed, 0, 0};
  base::testing::Table table("friction");
  for (int i = 0; i <= 1000; ++i) {
    const double sliding = std::min(kStep * i, speed / (mu * kG));
    table.Row({kStep * i, world.position("box").x, (speed - mu * kG * sliding / 2) * sliding});
    if (i < 1000) world.Step(kStep);
  }
  EXPECT_WITHIN_PERCENT(world.position("box").x, speed * speed / (2 * mu * kG), 0.5);
  EXPECT_EQ(world.body("box").linear_velocity, Vector3{});
}

TEST(RigidFidelity, BallOnTwoEdgesIsNotDeflected) {
  // The edges are 0.5 m apart, so the centre of the resting ball is sqrt(0.5² - 0.25²) above them.
  for (const double height : {1.5, 2.0, 2.5, 3.0, 3.5, 4.0}) {
    TestWorld world(MakeWorldEngine());
    world.AddBox("left", {1, 4, 1}, -0.75, 0);
    world.AddBox("right", {1, 4, 1}, 0.75, 0);
    world.AddRigid("ball", SolidOf(geometry::Sphere{0.5}, 1), At(0, 0, height));
    ASSERT_TRUE(world.Start());
    for (int i = 0; i < 1500; ++i) {
      world.Step(kStep);
      ASSERT_NEAR(world.position("ball").x, 0, 1e-4) << height;
    }
    EXPECT_WITHIN(world.position("ball").z, 1 + std::sqrt(0.1875), 1e-3, "m") << height;
    EXPECT_WITHIN(world.position("ball").y, 0, 1e-6, "m") << height;
    EXPECT_WITHIN(Norm(world.body("ball").angular_velocity), 0, 1e-6, "rad/s") << height;
  }
}

// The speed of a ball 0.05 s after it has landed at 2 m/s, with a horizontal speed of 3 m/s and
// without spin.
double SpeedAfterLanding(double friction, double height_more) {
  const double height = 2.0 * 2.0 / (2 * kG) + height_more;
  TestWorld world = WorldOnGround();
  world.AddRigid("ball", SolidOf(geometry::Sphere{0.1}, 1, SurfaceOf(friction)),
                 At(0, 0, 0.1 + height));
  EXPECT_TRUE(world.Start());
  world.body("ball").linear_velocity = {3, 0, 0};
  world.Run(std::sqrt(2 * height / kG) + 0.05, kStep);
  return world.body("ball").linear_velocity.x;
}

TEST(RigidFidelity, FrictionAtAnImpactIsProportionalToTheImpulse) {
  // The heights differ, so that the contacts begin at different times within a step.
  for (const double more : {0.0, 3e-4, 7e-4, 1.3e-3, 1.9e-3}) {
    EXPECT_WITHIN(SpeedAfterLanding(0.1, more), 3 - 0.1 * 2 - 0.1 * kG * 0.05, 2e-3, "m/s") << more;
    // With so much friction the ball rolls at once, at 5/7 of the speed.
    EXPECT_WITHIN(SpeedAfterLanding(1, more), 3 * 5 / 7.0, 2e-3, "m/s") << more;
  }
}

constexpr double kInclineFriction = 0.5;

// The distance that a box slides down an incline in `seconds`.
double SlideDown(double angle, double seconds, Vector3& velocity) {
  const Pose incline = Inclined(angle);
  TestWorld world(MakeWorldEngine());
  world.AddStatic("incline", testing::GroundOf(), incline);
  world.AddRigid("box", SolidOf(geometry::Box{{0.4, 0.4, 0.1}}, 3, SurfaceOf(kInclineFriction)),
                 incline * At(0, 0, 0.05));
  EXPECT_TRUE(world.Start());
  world.Run(seconds, kStep);
  velocity = world.body("box").linear_velocity;
  return (Inverse(incline) * world.position("box")).x;
}

TEST(RigidFidelity, ABoxOnAnInclineStaysBelowTheFrictionAngle) {
  Vector3 velocity;
  EXPECT_WITHIN(SlideDown(std::atan(kInclineFriction) - 0.01, 10, velocity), 0, 1e-5, "m");
  EXPECT_EQ(velocity, Vector3{});
}

TEST(RigidFidelity, ABoxOnAnInclineSlidesAboveTheFrictionAngle) {
  base::testing::Table table("incline");
  Vector3 velocity;
  for (const double beyond : {-0.1, -0.05, -0.01, 0.05, 0.1, 0.15, 0.2, 0.3}) {
    const double angle = std::atan(kInclineFriction) + beyond;
    const double slope = std::sin(angle) - kInclineFriction * std::cos(angle);
    const double expected = std::max(0.0, kG * slope * 2 * 2 / 2);
    const double slid = SlideDown(angle, 2, velocity);
    if (beyond < 0) {
      EXPECT_WITHIN(slid, 0, 1e-5, "m") << beyond;
    } else {
      EXPECT_WITHIN_PERCENT(slid, expected, 0.5) << beyond;
    }
    table.Row({angle, slid, expected});
  }
}

TEST(RigidFidelity, ABallRollsDownAnInclineAtFiveSeventhsOfTheSlope) {
  const double angle = 0.2;
  const Pose incline = Inclined(angle);
  TestWorld world(MakeWorldEngine());
  world.AddStatic("incline", testing::GroundOf(), incline);
  world.AddRigid("ball", SolidOf(geometry::Sphere{0.1}, 1), incline * At(0, 0, 0.1));
  ASSERT_TRUE(world.Start());
  world.Run(2, kStep);
  const double expected = 5.0 / 7 * kG * std::sin(angle) * 2 * 2 / 2;
  EXPECT_WITHIN_PERCENT((Inverse(incline) * world.position("ball")).x, expected, 0.5);
}

// The plane of Inclined() as triangles: strips of squares across the slope. The diagonals of
// consecutive squares alternate.
std::shared_ptr<model::Model> InclineOfTriangles() {
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  constexpr std::uint32_t kColumns = 40;
  for (std::uint32_t i = 0; i <= kColumns; ++i) {
    const double x = 0.17 * i - 1;
    mesh->positions.insert(mesh->positions.end(), {{x, -1, 0}, {x, 1, 0}});
    if (i == kColumns) break;
    const std::uint32_t a = 2 * i, b = a + 1, c = a + 2, d = a + 3;
    if (i % 2 == 0) {
      mesh->triangles.insert(mesh->triangles.end(), {{a, c, d}, {a, d, b}});
    } else {
      mesh->triangles.insert(mesh->triangles.end(), {{a, c, b}, {c, d, b}});
    }
  }
  return testing::ModelOf(geometry::Mesh{std::move(mesh), {1, 1, 1}});
}

TEST(RigidFidelity, BallsAndWheelsRollDownTrianglesAsDownAPlane) {
  const double angle = 0.2;
  const Pose incline = Inclined(angle);
  const geometry::Quaternion lying = geometry::FromAxisAngle({1, 0, 0}, -std::numbers::pi / 2);
  TestWorld world(MakeWorldEngine());
  world.AddStatic("incline", InclineOfTriangles(), incline);
  world.AddRigid("ball", SolidOf(geometry::Sphere{0.1}, 1), incline * At(0, 0.5, 0.1));
  world.AddRigid("wheel", SolidOf(geometry::Cylinder{0.1, 0.08}, 1),
                 incline * Pose{{0, -0.5, 0.1}, lying});
  ASSERT_TRUE(world.Start());
  world.Run(2, kStep);
  const double slid = kG * std::sin(angle) * 2 * 2 / 2;
  const Vector3 ball = Inverse(incline) * world.position("ball");
  const Vector3 wheel = Inverse(incline) * world.position("wheel");
  EXPECT_WITHIN_PERCENT(ball.x, 5.0 / 7 * slid, 0.5);
  EXPECT_WITHIN_PERCENT(wheel.x, 2.0 / 3 * slid, 0.5);
  EXPECT_WITHIN(wheel.y, -0.5, 1e-6, "m");
  EXPECT_WITHIN(wheel.z, 0.1, 2e-5, "m");
  EXPECT_WITHIN(ball.z, 0.1, 2e-5, "m");
}

// A scanned surface: squares of 4 mm, with bumps of 1 µm. A wheel is near hundreds of its
// triangles. There are 250 edges per metre. At each edge, the surface bends by at most 1 mrad, so
// that a rolling body loses at most 1e-6 of its energy there.
TEST(RigidFidelity, BallsAndWheelsRollDownAFineMeshAsDownAPlane) {
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  constexpr std::uint32_t kRows = 300, kColumns = 75;
  for (std::uint32_t i = 0; i <= kRows; ++i) {
    for (std::uint32_t j = 0; j <= kColumns; ++j) {
      mesh->positions.push_back(
          {0.004 * i - 0.1, 0.004 * j - 0.15, 1e-6 * std::sin(2.0 * i) * std::cos(3.0 * j)});
      if (i == kRows || j == kColumns) continue;
      const std::uint32_t a = i * (kColumns + 1) + j, b = a + 1, c = a + kColumns + 1, d = c + 1;
      mesh->triangles.insert(mesh->triangles.end(), {{a, c, d}, {a, d, b}});
    }
  }
  const double angle = 0.2;
  const Pose incline = Inclined(angle);
  const geometry::Quaternion lying = geometry::FromAxisAngle({1, 0, 0}, -std::numbers::pi / 2);
  TestWorld world(MakeWorldEngine());
  world.AddStatic("incline", testing::ModelOf(geometry::Mesh{std::move(mesh), {1, 1, 1}}), incline);
  world.AddRigid("ball", SolidOf(geometry::Sphere{0.1}, 1), incline * At(0, 0.1, 0.1));
  world.AddRigid("wheel", SolidOf(geometry::Cylinder{0.1, 0.04}, 1),
                 incline * Pose{{0, -0.05, 0.1}, lying});
  ASSERT_TRUE(world.Start());
  world.Run(1, kStep);
  const double slid = kG * std::sin(angle) / 2;
  EXPECT_WITHIN_PERCENT((Inverse(incline) * world.position("ball")).x, 5.0 / 7 * slid, 0.5);
  EXPECT_WITHIN_PERCENT((Inverse(incline) * world.position("wheel")).x, 2.0 / 3 * slid, 0.5);
}

TEST(RigidFidelity, ACollisionKeepsMomentum) {
  const double speed = 2, e = 0.7 * 0.7;  // the product of the restitutions of both surfaces
  const model::Surface bouncy = SurfaceOf(0, 0.7);
  base::testing::Table table("momentum");
  for (const double mass : {0.25, 0.5, 1.0, 2.0, 3.0, 4.0}) {
    TestWorld world(MakeWorldEngine());
    world.AddRigid("a", SolidOf(geometry::Sphere{0.1}, mass, bouncy), At(0, 0, 100));
    world.AddRigid("b", SolidOf(geometry::Sphere{0.1}, 1, bouncy), At(1, 0, 100));
    ASSERT_TRUE(world.Start());
    world.body("a").linear_velocity = {speed, 0, 0};
    world.Run(1, kStep);
    const double va = world.body("a").linear_velocity.x, vb = world.body("b").linear_velocity.x;
    EXPECT_WITHIN(mass * va + vb, mass * speed, 1e-9, "kg m/s") << mass;
    // The tolerance, 0.01 m/s, is the overlap of resting bodies (10 µm) divided by a substep (1
    // ms).
    EXPECT_WITHIN(vb - va, e * speed, 0.0101, "m/s") << mass;
    EXPECT_EQ(world.body("a").collisions, 1u) << mass;
    table.Row({mass, va, vb, speed * (mass - e) / (mass + 1), speed * mass * (1 + e) / (mass + 1)});
  }
}

TEST(RigidFidelity, ABoxAtRestNeitherSinksNorDrifts) {
  TestWorld world = WorldOnGround();
  world.AddRigid("box", SolidOf(geometry::Box{{0.5, 0.5, 0.5}}, 10), At(1, 2, 0.25));
  ASSERT_TRUE(world.Start());
  world.Run(1, kStep);
  const Vector3 settled = world.position("box");
  EXPECT_WITHIN(settled.x, 1, 1e-9, "m");
  EXPECT_WITHIN(settled.y, 2, 1e-9, "m");
  EXPECT_WITHIN(settled.z, 0.25, 2e-5, "m");
  world.Run(60, kStep);
  EXPECT_EQ(world.position("box"), settled);
}

TEST(RigidFidelity, StackIsStableForAMinute) {
  TestWorld world = WorldOnGround();
  const auto box = SolidOf(geometry::Box{{0.5, 0.5, 0.5}}, 1);
  for (int i = 0; i < 5; ++i) {
    world.AddRigid("box" + std::to_string(i), box, At(0, 0, 0.25 + 0.5 * i));
  }
  ASSERT_TRUE(world.Start());
  base::testing::Table table("stack");
  for (int i = 0; i <= 600; ++i) {
    const Vector3& top = world.position("box4");
    table.Row({0.1 * i, 1e6 * (top.z - 2.25), 1e6 * std::hypot(top.x, top.y)});
    if (i < 600) world.Run(0.1, kStep);
  }
  for (int i = 0; i < 5; ++i) {
    const Vector3& at = world.position("box" + std::to_string(i));
    EXPECT_WITHIN(at.x, 0, 1e-4, "m") << i;
    EXPECT_WITHIN(at.y, 0, 1e-4, "m") << i;
    EXPECT_WITHIN(at.z, 0.25 + 0.5 * i, 1e-4, "m") << i;
    EXPECT_EQ(world.body("box" + std::to_string(i)).linear_velocity, Vector3{}) << i;
  }
}

// The tower has more velocities than kMaxHeap, so ContactSweeps solves it. Its top box weighs 1 kg
// or 100 kg. No contact is deeper than 0.1 mm, because deeper overlaps are removed.
TEST(RigidFidelity, TowerOfTwelveBoxesStands) {
  constexpr int kBoxes = 12;
  for (const double mass : {1.0, 100.0}) {
    TestWorld world = WorldOnGround();
    for (int i = 0; i < kBoxes; ++i) {
      world.AddRigid("box" + std::to_string(i),
                     SolidOf(geometry::Box{{0.3, 0.3, 0.3}}, i == kBoxes - 1 ? mass : 1),
                     At(0.003 * (i % 3), 0, 0.15 + 0.3 * i));
    }
    ASSERT_TRUE(world.Start());
    world.Run(10, kStep);
    const Vector3 top = world.position("box11");
    EXPECT_WITHIN(top.x, 0.006, 1e-3, "m") << mass;
    EXPECT_WITHIN(top.y, 0, 1e-3, "m") << mass;
    EXPECT_WITHIN(top.z, 0.15 + 0.3 * (kBoxes - 1), kBoxes * 1e-4, "m") << mass;
  }
}

TEST(RigidFidelity, HeavyBoxOnALightBoxIsStable) {
  for (const double mass : {10.0, 1e3, 1e5}) {
    TestWorld world = WorldOnGround();
    world.AddRigid("light", SolidOf(geometry::Box{{0.2, 0.2, 0.2}}, 1), At(0, 0, 0.1));
    world.AddRigid("heavy", SolidOf(geometry::Box{{0.2, 0.2, 0.2}}, mass), At(0, 0, 0.3));
    ASSERT_TRUE(world.Start());
    world.Run(5, 0.01);
    EXPECT_WITHIN(world.position("heavy").z, 0.3, 1e-4, "m") << mass;
    EXPECT_WITHIN(std::hypot(world.position("heavy").x, world.position("heavy").y), 0, 1e-4, "m")
        << mass;
  }
}

TEST(RigidFidelity, SlabOnFourLightLegsIsStable) {
  TestWorld world = WorldOnGround();
  for (int i = 0; i < 4; ++i) {
    world.AddRigid("leg" + std::to_string(i), SolidOf(geometry::Box{{0.1, 0.1, 0.5}}, 1),
                   At(i % 2 == 0 ? -0.4 : 0.4, i < 2 ? -0.4 : 0.4, 0.25));
  }
  world.AddRigid("slab", SolidOf(geometry::Box{{1, 1, 0.1}}, 1000), At(0, 0, 0.55));
  ASSERT_TRUE(world.Start());
  world.Run(3, 0.01);
  EXPECT_WITHIN(world.position("slab").z, 0.55, 1e-4, "m");
}

// Coulomb's friction is isotropic: the deceleration is µ g in each direction, and whether a box on
// an incline slides does not depend on its heading.
TEST(RigidFidelity, FrictionIsTheSameInEveryDirection) {
  const double mu = 0.3, angle = 0.35;  // tan 0.35 = 0.365
  for (int i = 0; i < 8; ++i) {
    const double heading = i * 0.2;
    const geometry::Quaternion turn = geometry::FromAxisAngle({0, 0, 1}, heading);
    const Pose incline{{}, turn * geometry::FromAxisAngle({0, 1, 0}, angle)};
    TestWorld world(MakeWorldEngine());
    world.AddStatic("incline", testing::GroundOf(SurfaceOf(mu, 0)), incline);
    world.AddRigid("box", SolidOf(geometry::Box{{0.4, 0.4, 0.1}}, 1), incline * At(0, 0, 0.05));
    ASSERT_TRUE(world.Start());
    world.Run(1, 0.01);
    const double slid = (Inverse(incline) * world.position("box")).x;
    EXPECT_WITHIN_PERCENT(slid, kG * (std::sin(angle) - mu * std::cos(angle)) / 2, 1) << heading;
  }
}

TEST(RigidFidelity, EnergyNeverGrows) {
  TestWorld world = WorldOnGround(SurfaceOf(0.6, 1));
  const model::Surface bouncy = SurfaceOf(0.6, 0.6);
  world.AddRigid("ball", SolidOf(geometry::Sphere{0.2}, 1, bouncy), At(0, 0, 2));
  world.AddRigid("box", SolidOf(geometry::Box{{0.3, 0.4, 0.5}}, 2, bouncy), At(0.1, 0.1, 1));
  world.AddRigid("can", SolidOf(geometry::Cylinder{0.1, 0.3}, 1, bouncy), At(1, 0, 1));
  ASSERT_TRUE(world.Start());
  world.body("box").angular_velocity = {3, 5, 1};
  world.body("can").linear_velocity = {-2, 0, 1};
  double energy = EnergyOf(world);
  const double most = energy;
  base::testing::Table table("energy");
  for (int i = 0; i < 5000; ++i) {
    world.Step(kStep);
    const double now = EnergyOf(world);
    if (i % 5 == 0) table.Row({kStep * (i + 1), now});
    // The tolerance covers the error of a rotation in a substep, and the small overlap that
    // contacts permit.
    ASSERT_WITHIN(100 * std::max(now - energy, 0.0) / most, 0, 0.02, "% a step") << i;
    energy = now;
  }
  EXPECT_LT(energy, 0.8 * most);
}

TEST(RigidFidelity, AFastBodyDoesNotCrossAThinWall) {
  base::testing::Table table("wall");
  for (const double speed : {5.0, 10.0, 20.0, 30.0, 50.0, 70.0, 90.0}) {
    std::vector<double> row = {speed};
    for (const double step : {0.001, 0.01, 0.1}) {
      TestWorld world = WorldOnGround();
      world.AddBox("wall", {0.002, 20, 20}, 3, 0);
      world.AddRigid("box", SolidOf(geometry::Box{{0.2, 0.2, 0.2}}, 1), At(0, 0, 5));
      ASSERT_TRUE(world.Start());
      world.body("box").linear_velocity = {speed, 0, 0};
      double furthest = 0;
      for (double time = 0; time < 0.8; time += step) {
        world.Step(step);
        furthest = std::max(furthest, world.position("box").x);
      }
      EXPECT_GT(furthest, 2.8) << speed << " m/s, step " << step;
      EXPECT_LT(furthest, 3) << speed << " m/s, step " << step;
      row.push_back(furthest);
    }
    table.Row(row);
  }
}

}  // namespace
}  // namespace gsv::dynamics
