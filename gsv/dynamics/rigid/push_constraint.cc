#include "gsv/dynamics/rigid/push_constraint.h"

namespace gsv::dynamics {

PushConstraint::PushConstraint(btRigidBody& body, const btVector3& point_in_world,
                               const btVector3& normal, double speed, double force)
    : btTypedConstraint(MAX_CONSTRAINT_TYPE, body),
      point_in_body_(body.getWorldTransform().inverse() * point_in_world),
      normal_(normal),
      speed_(speed),
      force_(force) {}

void PushConstraint::getInfo1(btConstraintInfo1* info) {
  info->m_numConstraintRows = 1;
  info->nub = 0;
}

void PushConstraint::getInfo2(btConstraintInfo2* info) {
  const btVector3 arm = getRigidBodyA().getWorldTransform().getBasis() * point_in_body_;
  const btVector3 turning = arm.cross(normal_);
  for (int i = 0; i < 3; ++i) {
    info->m_J1linearAxis[i] = normal_[i];
    info->m_J1angularAxis[i] = turning[i];
  }
  info->m_constraintError[0] = speed_;
  info->m_lowerLimit[0] = 0;
  info->m_upperLimit[0] = force_ / info->fps;
}

double PushConstraint::Achieved() const {
  const btRigidBody& body = getRigidBodyA();
  return body.getVelocityInLocalPoint(body.getWorldTransform().getBasis() * point_in_body_)
      .dot(normal_);
}

}  // namespace gsv::dynamics
