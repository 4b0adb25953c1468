// Bullet's solver of contacts and constraints, with ImpulseRows for its iterations: friction is
// Coulomb's cone in every direction, and unequal masses converge. Private to this folder: it
// includes Bullet.
//
// Bullet's own iterations skew the cone of a jointed body's contact by the inverse masses along two
// axes of the world, so that how far a skid-steered robot turns depends on its heading. Those of a
// single body bound friction by a square. See docs/adr/040-own-iterations-in-bullet.md.
#pragma once

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>

#include "gsv/dynamics/rigid/impulse_rows.h"

namespace gsv::dynamics {

// Where a surface has two frictions: the axes of a contact, of which the more slippery is shorter.
// A point's m_userPersistentData points to one, or is null.
struct FrictionAxes {
  btVector3 first, second;
};

class ImpulseSolver final : public btMultiBodyConstraintSolver {
 protected:
  btScalar solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                             btPersistentManifold** manifolds, int manifold_count,
                                             btTypedConstraint** constraints, int constraint_count,
                                             const btContactSolverInfo& info,
                                             btIDebugDraw* debug) override;

 private:
  // A tree of links with rows in this group.
  struct Tree {
    btMultiBody* body;
    int bullets_first, first, count;  // in m_data.m_deltaVelocities; in rows_
  };

  void AddBodies();
  int TreeOf(btMultiBody* body, int bullets_first);
  ImpulseRows::Side SideOf(btMultiBody* body, int velocity, int jacobian);
  ImpulseRows::Side SideOf(int solver_body, const btVector3& linear, const btVector3& angular,
                           const btVector3& angular_response, int which);
  void AddRows(const btConstraintArray& rows);
  void AddRows(const btMultiBodyConstraintArray& rows, double give = 0);
  void AddCones(const btContactSolverInfo& info);
  void Store();

  ImpulseRows rows_;
  btAlignedObjectArray<Tree> trees_;
  double jacobian_[2][6], response_[2][6];  // of the row that is being added
};

}  // namespace gsv::dynamics
