#include "gsv/dynamics/rigid/joint_row.h"

#include <algorithm>
#include <limits>

namespace gsv::dynamics {

JointRow::JointRow(btMultiBody& tree, int link)
    : btMultiBodyJointMotor(&tree, link, 0.0, 0.0), other_link_(link) {}

void JointRow::Set(double rate, double lower, double upper) {
  setVelocityTarget(rate);
  lower_ = lower;
  upper_ = upper;
  softness_ = 0;
  // Bullet skips a motor whose maximum impulse is 0.
  setMaxAppliedImpulse(std::max(-lower, upper));
}

void JointRow::Soften(double rate, double softness) {
  constexpr double kNoBound = std::numeric_limits<double>::infinity();
  Set(rate, -kNoBound, kNoBound);
  softness_ = softness;
}

void JointRow::Demand(double rate, double softness, double lower, double upper) {
  Set(rate, lower, upper);
  softness_ = softness;
}

void JointRow::Couple(int other_link, double ratio) {
  other_link_ = other_link;
  ratio_ = ratio;
  m_numDofsFinalized = -1;
}

void JointRow::finalizeMultiDof() {
  btMultiBodyJointMotor::finalizeMultiDof();
  if (other_link_ != m_linkA) jacobianA(0)[6 + m_bodyA->getLink(other_link_).m_dofOffset] = -ratio_;
}

void JointRow::createConstraintRows(btMultiBodyConstraintArray& rows,
                                    btMultiBodyJacobianData& bullet,
                                    const btContactSolverInfo& info) {
  const int before = rows.size();
  btMultiBodyJointMotor::createConstraintRows(rows, bullet, info);
  for (int i = before; i < rows.size(); ++i) {
    btMultiBodySolverConstraint& row = rows[i];
    row.m_lowerLimit = lower_;
    row.m_upperLimit = upper_;
    // Bullet's row is divided by its inverse mass.
    const double inverse = row.m_jacDiagABInv / (1 + softness_ * row.m_jacDiagABInv);
    row.m_rhs *= row.m_jacDiagABInv > 0 ? inverse / row.m_jacDiagABInv : 0;
    row.m_cfm = softness_ * inverse;
    row.m_jacDiagABInv = inverse;
  }
}

}  // namespace gsv::dynamics
