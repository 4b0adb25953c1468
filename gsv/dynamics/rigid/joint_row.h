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

  // Gives way as with Soften(), by an impulse from `lower` to `upper`.
  void Demand(double rate, double softness, double lower, double upper);

  // From now on, what it holds at a rate is the joint's position less `ratio` times that of another
  // joint of the tree, which gets the impulse's reaction: -ratio times the impulse.
  void Couple(int other_link, double ratio);

  btMultiBody& tree() const { return *m_bodyA; }
  // Of the joint, among the tree's velocities.
  int velocity() const { return 6 + m_bodyA->getLink(m_linkA).m_dofOffset; }
  double rate() const { return m_desiredVelocity; }
  double lower() const { return lower_; }
  double upper() const { return upper_; }
  double softness() const { return softness_; }
  // The velocity and the ratio of Couple(). Uncoupled: its own, and 0.
  int other_velocity() const { return 6 + m_bodyA->getLink(other_link_).m_dofOffset; }
  double ratio() const { return ratio_; }

  void finalizeMultiDof() override;
  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& bullet,
                            const btContactSolverInfo& info) override;

 private:
  double lower_ = 0, upper_ = 0, softness_ = 0;
  int other_link_;
  double ratio_ = 0;
};

}  // namespace gsv::dynamics
