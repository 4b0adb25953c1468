// Tests the equations of motion of trees of links against closed forms and conservation laws.
#include "gsv/dynamics/rigid/link_tree.h"

#include <gtest/gtest.h>

#include "gsv/dynamics/testing/test_rigid_world.h"

namespace gsv::dynamics {
namespace {

using geometry::Vector3;
using model::JointKind;
using testing::At;
using testing::kG;

// Returns a link whose centre of mass is at a point of the model.
model::Link LinkAt(const Vector3& centre, double mass, const Vector3& inertia) {
  model::Link link;
  link.model_from_link.position = centre;
  link.inertial.mass = mass;
  link.inertial.ixx = inertia.x;
  link.inertial.iyy = inertia.y;
  link.inertial.izz = inertia.z;
  return link;
}

model::Joint JointAt(const Vector3& at, int parent, int child, JointKind kind,
                     const Vector3& axis) {
  model::Joint joint;
  joint.kind = kind;
  joint.parent = parent;
  joint.child = child;
  joint.axis = axis;
  joint.model_from_joint.position = at;
  return joint;
}

// The link tree of a model at the origin, with given positions and velocities.
class Tree {
 public:
  explicit Tree(model::Model model) : model_(std::move(model)) {
    plan_.model = &model_;
    plan_.articulation = MakeArticulation(model_);
    state_.bodies.resize(1);
    state_.joint_positions.resize(model_.joints.size());
    state_.joint_velocities.resize(model_.joints.size());
    tree_.emplace(plan_);
  }

  world::State& state() { return state_; }
  LinkTree& tree() { return *tree_; }
  int parts() const { return static_cast<int>(plan_.articulation.parts.size()); }

  void Load() {
    tree_->Load(state_);
    tree_->Place();
    tree_->WriteMass();
    tree_->ClearForces();
  }
  // Accelerates the tree under gravity along -z.
  void Accelerate(double gravity, double seconds) {
    for (int i = 0; i < parts(); ++i) {
      tree_->AddForce(i, {0, 0, -gravity * tree_->part_mass(i)}, {});
    }
    tree_->Accelerate(seconds);
  }

 private:
  model::Model model_;
  RigidBody plan_;
  world::State state_;
  std::optional<LinkTree> tree_;
};

// Two links that hang below each other and turn about y. Spong, Hutchinson, Vidyasagar, "Robot
// Modeling and Control" (2006), section 7.3.2, with angles from the vertical.
TEST(LinkTree, DoublePendulumFollowsItsEquationsOfMotion) {
  const double m1 = 1.3, m2 = 0.7, l1 = 0.5, c1 = 0.2, c2 = 0.4, i1 = 0.03, i2 = 0.05;
  model::Model model;
  model.links = {LinkAt({0, 0, -c1}, m1, {0.01, i1, 0.02}),
                 LinkAt({0, 0, -l1 - c2}, m2, {0.02, i2, 0.04})};
  model.joints = {JointAt({}, -1, 0, JointKind::kContinuous, {0, 1, 0}),
                  JointAt({0, 0, -l1}, 0, 1, JointKind::kContinuous, {0, 1, 0})};
  for (const auto& [q1, q2, v1, v2] :
       {std::array{0.3, 0.9, 0.0, 0.0}, {-1.1, 2.0, 1.5, -2.5}, {2.4, -0.7, -3.0, 4.0}}) {
    Tree body(model);
    body.state().joint_positions = {q1, q2};
    body.state().joint_velocities = {v1, v2};
    body.Load();
    const LinkTree& tree = body.tree();
    ASSERT_EQ(tree.size(), 2);
    const double coupling = m2 * l1 * c2 * std::cos(q2);
    const double m22 = i2 + m2 * c2 * c2, m12 = m22 + coupling;
    const double m11 = i1 + m1 * c1 * c1 + m2 * l1 * l1 + m22 + 2 * coupling;
    EXPECT_NEAR(tree.mass(0, 0), m11, 1e-14);
    EXPECT_NEAR(tree.mass(1, 0), m12, 1e-14);
    EXPECT_NEAR(tree.mass(1, 1), m22, 1e-14);
    const double h = -m2 * l1 * c2 * std::sin(q2), step = 1e-3;
    const double outer = m2 * c2 * kG * std::sin(q1 + q2);
    const double r1 =
        -h * (2 * v1 * v2 + v2 * v2) - outer - (m1 * c1 + m2 * l1) * kG * std::sin(q1);
    const double r2 = h * v1 * v1 - outer;
    const double determinant = m11 * m22 - m12 * m12;
    body.Accelerate(kG, step);
    EXPECT_NEAR(tree.free()[0], v1 + step * (m22 * r1 - m12 * r2) / determinant, 1e-13);
    EXPECT_NEAR(tree.free()[1], v2 + step * (m11 * r2 - m12 * r1) / determinant, 1e-13);
    EXPECT_NEAR(tree.free_momenta()[0], m11 * v1 + m12 * v2 + step * r1, 1e-13);
    EXPECT_NEAR(tree.free_momenta()[1], m12 * v1 + m22 * v2 + step * r2, 1e-13);
  }
}

// Two hinges on one line, with a massless cross between them, rotate their link like one hinge.
TEST(LinkTree, ParallelAxesTurnAsOneHinge) {
  const double mass = 1.5, arm = 0.4, inertia = 0.02, angle = 0.6, step = 1e-3;
  model::Model model;
  model.links = {LinkAt({0, 0, -arm}, mass, {0.01, inertia, 0.03}), {}};
  model.links[1].inertial = {0, {}, 0, 0, 0};
  model.joints = {JointAt({}, -1, 1, JointKind::kContinuous, {0, 1, 0}),
                  JointAt({}, 1, 0, JointKind::kContinuous, {0, 1, 0})};
  Tree body(model);
  body.state().joint_positions = {angle, 0};
  body.Load();
  ASSERT_EQ(body.tree().size(), 2);
  body.Accelerate(kG, step);
  const double rate = -step * mass * kG * arm * std::sin(angle) / (inertia + mass * arm * arm);
  EXPECT_NEAR(body.tree().free()[0] + body.tree().free()[1], rate, 1e-12);
}

TEST(LinkTree, VelocitiesAreFiniteForExtremeMassRatios) {
  model::Model model;
  model.links = {LinkAt({}, 1e-14, {1e-20, 1e-20, 1e-20}), LinkAt({1, 0, 0}, 1e8, {1e8, 1e8, 1e8})};
  model.joints = {JointAt({0.5, 0, 0}, 0, 1, JointKind::kBall, {0, 0, 1})};
  Tree body(model);
  body.Load();
  body.Accelerate(kG, 1e-3);
  for (const double velocity : body.tree().free()) EXPECT_TRUE(std::isfinite(velocity));
}

// A cart with a hanging pole, as in textbooks.
TEST(LinkTree, CartAndPoleFollowTheirEquationsOfMotion) {
  const double cart = 2, pole = 0.5, c = 0.6, inertia = 0.04;
  model::Model model;
  model.links = {LinkAt({}, cart, {1, 1, 1}), LinkAt({0, 0, -c}, pole, {0.1, inertia, 0.2})};
  model.joints = {JointAt({}, -1, 0, JointKind::kPrismatic, {1, 0, 0}),
                  JointAt({}, 0, 1, JointKind::kContinuous, {0, -1, 0})};
  Tree body(model);
  const double q = 0.8, rate = 2.5, push = 3, step = 1e-3;
  body.state().joint_positions = {0.4, q};
  body.state().joint_velocities = {-0.7, rate};
  body.Load();
  LinkTree& tree = body.tree();
  tree.AddEffort(0, push);
  body.Accelerate(kG, step);
  const double m12 = pole * c * std::cos(q), m22 = inertia + pole * c * c, m11 = cart + pole;
  const double r1 = push + pole * c * std::sin(q) * rate * rate;
  const double r2 = -pole * kG * c * std::sin(q);
  const double determinant = m11 * m22 - m12 * m12;
  EXPECT_NEAR(tree.free()[0], -0.7 + step * (m22 * r1 - m12 * r2) / determinant, 1e-13);
  EXPECT_NEAR(tree.free()[1], rate + step * (m11 * r2 - m12 * r1) / determinant, 1e-13);
}

// A base in free fall with two branches: a hinge with a slider on it, and a screw.
model::Model Satellite() {
  model::Model model;
  model.links = {LinkAt({}, 3, {0.3, 0.2, 0.4}), LinkAt({0.4, 0.1, 0}, 1, {0.02, 0.03, 0.01}),
                 LinkAt({0.6, 0.1, 0.2}, 0.5, {0.01, 0.02, 0.02}),
                 LinkAt({-0.3, 0, 0.2}, 0.8, {0.02, 0.01, 0.03})};
  model.joints = {JointAt({0.2, 0, 0}, 0, 1, JointKind::kRevolute, {0, 0.6, 0.8}),
                  JointAt({0.4, 0.1, 0.1}, 1, 2, JointKind::kPrismatic, {0.8, 0, 0.6}),
                  JointAt({-0.2, 0, 0}, 0, 3, JointKind::kScrew, {0, 1, 0})};
  model.joints[2].thread_pitch = 0.1;
  return model;
}

void Tumble(Tree& body) {
  world::BodyState& base = body.state().bodies[0];
  base.world_from_model.orientation = geometry::FromAxisAngle({0.6, 0, 0.8}, 0.7);
  base.linear_velocity = {0.3, -0.2, 0.5};
  base.angular_velocity = {1.2, -0.8, 2};
  body.state().joint_positions = {0.5, 0.1, -0.4};
  body.state().joint_velocities = {1.5, -0.6, 2.5};
  body.Load();
}

struct Momentum {
  Vector3 linear, angular;  // `angular` is about the world's origin
};

Momentum MomentumOf(const Tree& body, const LinkTree& tree, const std::vector<Vector3>& inertias) {
  Momentum sum;
  for (int i = 0; i < body.parts(); ++i) {
    const Vector3 at = tree.position(i);
    const Vector3 linear = tree.part_mass(i) * tree.VelocityOf(i, at);
    const Vector3 spin = TransposeTimes(tree.rotation(i), tree.angular_velocity(i));
    sum.linear += linear;
    sum.angular +=
        Cross(at, linear) + tree.rotation(i) * Scaled(spin, inertias[static_cast<std::size_t>(i)]);
  }
  return sum;
}

// Without external forces, a step of h changes the momenta of a body only by the error of the
// integration. This error is proportional to h². With wrong equations, the change would be
// proportional to h.
TEST(LinkTree, FloatingTreeKeepsItsMomenta) {
  const model::Model model = Satellite();
  std::vector<Vector3> inertias;
  for (const Part& part : MakeArticulation(model).parts) inertias.push_back(part.inertia);
  double errors[2];
  for (const int halving : {0, 1}) {
    Tree body(model);
    Tumble(body);
    LinkTree& tree = body.tree();
    const Momentum before = MomentumOf(body, tree, inertias);
    const double step = halving == 0 ? 1e-4 : 0.5e-4;
    body.Accelerate(0, step);
    const std::vector<double> free(tree.free().begin(), tree.free().end());
    std::copy(free.begin(), free.end(), tree.velocities().begin());
    tree.Move(free, step);
    tree.Place();
    const Momentum after = MomentumOf(body, tree, inertias);
    errors[halving] = Norm(after.linear - before.linear) + Norm(after.angular - before.angular);
  }
  EXPECT_LT(errors[0], 1e-6);
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.05);
}

// The mass matrix gives the sum of the parts' kinetic energies. Respond() multiplies by the inverse
// of the mass matrix.
TEST(LinkTree, MassMatrixGivesTheKineticEnergyAndRespondInvertsIt) {
  const model::Model model = Satellite();
  const auto parts = MakeArticulation(model).parts;
  Tree body(model);
  Tumble(body);
  const LinkTree& tree = body.tree();
  const int n = tree.size();
  ASSERT_EQ(n, 9);
  const auto mass = [&](int i, int j) { return tree.mass(std::max(i, j), std::min(i, j)); };
  const auto v = tree.velocities();
  double energy = 0, expected = 0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      energy += mass(i, j) * v[static_cast<std::size_t>(i)] * v[static_cast<std::size_t>(j)] / 2;
    }
  }
  for (int i = 0; i < body.parts(); ++i) {
    const Vector3 linear = tree.VelocityOf(i, tree.position(i));
    const Vector3 spin = TransposeTimes(tree.rotation(i), tree.angular_velocity(i));
    expected += tree.part_mass(i) * Dot(linear, linear) / 2 +
                Dot(spin, Scaled(spin, parts[static_cast<std::size_t>(i)].inertia)) / 2;
  }
  EXPECT_NEAR(energy, expected, 1e-12);
  for (int k = 0; k < n; ++k) {
    std::vector<double> row(static_cast<std::size_t>(n));
    row[static_cast<std::size_t>(k)] = 1;
    tree.Respond(row);
    for (int i = 0; i < n; ++i) {
      double sum = 0;
      for (int j = 0; j < n; ++j) sum += mass(i, j) * row[static_cast<std::size_t>(j)];
      EXPECT_NEAR(sum, i == k ? 1 : 0, 1e-12) << i << " " << k;
    }
  }
}

}  // namespace
}  // namespace gsv::dynamics
