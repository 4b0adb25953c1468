// The rows of constraint of a joint that closes a loop of links (a four-bar linkage, a scissor
// lift): it holds two links of one tree together. Private to this folder: it includes Bullet.
//
// Drift  what the linear velocity constraints leave open is taken back in part each substep
//        (Baumgarte, "Stabilization of constraints and integrals of motion in dynamical systems",
//        1972).
#pragma once

#include <span>

#include <BulletDynamics/Featherstone/btMultiBodyConstraint.h>

#include "gsv/dynamics/rigid/bullet_types.h"
#include "gsv/model/model.h"

namespace gsv::dynamics {

class LoopRows final : public btMultiBodyConstraint {
 public:
  // Each end is a link of the tree (-1: its base) with the joint's frame in it. The z axis is the
  // joint's. `kind` is fixed, revolute, continuous, prismatic or ball.
  struct End {
    int link;
    btTransform link_from_joint;
  };
  LoopRows(btMultiBody& tree, const End& first, const End& second, model::JointKind kind);

  void finalizeMultiDof() override;
  int getIslandIdA() const override;
  int getIslandIdB() const override { return getIslandIdA(); }
  void createConstraintRows(btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& bullet,
                            const btContactSolverInfo& info) override;
  void debugDraw(btIDebugDraw*) override {}

 private:
  btTransform WorldFromJoint(const End& end) const;
  void AddRow(int index, const btVector3& linear, const btVector3& angular, const btVector3& point,
              double rate, btMultiBodyConstraintArray& rows, btMultiBodyJacobianData& bullet,
              const btContactSolverInfo& info);

  const End first_, second_;
  const int linear_rows_, angular_rows_;  // about or along x, then y, then z of the joint
};

}  // namespace gsv::dynamics
