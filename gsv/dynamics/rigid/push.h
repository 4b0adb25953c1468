// How a planar robot pushes what is in its way: with the speed it wants, and no more force than its
// wheels can pass on to the ground. Private to this folder: it includes Bullet.
#pragma once

#include "gsv/dynamics/shapes/bullet_types.h"

namespace gsv::dynamics {

struct Push {
  int robot = 0, object = 0;  // bodies in the layout
  geometry::Vector3 point;    // in the world; z is chosen where the two face each other
  double low = 0;             // height from which on the robot pushes
  geometry::Vector3 normal;   // unit length, towards the object
  double speed = 0;           // m/s along the normal
  double force = 0;           // N, at most
  double start = 0;           // s into the step: when the robot gets there
  double achieved = 0;        // m/s along the normal: of the object after the step
};

// Holds a body's point at a speed along a direction, by a force that never pulls and has a limit.
class PushConstraint final : public btTypedConstraint {
 public:
  PushConstraint(btRigidBody& body, const btVector3& point_in_world, const btVector3& normal,
                 double speed, double force);

  void getInfo1(btConstraintInfo1* info) override;
  void getInfo2(btConstraintInfo2* info) override;
  void setParam(int, btScalar, int) override {}
  btScalar getParam(int, int) const override { return 0; }

  double Achieved() const;

  bool has_started() const { return has_started_; }
  void Start() { has_started_ = true; }

 private:
  const btVector3 point_in_body_, normal_;
  const double speed_, force_;
  bool has_started_ = false;
};

}  // namespace gsv::dynamics
