#include "gsv/dynamics/rigid/impulse_solver.h"

#include <cmath>

namespace gsv::dynamics {
namespace {

// Of a wheel or a foot under its robot's weight: a micrometre or so. Wheels and casters on one floor
// share the load, however little their heights differ.
constexpr double kGive = 0.02;

constexpr ImpulseRows::Axes kAsTheyAre{{{1, 0}, {0, 1}}};

// Bullet keeps rows divided by their inverse mass; a row of 0 is switched off.
template <typename BulletRow>
ImpulseRows::Limits LimitsOf(const BulletRow& row) {
  if (!(row.m_jacDiagABInv > 0)) return {};
  return {row.m_rhs / row.m_jacDiagABInv, row.m_cfm / row.m_jacDiagABInv, row.m_lowerLimit,
          row.m_upperLimit};
}

// m/s: contacts that close more slowly are not impacts.
constexpr double kImpact = 0.05;

// The share of the slip that friction takes in this substep. A contact that closes during the
// substep keeps a part of its closing speed: as much as takes the bodies together by the end. The
// next substep takes that part. Friction may not be faster than that: one point that sticks before
// it touches would throw a body that lands on two edges at once to one side.
template <typename BulletRow>
double ShareOfSlip(const BulletRow& normal, const btContactSolverInfo& info) {
  const auto& point = *static_cast<const btManifoldPoint*>(normal.m_originalContactPoint);
  const double kept = (point.getDistance() + info.m_linearSlop) / info.m_timeStep;
  const double taken = LimitsOf(normal).target;
  if (!(kept > kImpact) || !(taken > 0)) return 1;
  return taken / (taken + kept);
}

// For contacts of trees Bullet takes axes of the world, whatever the point asks for.
ImpulseRows::Axes AxesOf(const btMultiBodySolverConstraint& first,
                         const btMultiBodySolverConstraint& second) {
  const auto& point = *static_cast<const btManifoldPoint*>(first.m_originalContactPoint);
  const auto* axes = static_cast<const FrictionAxes*>(point.m_userPersistentData);
  if (axes == nullptr) return kAsTheyAre;
  const btVector3 &x = first.m_contactNormal1, &y = second.m_contactNormal1;
  return {{{axes->first.dot(x), axes->first.dot(y)}, {axes->second.dot(x), axes->second.dot(y)}}};
}

}  // namespace

void ImpulseSolver::AddBodies() {
  for (int i = 0; i < m_tmpSolverBodyPool.size(); ++i) {
    const btSolverBody& body = m_tmpSolverBodyPool[i];
    const btVector3 &v = body.m_deltaLinearVelocity, &w = body.m_deltaAngularVelocity;
    const double velocities[] = {v.x(), v.y(), v.z(), w.x(), w.y(), w.z()};
    rows_.AddBody(velocities);
  }
}

int ImpulseSolver::TreeOf(btMultiBody* body, int bullets_first) {
  for (int i = 0; i < trees_.size(); ++i) {
    if (trees_[i].body == body) return i;
  }
  const int count = body->getNumDofs() + 6;
  const btScalar* velocities = &m_data.m_deltaVelocities[bullets_first];
  const int first = rows_.AddBody({velocities, static_cast<std::size_t>(count)});
  trees_.push_back({body, bullets_first, first, count});
  return trees_.size() - 1;
}

ImpulseRows::Side ImpulseSolver::SideOf(btMultiBody* body, int velocity, int jacobian) {
  const Tree& tree = trees_[TreeOf(body, velocity)];
  const auto count = static_cast<std::size_t>(tree.count);
  return {tree.first,
          {&m_data.m_jacobians[jacobian], count},
          {&m_data.m_deltaVelocitiesUnitImpulse[jacobian], count}};
}

ImpulseRows::Side ImpulseSolver::SideOf(int solver_body, const btVector3& linear,
                                        const btVector3& angular, const btVector3& angular_response,
                                        int which) {
  if (solver_body < 0) return {};
  const btSolverBody& body = m_tmpSolverBodyPool[solver_body];
  if (body.m_originalBody == nullptr || body.m_invMass.isZero()) return {};
  const btVector3 linear_response = linear * body.m_invMass * body.m_linearFactor;
  const btVector3 turning = angular_response * body.m_angularFactor;
  for (int i = 0; i < 3; ++i) {
    jacobian_[which][i] = linear[i];
    jacobian_[which][3 + i] = angular[i];
    response_[which][i] = linear_response[i];
    response_[which][3 + i] = turning[i];
  }
  return {6 * solver_body, jacobian_[which], response_[which]};
}

void ImpulseSolver::AddRows(const btConstraintArray& rows) {
  for (int i = 0; i < rows.size(); ++i) {
    const btSolverConstraint& row = rows[i];
    const auto a = SideOf(row.m_solverBodyIdA, row.m_contactNormal1, row.m_relpos1CrossNormal,
                          row.m_angularComponentA, 0);
    const auto b = SideOf(row.m_solverBodyIdB, row.m_contactNormal2, row.m_relpos2CrossNormal,
                          row.m_angularComponentB, 1);
    rows_.AddRow(a, b, LimitsOf(row), row.m_appliedImpulse);
  }
}

// They give way by so much of their inverse mass.
void ImpulseSolver::AddRows(const btMultiBodyConstraintArray& rows, double give) {
  for (int i = 0; i < rows.size(); ++i) {
    const btMultiBodySolverConstraint& row = rows[i];
    const auto a = row.m_multiBodyA != nullptr
                       ? SideOf(row.m_multiBodyA, row.m_deltaVelAindex, row.m_jacAindex)
                       : SideOf(row.m_solverBodyIdA, row.m_contactNormal1, row.m_relpos1CrossNormal,
                                row.m_angularComponentA, 0);
    const auto b = row.m_multiBodyB != nullptr
                       ? SideOf(row.m_multiBodyB, row.m_deltaVelBindex, row.m_jacBindex)
                       : SideOf(row.m_solverBodyIdB, row.m_contactNormal2, row.m_relpos2CrossNormal,
                                row.m_angularComponentB, 1);
    ImpulseRows::Limits limits = LimitsOf(row);
    if (row.m_jacDiagABInv > 0) limits.softness += give / row.m_jacDiagABInv;
    rows_.AddRow(a, b, limits, row.m_appliedImpulse);
  }
}

// The rows lie one kind after the other, as Solve() takes them: constraints, contacts, friction.
void ImpulseSolver::AddCones(const btContactSolverInfo& info) {
  AddRows(m_tmpSolverNonContactConstraintPool);
  AddRows(m_multiBodyNonContactConstraints);
  const int normals =
      m_tmpSolverNonContactConstraintPool.size() + m_multiBodyNonContactConstraints.size();
  AddRows(m_tmpSolverContactConstraintPool);
  const int tree_normals = normals + m_tmpSolverContactConstraintPool.size();
  AddRows(m_multiBodyNormalContactConstraints, kGive);
  const int friction = tree_normals + m_multiBodyNormalContactConstraints.size();
  AddRows(m_tmpSolverContactFrictionConstraintPool);
  const int tree_friction = friction + m_tmpSolverContactFrictionConstraintPool.size();
  AddRows(m_multiBodyFrictionContactConstraints);
  for (int i = 0; i + 1 < m_tmpSolverContactFrictionConstraintPool.size(); i += 2) {
    const btSolverConstraint& row = m_tmpSolverContactFrictionConstraintPool[i];
    const double share = ShareOfSlip(m_tmpSolverContactConstraintPool[row.m_frictionIndex], info);
    for (const int of : {friction + i, friction + i + 1}) rows_.ScaleTarget(of, share);
    rows_.AddCone(normals + row.m_frictionIndex, friction + i, row.m_friction, kAsTheyAre);
  }
  for (int i = 0; i + 1 < m_multiBodyFrictionContactConstraints.size(); i += 2) {
    const btMultiBodySolverConstraint& row = m_multiBodyFrictionContactConstraints[i];
    const double share =
        ShareOfSlip(m_multiBodyNormalContactConstraints[row.m_frictionIndex], info);
    for (const int of : {tree_friction + i, tree_friction + i + 1}) rows_.ScaleTarget(of, share);
    rows_.AddCone(tree_normals + row.m_frictionIndex, tree_friction + i, row.m_friction,
                  AxesOf(row, m_multiBodyFrictionContactConstraints[i + 1]));
  }
}

void ImpulseSolver::Store() {
  int row = 0, cone = 0;
  const auto store = [&](auto& rows) {
    for (int i = 0; i < rows.size(); ++i) rows[i].m_appliedImpulse = rows_.impulse(row++);
  };
  const auto store_cones = [&](auto& rows) {
    for (int i = 0; i + 1 < rows.size(); i += 2) {
      const auto [x, y] = rows_.ConeImpulse(cone++);
      rows[i].m_appliedImpulse = x;
      rows[i + 1].m_appliedImpulse = y;
    }
  };
  store(m_tmpSolverNonContactConstraintPool);
  store(m_multiBodyNonContactConstraints);
  store(m_tmpSolverContactConstraintPool);
  store(m_multiBodyNormalContactConstraints);
  store_cones(m_tmpSolverContactFrictionConstraintPool);
  store_cones(m_multiBodyFrictionContactConstraints);
  for (int i = 0; i < m_tmpSolverBodyPool.size(); ++i) {
    const auto v = rows_.velocities(6 * i, 6);
    m_tmpSolverBodyPool[i].m_deltaLinearVelocity.setValue(v[0], v[1], v[2]);
    m_tmpSolverBodyPool[i].m_deltaAngularVelocity.setValue(v[3], v[4], v[5]);
  }
  for (int i = 0; i < trees_.size(); ++i) {
    const Tree& tree = trees_[i];
    const auto velocities = rows_.velocities(tree.first, tree.count);
    btScalar* bullets = &m_data.m_deltaVelocities[tree.bullets_first];
    for (int k = 0; k < tree.count; ++k) {
      bullets[k] = velocities[static_cast<std::size_t>(k)] - bullets[k];
    }
    tree.body->applyDeltaVeeMultiDof2(bullets, 1);
    tree.body->setPosUpdated(false);
  }
}

btScalar ImpulseSolver::solveGroupCacheFriendlyIterations(
    btCollisionObject** bodies, int body_count, btPersistentManifold** manifolds,
    int manifold_count, btTypedConstraint** constraints, int constraint_count,
    const btContactSolverInfo& info, btIDebugDraw* debug) {
  solveGroupCacheFriendlySplitImpulseIterations(bodies, body_count, manifolds, manifold_count,
                                                constraints, constraint_count, info, debug);
  rows_.Clear();
  trees_.resize(0);
  AddBodies();
  AddCones(info);
  rows_.Solve(info.m_numIterations, std::sqrt(info.m_leastSquaresResidualThreshold));
  Store();
  return 0;
}

}  // namespace gsv::dynamics
