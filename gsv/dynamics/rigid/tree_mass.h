// The inverse mass matrix of a tree of links. Private to this folder: it includes Bullet.
//
// Velocities  as btMultiBody has them: those of the base (angular, then linear, in the world), then
//             those of the joints, link by link.
// Method      the mass matrix by composite bodies (Featherstone, Rigid Body Dynamics Algorithms,
//             2008, section 6.2), its inverse by Cholesky's decomposition. A contact has three rows,
//             and a robot many contacts: for few degrees of freedom a matrix is cheaper than a walk
//             over the tree for each row.
#pragma once

#include <span>
#include <vector>

#include <BulletDynamics/Featherstone/btMultiBody.h>

namespace gsv::dynamics {

class TreeMass {
 public:
  static constexpr int kMaxSize = 64;
  // The number of velocities of a tree.
  static int SizeOf(const btMultiBody& tree) { return tree.getNumDofs() + 6; }

  // Of the tree where its links are now. It has at most kMaxSize velocities.
  void Set(const btMultiBody& tree);
  const btMultiBody* tree() const { return tree_; }

  // For each velocity of the tree the velocity of a point of a link by it; -1 is the base.
  std::span<const btVector3> MotionOf(int link, const btVector3& point_in_world);
  // The changes of all velocities by a unit impulse on one of them.
  std::span<const double> ResponseTo(int velocity) const {
    return std::span(inverse_).subspan(static_cast<std::size_t>(velocity * size_),
                                       static_cast<std::size_t>(size_));
  }
  // response = inverse mass * jacobian, both of the tree's size.
  void Respond(const double* jacobian, double* response) const;

 private:
  struct Motion {
    btVector3 turning, moving;  // moving: at the base's centre of mass
  };
  struct Inertia {
    double mass;
    btVector3 moment;     // mass times position
    btMatrix3x3 turning;  // about the base's centre of mass
  };

  void PlaceLinks();
  void AddInertia(int link, double mass, const btVector3& local);
  void WriteMasses();
  void WriteMassesOf(int link, int velocity);
  bool Decompose();
  void Invert();
  double& MassAt(int row, int column) {
    return masses_[static_cast<std::size_t>(row * size_ + column)];
  }

  const btMultiBody* tree_ = nullptr;
  int size_ = 0, first_ = 0;  // first_: 6 for a fixed base, whose velocities stay zero
  // rotations of the base and the links, like all members that follow
  std::vector<btMatrix3x3> rotations_;
  std::vector<btVector3> positions_;  // relative to the base's centre of mass
  std::vector<Inertia> inertias_;
  std::vector<Motion> motions_;  // by velocity
  std::vector<double> masses_, inverse_;
  std::vector<btVector3> point_motions_;
};

}  // namespace gsv::dynamics
