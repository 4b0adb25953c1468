// A Push as Bullet's solver takes it. Private to this folder: it includes Bullet.
#pragma once

#include "gsv/dynamics/rigid/bullet_types.h"

namespace gsv::dynamics {

// Holds a body's point at a speed along a direction, by a force that never pulls and has a limit.
class PushConstraint final : public btTypedConstraint {
 public:
  PushConstraint(btRigidBody& body, const btVector3& point_in_world, const btVector3& normal,
                 double speed, double force);

  void getInfo1(btConstraintInfo1* info) override;
  void getInfo2(btConstraintInfo2* info) override;
  void setParam(int, btScalar, int) override {}
  btScalar getParam(int, int) const override { return 0; }

  bool has_started() const { return has_started_; }
  void Start() { has_started_ = true; }
  void AfterSubstep() { impulse_ += m_appliedImpulse; }

  // m/s along the normal: of the body's point now.
  double Achieved() const;
  // N s: of all substeps.
  double impulse() const { return impulse_; }

 private:
  const btVector3 point_in_body_, normal_;
  const double speed_, force_;
  bool has_started_ = false;
  double impulse_ = 0;
};

}  // namespace gsv::dynamics
