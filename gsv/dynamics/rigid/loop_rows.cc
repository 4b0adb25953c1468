#include "gsv/dynamics/rigid/loop_rows.h"

#include <limits>

namespace gsv::dynamics {
namespace {

using model::JointKind;

constexpr double kNoBound = std::numeric_limits<double>::infinity();
constexpr double kCorrection = 0.2;  // share of the drift that a substep takes back

int LinearRows(JointKind kind) { return kind == JointKind::kPrismatic ? 2 : 3; }

int AngularRows(JointKind kind) {
  if (kind == JointKind::kBall) return 0;
  return kind == JointKind::kRevolute || kind == JointKind::kContinuous ? 2 : 3;
}

// The small rotation from one frame to the other, in the world.
btVector3 RotationBetween(const btMatrix3x3& first, const btMatrix3x3& second) {
  btVector3 twice(0, 0, 0);
  for (int axis = 0; axis < 3; ++axis) {
    twice += first.getColumn(axis).cross(second.getColumn(axis));
  }
  return twice / 2;
}

}  // namespace

LoopRows::LoopRows(btMultiBody& tree, const End& first, const End& second, JointKind kind)
    : btMultiBodyConstraint(&tree, &tree, first.link, second.link,
                            LinearRows(kind) + AngularRows(kind), false,
                            MULTIBODY_CONSTRAINT_FIXED),
      first_(first),
      second_(second),
      linear_rows_(LinearRows(kind)),
      angular_rows_(AngularRows(kind)) {
  LoopRows::finalizeMultiDof();
}

void LoopRows::finalizeMultiDof() {
  allocateJacobiansMultiDof();
  m_numDofsFinalized = m_jacSizeBoth;
}

int LoopRows::getIslandIdA() const { return m_bodyA->getBaseCollider()->getIslandTag(); }

btTransform LoopRows::WorldFromJoint(const End& end) const {
  const btTransform world_from_link = end.link < 0
                                          ? m_bodyA->getBaseWorldTransform()
                                          : m_bodyA->getLink(end.link).m_cachedWorldTransform;
  return world_from_link * end.link_from_joint;
}

// One direction in which the first end moves relative to the second at this rate.
void LoopRows::AddRow(int index, const btVector3& linear, const btVector3& angular,
                      const btVector3& point, double rate, btMultiBodyConstraintArray& rows,
                      btMultiBodyJacobianData& bullet, const btContactSolverInfo& info) {
  const btVector3 zero(0, 0, 0);
  btScalar* const jacobian = jacobianA(index);
  btScalar* const second = jacobianB(index);
  for (const auto& [end, into] : {std::pair{&first_, jacobian}, std::pair{&second_, second}}) {
    m_bodyA->fillConstraintJacobianMultiDof(end->link, point, angular, linear, into,
                                            bullet.scratch_r, bullet.scratch_v, bullet.scratch_m);
  }
  for (int i = 0; i < m_jacSizeA; ++i) jacobian[i] -= second[i];
  btMultiBodySolverConstraint& row = rows.expandNonInitializing();
  row.m_orgConstraint = this;
  row.m_orgDofIndex = index;
  fillMultiBodyConstraint(row, bullet, jacobian, nullptr, zero, zero, zero, zero, 0, info,
                          -kNoBound, kNoBound, true, 1, false, rate);
  row.m_contactNormal1 = row.m_contactNormal2 = zero;
  row.m_relpos1CrossNormal = row.m_relpos2CrossNormal = zero;
}

void LoopRows::createConstraintRows(btMultiBodyConstraintArray& rows,
                                    btMultiBodyJacobianData& bullet,
                                    const btContactSolverInfo& info) {
  const btTransform first = WorldFromJoint(first_), second = WorldFromJoint(second_);
  const btVector3 gap = second.getOrigin() - first.getOrigin();
  const btVector3 rotation =
      angular_rows_ == 2 ? first.getBasis().getColumn(2).cross(second.getBasis().getColumn(2))
                         : RotationBetween(first.getBasis(), second.getBasis());
  const double gain = kCorrection / info.m_timeStep;
  const btVector3 zero(0, 0, 0);
  for (int i = 0; i < linear_rows_ + angular_rows_; ++i) {
    const bool is_linear = i < linear_rows_;
    const btVector3 axis = first.getBasis().getColumn(is_linear ? i : i - linear_rows_);
    AddRow(i, is_linear ? axis : zero, is_linear ? zero : axis, second.getOrigin(),
           gain * axis.dot(is_linear ? gap : rotation), rows, bullet, info);
  }
}

}  // namespace gsv::dynamics
