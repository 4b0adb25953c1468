// The rows of contacts and joints of trees of links, written to Bullet's arrays. ImpulseSolver takes them from
// there.
#include <algorithm>
#include <utility>

#include <BulletCollision/NarrowPhaseCollision/btPersistentManifold.h>
#include <BulletDynamics/Featherstone/btMultiBodyLinkCollider.h>

#include "gsv/dynamics/rigid/impulse_solver.h"

namespace gsv::dynamics {
namespace {

// The velocity of a rigid body of Bullet's at a point at the end of a step, without impulses, m/s.
btVector3 VelocityOfPoint(const btRigidBody& body, const btVector3& arm, double seconds) {
  const btVector3 turning = body.getInvInertiaTensorWorld() * body.getTotalTorque() * seconds;
  return body.getVelocityInLocalPoint(arm) + turning.cross(arm) +
         body.getTotalForce() * body.getInvMass() * seconds;
}

void CountPoints(btPersistentManifold& manifold) {
  const auto is_solved = [&](const btManifoldPoint& point) {
    return point.getDistance() <= manifold.getContactProcessingThreshold();
  };
  int count = 0;
  for (int i = 0; i < manifold.getNumContacts(); ++i)
    count += is_solved(manifold.getContactPoint(i));
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    auto* const axes = static_cast<FrictionAxes*>(manifold.getContactPoint(i).m_userPersistentData);
    if (axes != nullptr) axes->points = std::max(count, 1);
  }
}

}  // namespace

void ImpulseSolver::convertContacts(btPersistentManifold** manifolds, int count,
                                    const btContactSolverInfo& info) {
  tree_mass_count_ = 0;
  // Bullet frees these for each substep, and lets them grow row by row.
  m_data.m_jacobians.reserve(jacobian_count_);
  m_data.m_deltaVelocitiesUnitImpulse.reserve(jacobian_count_);
  for (int i = 0; i < count; ++i) {
    btPersistentManifold& manifold = *manifolds[i];
    CountPoints(manifold);
    const auto* a = btMultiBodyLinkCollider::upcast(manifold.getBody0());
    const auto* b = btMultiBodyLinkCollider::upcast(manifold.getBody1());
    const auto is_small = [](const btMultiBodyLinkCollider* collider) {
      return collider == nullptr || TreeMass::SizeOf(*collider->m_multiBody) <= TreeMass::kMaxSize;
    };
    if (a == nullptr && b == nullptr) {
      convertContact(&manifold, info);
    } else if (is_small(a) && is_small(b)) {
      AddTreeContacts(manifold, info);
    } else {
      convertMultiBodyContact(&manifold, info);
    }
  }
  AddJointRows(info);
  jacobian_count_ = std::max(jacobian_count_, m_data.m_jacobians.size());
}

TreeMass& ImpulseSolver::MassOf(btMultiBody& tree) {
  const int known = tree.getUserIndex();
  if (known >= 0 && known < tree_mass_count_ &&
      tree_masses_[static_cast<std::size_t>(known)].tree() == &tree) {
    return tree_masses_[static_cast<std::size_t>(known)];
  }
  tree.setUserIndex(tree_mass_count_);
  if (tree_masses_.size() == static_cast<std::size_t>(tree_mass_count_)) {
    tree_masses_.emplace_back();
  }
  TreeMass& mass = tree_masses_[static_cast<std::size_t>(tree_mass_count_++)];
  mass.Set(tree);
  return mass;
}

// Where the tree's changes of velocities begin.
int ImpulseSolver::DeltaVelocityOf(btMultiBody& tree) {
  if (tree.getCompanionId() < 0) {
    const int first = m_data.m_deltaVelocities.size();
    tree.setCompanionId(first);
    m_data.m_deltaVelocities.resize(first + TreeMass::SizeOf(tree), 0);
  }
  return tree.getCompanionId();
}

// Returns the index at which a new row's jacobian and response begin. They are not initialised.
int ImpulseSolver::NewJacobian(int size) {
  const int first = m_data.m_jacobians.size();
  m_data.m_jacobians.resizeNoInitialize(first + size);
  m_data.m_deltaVelocitiesUnitImpulse.resizeNoInitialize(first + size);
  return first;
}

void ImpulseSolver::AddJointRows(const btContactSolverInfo& info) {
  other_joints_.clear();
  for (int i = 0; i < m_tmpNumMultiBodyConstraints; ++i) {
    btMultiBodyConstraint* const joint = m_tmpMultiBodyConstraints[i];
    const auto* row = dynamic_cast<const JointRow*>(joint);
    if (row == nullptr || TreeMass::SizeOf(row->tree()) > TreeMass::kMaxSize) {
      other_joints_.push_back(joint);
    } else if (row->lower() != 0 || row->upper() != 0) {
      AddJointRow(*row);
    }
  }
  // Bullet writes the others, before or after.
  const int count =
      std::exchange(m_tmpNumMultiBodyConstraints, static_cast<int>(other_joints_.size()));
  auto** const all = std::exchange(m_tmpMultiBodyConstraints, other_joints_.data());
  btMultiBodyConstraintSolver::convertContacts(nullptr, 0, info);
  m_tmpNumMultiBodyConstraints = count;
  m_tmpMultiBodyConstraints = all;
}

void ImpulseSolver::AddJointRow(const JointRow& joint) {
  btMultiBody& tree = joint.tree();
  const TreeMass& mass = MassOf(tree);
  const auto response = mass.ResponseTo(joint.velocity());
  const auto reaction = mass.ResponseTo(joint.other_velocity());
  const auto velocity = static_cast<std::size_t>(joint.velocity());
  const auto other = static_cast<std::size_t>(joint.other_velocity());
  const double ratio = joint.ratio();
  const auto response_of = [&](std::size_t i) { return response[i] - ratio * reaction[i]; };
  auto& row = m_multiBodyNonContactConstraints.expandNonInitializing();
  row = btMultiBodySolverConstraint();
  row.m_contactNormal1 = row.m_contactNormal2 = btVector3(0, 0, 0);
  row.m_relpos1CrossNormal = row.m_relpos2CrossNormal = btVector3(0, 0, 0);
  row.m_multiBodyA = &tree;
  row.m_deltaVelAindex = DeltaVelocityOf(tree);
  row.m_deltaVelBindex = row.m_jacBindex = -1;
  row.m_jacAindex = NewJacobian(static_cast<int>(response.size()));
  for (std::size_t i = 0; i < response.size(); ++i) {
    m_data.m_jacobians[row.m_jacAindex + static_cast<int>(i)] =
        i == velocity ? 1 : (i == other ? -ratio : 0);
    m_data.m_deltaVelocitiesUnitImpulse[row.m_jacAindex + static_cast<int>(i)] = response_of(i);
  }
  row.m_originalContactPoint = nullptr;
  row.m_appliedImpulse = row.m_appliedPushImpulse = row.m_rhsPenetration = 0;
  row.m_friction = 0;
  row.m_jacDiagABInv = 1 / (response_of(velocity) - ratio * response_of(other) + joint.softness());
  const btScalar* const velocities = tree.getVelocityVector();
  row.m_cfm = joint.softness() * row.m_jacDiagABInv;
  row.m_rhs =
      (joint.rate() - (velocities[velocity] - ratio * velocities[other])) * row.m_jacDiagABInv;
  row.m_lowerLimit = joint.lower();
  row.m_upperLimit = joint.upper();
}

ImpulseSolver::ContactSide ImpulseSolver::SideOfContact(const btCollisionObject& object,
                                                        const btVector3& point, double sign,
                                                        const btContactSolverInfo& info) {
  ContactSide side;
  side.sign = sign;
  // Bullet's own solver does the same
  auto& mutable_object = const_cast<btCollisionObject&>(object);
  auto* collider = btMultiBodyLinkCollider::upcast(&mutable_object);
  if (collider == nullptr) {
    side.solver_body = getOrInitSolverBody(mutable_object, info.m_timeStep);
    const btSolverBody& body = m_tmpSolverBodyPool[side.solver_body];
    side.body = body.m_originalBody;
    side.arm = point - body.getWorldTransform().getOrigin();
    return side;
  }
  side.tree = collider->m_multiBody;
  side.link = collider->m_link;
  side.size = TreeMass::SizeOf(*side.tree);
  side.mass = &MassOf(*side.tree);
  side.arm =
      point - (side.link < 0 ? side.tree->getBasePos()
                             : side.tree->getLink(side.link).m_cachedWorldTransform.getOrigin());
  side.delta_velocity = DeltaVelocityOf(*side.tree);
  const auto motions = side.mass->MotionOf(side.link, point);
  std::copy(motions.begin(), motions.end(), side.motions.begin());
  return side;
}

// Adds the row's part of one side. Returns J M⁻¹ Jᵀ, and adds to `velocity` that along the row.
double ImpulseSolver::WriteSide(const ContactSide& side, const btVector3& axis, double seconds,
                                int& jacobian_index, btVector3& turning_response,
                                double& velocity) {
  if (side.tree == nullptr) {
    if (side.body == nullptr) return 0;
    const btVector3 turning = side.sign * side.arm.cross(axis);
    turning_response =
        side.body->getInvInertiaTensorWorld() * turning * side.body->getAngularFactor();
    velocity += side.sign * axis.dot(VelocityOfPoint(*side.body, side.arm, seconds));
    return side.body->getInvMass() + turning_response.dot(turning);
  }
  jacobian_index = NewJacobian(side.size);
  double* const jacobian = &m_data.m_jacobians[jacobian_index];
  double* const response = &m_data.m_deltaVelocitiesUnitImpulse[jacobian_index];
  const btScalar* const velocities = side.tree->getVelocityVector();
  for (int i = 0; i < side.size; ++i) {
    jacobian[i] = side.sign * axis.dot(side.motions[static_cast<std::size_t>(i)]);
    velocity += jacobian[i] * velocities[i];
  }
  side.mass->Respond(jacobian, response);
  double sum = 0;
  for (int i = 0; i < side.size; ++i) sum += jacobian[i] * response[i];
  return sum;
}

// The row asks for the velocity -v0 + `kept`, where v0 is what there is. Returns v0.
double ImpulseSolver::WriteContactRow(const ContactSide& a, const ContactSide& b,
                                      const btVector3& axis, btManifoldPoint& point,
                                      const btContactSolverInfo& info,
                                      btMultiBodySolverConstraint& row) {
  row.m_orgConstraint = nullptr;
  row.m_orgDofIndex = -1;
  row.m_multiBodyA = a.tree;
  row.m_multiBodyB = b.tree;
  row.m_linkA = a.link;
  row.m_linkB = b.link;
  row.m_solverBodyIdA = a.solver_body;
  row.m_solverBodyIdB = b.solver_body;
  row.m_deltaVelAindex = a.delta_velocity;
  row.m_deltaVelBindex = b.delta_velocity;
  row.m_originalContactPoint = &point;
  row.m_contactNormal1 = axis;
  row.m_contactNormal2 = -axis;
  row.m_relpos1CrossNormal = a.arm.cross(axis);
  row.m_relpos2CrossNormal = -b.arm.cross(axis);
  row.m_friction = point.m_combinedFriction;
  row.m_appliedImpulse = row.m_appliedPushImpulse = row.m_rhsPenetration = 0;
  row.m_jacAindex = row.m_jacBindex = -1;
  double velocity = 0;
  const double moved =
      WriteSide(a, axis, info.m_timeStep, row.m_jacAindex, row.m_angularComponentA, velocity) +
      WriteSide(b, axis, info.m_timeStep, row.m_jacBindex, row.m_angularComponentB, velocity);
  row.m_jacDiagABInv = moved > SIMD_EPSILON ? 1 / moved : 0;
  row.m_cfm = 0;
  return velocity;
}

void ImpulseSolver::AddTreeContacts(btPersistentManifold& manifold,
                                    const btContactSolverInfo& info) {
  for (int i = 0; i < manifold.getNumContacts(); ++i) {
    btManifoldPoint& point = manifold.getContactPoint(i);
    if (point.getDistance() > manifold.getContactProcessingThreshold()) continue;
    AddTreeContact(manifold, point, info);
  }
}

void ImpulseSolver::AddTreeContact(const btPersistentManifold& manifold, btManifoldPoint& point,
                                   const btContactSolverInfo& info) {
  constexpr double kNoBound = 1e10;
  const ContactSide a = SideOfContact(*manifold.getBody0(), point.getPositionWorldOnA(), 1, info);
  const ContactSide b = SideOfContact(*manifold.getBody1(), point.getPositionWorldOnB(), -1, info);
  const int index = m_multiBodyNormalContactConstraints.size();
  auto& normal = m_multiBodyNormalContactConstraints.expandNonInitializing();
  normal.m_frictionIndex = m_multiBodyFrictionContactConstraints.size();
  const double closing = WriteContactRow(a, b, point.m_normalWorldOnB, point, info, normal);
  const double bounce =
      restitutionCurve(closing, point.m_combinedRestitution, info.m_restitutionVelocityThreshold);
  const double distance = point.getDistance() + info.m_linearSlop;
  // A gap may close by the end of the step. An overlap is removed over several steps.
  const double share = distance > 0 ? 1 : info.m_erp2;
  normal.m_rhs = (std::max(bounce, 0.0) - closing - share * distance / info.m_timeStep) *
                 normal.m_jacDiagABInv;
  normal.m_lowerLimit = 0;
  normal.m_upperLimit = kNoBound;
  btVector3 axes[2];
  btPlaneSpace1(point.m_normalWorldOnB, axes[0], axes[1]);
  point.m_lateralFrictionDir1 = axes[0];
  point.m_lateralFrictionDir2 = axes[1];
  for (const btVector3& axis : axes) {
    auto& row = m_multiBodyFrictionContactConstraints.expandNonInitializing();
    row.m_frictionIndex = index;
    row.m_rhs = -WriteContactRow(a, b, axis, point, info, row) * row.m_jacDiagABInv;
    row.m_lowerLimit = -row.m_friction;
    row.m_upperLimit = row.m_friction;
  }
}

}  // namespace gsv::dynamics
