#include "gsv/dynamics/rigid/tree_mass.h"

#include <cmath>

#include "gsv/base/check.h"

namespace gsv::dynamics {
namespace {

constexpr int kOfBase = 6;

std::size_t PlaceOf(int link) { return static_cast<std::size_t>(link + 1); }

btMatrix3x3 Outer(const btVector3& a, const btVector3& b) {
  return {a.x() * b.x(), a.x() * b.y(), a.x() * b.z(), a.y() * b.x(), a.y() * b.y(),
          a.y() * b.z(), a.z() * b.x(), a.z() * b.y(), a.z() * b.z()};
}

}  // namespace

void TreeMass::PlaceLinks() {
  const auto count = static_cast<std::size_t>(tree_->getNumLinks()) + 1;
  rotations_.resize(count);
  positions_.resize(count);
  motions_.resize(static_cast<std::size_t>(size_));
  rotations_[0] = tree_->getBaseWorldTransform().getBasis();
  positions_[0].setZero();
  for (int i = 0; i < 3; ++i) {
    btVector3 axis(0, 0, 0);
    axis[i] = 1;
    motions_[static_cast<std::size_t>(i)] = {axis, btVector3(0, 0, 0)};
    motions_[static_cast<std::size_t>(3 + i)] = {btVector3(0, 0, 0), axis};
  }
  for (int i = 0; i < tree_->getNumLinks(); ++i) {
    const btMultibodyLink& link = tree_->getLink(i);
    const std::size_t parent = PlaceOf(link.m_parent);
    const btMatrix3x3 rotation =
        rotations_[parent] * btMatrix3x3(link.m_cachedRotParentToThis.inverse());
    const btVector3 position = positions_[parent] + rotation * link.m_cachedRVector;
    rotations_[PlaceOf(i)] = rotation;
    positions_[PlaceOf(i)] = position;
    for (int d = 0; d < link.m_dofCount; ++d) {
      const btVector3 turning = rotation * link.getAxisTop(d);
      motions_[static_cast<std::size_t>(kOfBase + link.m_dofOffset + d)] = {
          turning, rotation * link.getAxisBottom(d) - turning.cross(position)};
    }
  }
}

void TreeMass::AddInertia(int link, double mass, const btVector3& local) {
  const btMatrix3x3& rotation = rotations_[PlaceOf(link)];
  const btVector3& at = positions_[PlaceOf(link)];
  btMatrix3x3 turning = rotation.scaled(local) * rotation.transpose();
  const double square = mass * at.length2();
  turning += btMatrix3x3(square, 0, 0, 0, square, 0, 0, 0, square);
  turning -= Outer(mass * at, at);
  inertias_.push_back({mass, mass * at, turning});
}

// The momentum of what hangs from `link`, as `velocity` moves it, along the velocities of all that
// carries it.
void TreeMass::WriteMassesOf(int link, int velocity) {
  const Inertia& inertia = inertias_[PlaceOf(link)];
  const auto& [turning, moving] = motions_[static_cast<std::size_t>(velocity)];
  const btVector3 linear = inertia.mass * moving + turning.cross(inertia.moment);
  const btVector3 angular = inertia.turning * turning + inertia.moment.cross(moving);
  const auto write = [&](int other) {
    if (other > velocity) return;
    const Motion& motion = motions_[static_cast<std::size_t>(other)];
    MassAt(velocity, other) = motion.turning.dot(angular) + motion.moving.dot(linear);
  };
  for (int at = link; at >= 0; at = tree_->getLink(at).m_parent) {
    const btMultibodyLink& of = tree_->getLink(at);
    for (int d = 0; d < of.m_dofCount; ++d) write(kOfBase + of.m_dofOffset + d);
  }
  for (int d = first_; d < kOfBase; ++d) write(d);
}

void TreeMass::WriteMasses() {
  inertias_.clear();
  AddInertia(-1, tree_->getBaseMass(), tree_->getBaseInertia());
  for (int i = 0; i < tree_->getNumLinks(); ++i) {
    AddInertia(i, tree_->getLinkMass(i), tree_->getLinkInertia(i));
  }
  masses_.assign(static_cast<std::size_t>(size_ * size_), 0);
  for (int i = tree_->getNumLinks() - 1; i >= 0; --i) {
    const btMultibodyLink& link = tree_->getLink(i);
    for (int d = 0; d < link.m_dofCount; ++d) WriteMassesOf(i, kOfBase + link.m_dofOffset + d);
    Inertia& parent = inertias_[PlaceOf(link.m_parent)];
    const Inertia& own = inertias_[PlaceOf(i)];
    parent.mass += own.mass;
    parent.moment += own.moment;
    parent.turning += own.turning;
  }
  for (int d = first_; d < kOfBase; ++d) WriteMassesOf(-1, d);
}

// The lower triangle becomes its root.
bool TreeMass::Decompose() {
  for (int j = first_; j < size_; ++j) {
    double diagonal = MassAt(j, j);
    for (int k = first_; k < j; ++k) diagonal -= MassAt(j, k) * MassAt(j, k);
    if (!(diagonal > 0)) return false;
    const double root = std::sqrt(diagonal), inverse = 1 / root;
    MassAt(j, j) = root;
    for (int i = j + 1; i < size_; ++i) {
      double sum = MassAt(i, j);
      for (int k = first_; k < j; ++k) sum -= MassAt(i, k) * MassAt(j, k);
      MassAt(i, j) = sum * inverse;
    }
  }
  return true;
}

// One column after the other.
void TreeMass::Invert() {
  inverse_.assign(static_cast<std::size_t>(size_ * size_), 0);
  for (int column = first_; column < size_; ++column) {
    double* const x = inverse_.data() + static_cast<std::size_t>(column * size_);
    x[column] = 1;
    for (int i = column; i < size_; ++i) {
      for (int k = column; k < i; ++k) x[i] -= MassAt(i, k) * x[k];
      x[i] /= MassAt(i, i);
    }
    for (int i = size_ - 1; i >= first_; --i) {
      for (int k = i + 1; k < size_; ++k) x[i] -= MassAt(k, i) * x[k];
      x[i] /= MassAt(i, i);
    }
  }
}

void TreeMass::Set(const btMultiBody& tree) {
  tree_ = &tree;
  size_ = SizeOf(tree);
  GSV_CHECK(size_ <= kMaxSize);
  first_ = tree.hasFixedBase() ? kOfBase : 0;
  PlaceLinks();
  WriteMasses();
  GSV_CHECK(Decompose());
  Invert();
}

std::span<const btVector3> TreeMass::MotionOf(int link, const btVector3& point_in_world) {
  const btVector3 point = point_in_world - tree_->getBasePos();
  point_motions_.assign(static_cast<std::size_t>(size_), btVector3(0, 0, 0));
  const auto write = [&](int velocity) {
    const Motion& motion = motions_[static_cast<std::size_t>(velocity)];
    point_motions_[static_cast<std::size_t>(velocity)] =
        motion.moving + motion.turning.cross(point);
  };
  for (int d = first_; d < kOfBase; ++d) write(d);
  for (int at = link; at >= 0; at = tree_->getLink(at).m_parent) {
    const btMultibodyLink& of = tree_->getLink(at);
    for (int d = 0; d < of.m_dofCount; ++d) write(kOfBase + of.m_dofOffset + d);
  }
  return point_motions_;
}

void TreeMass::Respond(const double* jacobian, double* response) const {
  for (int i = 0; i < size_; ++i) response[i] = 0;
  for (int k = first_; k < size_; ++k) {
    if (jacobian[k] == 0) continue;
    const double* const column = inverse_.data() + static_cast<std::size_t>(k * size_);
    for (int i = first_; i < size_; ++i) response[i] += column[i] * jacobian[k];
  }
}

}  // namespace gsv::dynamics
