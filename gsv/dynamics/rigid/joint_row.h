// One constraint row on one joint of a tree. It moves, brakes, damps or limits the joint. Private
// to this folder: it includes Bullet.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyJointMotor.h>

namespace gsv::dynamics {

class JointRow final : public btMultiBodyJointMotor {
 public:
  JointRow(btMultiBody& tree, int link);

  // Holds the joint at a rate (rad/s or m/s) by an impulse (N m s or N s) from `lower` to `upper`.
  // If both are 0, the row does nothing.
  void Set(double rate, double lower, double upper);
  // Gives way: the rate misses `rate` by `softness` times the impulse, which has no bounds.
  void Soften(double rate, double softness);

  btMultiBody& tree() const { return *m_bodyA; }
  // Of the joint, among the tree's velocities.
  int velocity() const { return 6 + m_bodyA->getLink(m_linkA).m_dofOffset; }
  double rate() const { return m_desiredVelocity; }
  double lower() const { return lower_; }
  double upper() const { return upper_; }
  double softness() const { return softness_; }

  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& bullet,
                            const btContactSolverInfo& info) override;

 private:
  double lower_ = 0, upper_ = 0, softness_ = 0;
};

}  // namespace gsv::dynamics
