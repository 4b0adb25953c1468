// Bullet's solver of contacts and constraints, with ImpulseRows for its iterations: friction is
// Coulomb's cone in every direction, and unequal masses converge. Private to this folder: it
// includes Bullet.
//
// Bullet's own iterations skew the cone of a jointed body's contact by the inverse masses along two
// axes of the world, so that how far a skid-steered robot turns depends on its heading. Those of a
// single body bound friction by a square. See docs/adr/040-own-iterations-in-bullet.md.
//
// Islands  bodies that act on each other, directly or through others, are solved apart from all
//          others: neither their number nor their state changes an island's result. See
//          docs/adr/062-islands-are-solved-apart.md.
#pragma once

#include <array>
#include <deque>
#include <vector>

#include <BulletDynamics/Featherstone/btMultiBodyConstraintSolver.h>

#include "gsv/base/thread_team.h"
#include "gsv/dynamics/rigid/impulse_rows.h"
#include "gsv/dynamics/rigid/joint_row.h"
#include "gsv/dynamics/rigid/tree_mass.h"

namespace gsv::dynamics {

// Where a surface has two frictions: the axes of a contact, of which the more slippery is shorter.
// A point's m_userPersistentData points to one, or is null.
struct FrictionAxes {
  btVector3 first, second;
  // m/(s N): the velocity of the slip along each axis per force; that of a wheel is for each rad/s.
  std::array<double, 2> slip{}, slip_per_rate{};
  const double* rate = nullptr;  // rad/s, of the wheel
  int points = 1;                // points of the contact, which share the force

  // In the units of a row along the axis, m/s per N s.
  std::array<double, 2> Softness(double seconds) const {
    std::array<double, 2> softness;
    for (std::size_t i = 0; i < 2; ++i) {
      const double of_wheel = rate == nullptr ? 0 : slip_per_rate[i] * *rate;
      softness[i] = points * (slip[i] + of_wheel) / seconds * (i == 0 ? first : second).length2();
    }
    return softness;
  }
};

class ImpulseSolver final : public btMultiBodyConstraintSolver {
 public:
  // `team`, which may be null, must outlive the solver. It solves islands, with the same results.
  explicit ImpulseSolver(base::ThreadTeam* team) : team_(team) {}

 protected:
  btScalar solveGroupCacheFriendlyIterations(btCollisionObject** bodies, int body_count,
                                             btPersistentManifold** manifolds, int manifold_count,
                                             btTypedConstraint** constraints, int constraint_count,
                                             const btContactSolverInfo& info,
                                             btIDebugDraw* debug) override;
  // Writes the rows of contacts and joints. Those of trees take their masses from TreeMass.
  void convertContacts(btPersistentManifold** manifolds, int count,
                       const btContactSolverInfo& info) override;

 private:
  // One of the two that a contact acts on: a tree of links, or a body of m_tmpSolverBodyPool.
  struct ContactSide {
    btMultiBody* tree = nullptr;
    int link = -1, size = 0, delta_velocity = 0;
    TreeMass* mass = nullptr;
    // motion of the point, by the tree's velocities
    std::array<btVector3, TreeMass::kMaxSize> motions;
    int solver_body = -1;
    btRigidBody* body = nullptr;  // null: nothing moves it
    btVector3 arm;                // vector from the centre of mass to the point
    double sign = 1;              // sign of the row's axis
  };
  // A body or a tree of links that impulses move.
  struct Node {
    btMultiBody* tree = nullptr;  // null: the body of m_tmpSolverBodyPool
    int bullets_first = 0;        // in the pool; of a tree in m_data.m_deltaVelocities
    int parent = 0;               // another node of the same island, or itself
    int island = -1;              // in islands_; -1: no row acts on it
    int first = 0, count = 0;     // range of its velocities in the island's rows
  };
  struct Island {
    ImpulseRows rows;
    std::vector<int> contacts;  // in m_tmpSolverContactConstraintPool
    int bodies = 0;
  };
  // The place to which a row of Bullet's was moved.
  struct Place {
    Island* island = nullptr;
    int row = 0;
  };

  TreeMass& MassOf(btMultiBody& tree);
  ContactSide SideOfContact(const btCollisionObject& object, const btVector3& point, double sign,
                            const btContactSolverInfo& info);
  int DeltaVelocityOf(btMultiBody& tree);
  int NewJacobian(int size);
  void AddJointRows(const btContactSolverInfo& info);
  void AddJointRow(const JointRow& joint);
  double WriteSide(const ContactSide& side, const btVector3& axis, double seconds,
                   int& jacobian_index, btVector3& turning_response, double& velocity);
  double WriteContactRow(const ContactSide& a, const ContactSide& b, const btVector3& axis,
                         btManifoldPoint& point, const btContactSolverInfo& info,
                         btMultiBodySolverConstraint& row);
  void AddTreeContact(const btPersistentManifold& manifold, btManifoldPoint& point,
                      const btContactSolverInfo& info);
  void AddTreeContacts(btPersistentManifold& manifold, const btContactSolverInfo& info);
  void AddNodes();
  int NodeOf(int solver_body) const;
  int NodeOf(btMultiBody* tree, int bullets_first);
  int NodeOf(const btSolverConstraint& row, bool is_first);
  int NodeOf(const btMultiBodySolverConstraint& row, bool is_first);
  int RootOf(int node);
  template <typename Rows>
  void Join(const Rows& rows);
  void JoinNodes();
  void NumberIslands();
  void AddBody(Node& node);
  Island& NewIsland();
  ImpulseRows::Side SideOf(const Node& node, const btSolverConstraint& row, bool is_first);
  ImpulseRows::Side SideOf(const Node& node, const btMultiBodySolverConstraint& row, bool is_first);
  template <typename Row>
  ImpulseRows::Side SideOfBody(const Node& node, const Row& row, bool is_first);
  template <typename Rows>
  void AddRows(const Rows& rows, double give = 0);
  void AddAllRows();
  template <typename Rows>
  void AddCones(const Rows& normals, const Rows& friction, int first_normal, int first_friction,
                const btContactSolverInfo& info);
  void AddAllCones(const btContactSolverInfo& info);
  void PushApart(const Island& island, int iterations, double tolerance);
  void SolveIslands(const btContactSolverInfo& info);
  template <typename Rows>
  void Store(Rows& rows, int first);
  template <typename Rows>
  void StoreCones(Rows& rows, int first_cone);
  void StoreVelocities();
  void StoreAll();

  base::ThreadTeam* team_;
  std::deque<TreeMass> tree_masses_;  // for this substep, by the trees' user index
  int tree_mass_count_ = 0;
  std::vector<btMultiBodyConstraint*> other_joints_;  // constraints that are not a JointRow
  int jacobian_count_ = 0;                            // the most values of jacobians so far
  std::vector<Node> nodes_;
  // by index in the pool; by bullets_first; -1 for none
  std::vector<int> node_of_body_, node_of_tree_;
  std::deque<Island> islands_;  // memory for as many as there have been
  std::size_t island_count_ = 0;
  std::vector<Place> rows_, cones_;         // in Bullet's order: constraints, contacts, friction
  double jacobian_[2][6], response_[2][6];  // for the row that is being added
};

}  // namespace gsv::dynamics
