#include "gsv/dynamics/motion/articulation.h"

#include <numbers>

#include <gtest/gtest.h>

namespace gsv::dynamics {
namespace {

model::Link LinkAt(double x, double mass) {
  model::Link link;
  link.model_from_link.position = {x, 0, 0};
  link.inertial.mass = mass;
  link.inertial.ixx = link.inertial.iyy = link.inertial.izz = 0.5;
  return link;
}

model::Joint JointBetween(int parent, int child, model::JointKind kind) {
  model::Joint joint;
  joint.parent = parent;
  joint.child = child;
  joint.kind = kind;
  return joint;
}

TEST(Articulation, FixedLinksAreOnePart) {
  model::Model model;
  model.links = {LinkAt(0, 1), LinkAt(3, 2), LinkAt(5, 4)};
  model.joints = {JointBetween(0, 1, model::JointKind::kFixed),
                  JointBetween(1, 2, model::JointKind::kRevolute)};
  const Articulation articulation = MakeArticulation(model);
  ASSERT_EQ(articulation.parts.size(), 2u);
  EXPECT_EQ(articulation.part_of_link, (std::vector<int>{0, 0, 1}));
  EXPECT_EQ(articulation.parts[1].joint, 1);
  EXPECT_EQ(articulation.parts[1].parent, 0);
  EXPECT_FALSE(articulation.is_fixed);
  EXPECT_DOUBLE_EQ(articulation.mass, 7);
  // Two bodies, of 1 kg at 0 m and of 2 kg at 3 m, have their common centre of mass at 2 m. The
  // moment of inertia about that centre, perpendicular to the line between them, is 0.5 + 0.5 + 1 *
  // 2² + 2 * 1² = 7 kg m².
  const Part& base = articulation.parts[0];
  EXPECT_DOUBLE_EQ(base.mass, 3);
  EXPECT_NEAR(base.model_from_part.position.x, 2, 1e-12);
  EXPECT_NEAR(base.inertia.x, 1, 1e-12);
  EXPECT_NEAR(base.inertia.y, 7, 1e-12);
  EXPECT_NEAR(base.inertia.z, 7, 1e-12);
}

TEST(Articulation, ComputesThePrincipalAxes) {
  // A body with the moments 1, 2 and 3, given in axes that are rotated relative to its principal
  // axes.
  const geometry::Quaternion turned = geometry::FromRollPitchYaw({0.3, -0.5, 1.1});
  model::Model model;
  model.links = {LinkAt(0, 1)};
  model::Inertial& inertial = model.links[0].inertial;
  const auto product = [&](const geometry::Vector3& a, const geometry::Vector3& b) {
    const auto p = turned * a, q = turned * b;
    return 1 * p.x * q.x + 2 * p.y * q.y + 3 * p.z * q.z;
  };
  const geometry::Vector3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  inertial.ixx = product(x, x), inertial.iyy = product(y, y), inertial.izz = product(z, z);
  inertial.ixy = product(x, y), inertial.ixz = product(x, z), inertial.iyz = product(y, z);
  const Part part = MakeArticulation(model).parts[0];
  // The order of the principal axes is arbitrary. For each axis, a torque about it must cause the
  // angular acceleration torque / moment of inertia.
  for (const auto& [axis, moment] :
       {std::pair(x, part.inertia.x), std::pair(y, part.inertia.y), std::pair(z, part.inertia.z)}) {
    const auto a = turned * (part.model_from_part.orientation * axis);
    EXPECT_NEAR(1 * a.x * a.x + 2 * a.y * a.y + 3 * a.z * a.z, moment, 1e-12);
    EXPECT_NEAR(std::max({std::abs(a.x), std::abs(a.y), std::abs(a.z)}), 1, 1e-9);
  }
}

TEST(Articulation, ModelOnAJointToTheWorldHasAFixedBase) {
  model::Model model;
  model.links = {LinkAt(0, 1), LinkAt(1, 1)};
  model.joints = {JointBetween(-1, 0, model::JointKind::kFixed),
                  JointBetween(0, 1, model::JointKind::kPrismatic)};
  EXPECT_TRUE(MakeArticulation(model).is_fixed);
  EXPECT_EQ(MakeArticulation(model).parts.size(), 2u);
}

}  // namespace
}  // namespace gsv::dynamics
