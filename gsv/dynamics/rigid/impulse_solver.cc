#include "gsv/dynamics/rigid/impulse_solver.h"

#include <algorithm>
#include <cmath>

#include "gsv/dynamics/motion/solver_count.h"

namespace gsv::dynamics {
namespace {

// Of a wheel or a foot under its robot's weight: a micrometre or so. Wheels and casters on one floor
// share the load, however little their heights differ.
constexpr double kGive = 0.02;

// Iterations: an island of few bodies has time for many.
constexpr int kMaxIterations = 80, kMinIterations = 25, kIterationsOfAll = 1600;

constexpr ImpulseRows::Axes kAsTheyAre{{{1, 0}, {0, 1}}};

// Bullet keeps rows divided by their inverse mass; a row of 0 is switched off.
template <typename BulletRow>
ImpulseRows::Limits LimitsOf(const BulletRow& row) {
  if (!(row.m_jacDiagABInv > 0)) return {};
  return {row.m_rhs / row.m_jacDiagABInv, row.m_cfm / row.m_jacDiagABInv, row.m_lowerLimit,
          row.m_upperLimit};
}

// m/s: contacts that close more slowly are not impacts.
constexpr double kImpact = 0.05;

// The share of the slip that friction takes in this substep. A contact that closes during the
// substep keeps a part of its closing speed: as much as takes the bodies together by the end. The
// next substep takes that part. Friction may not be faster than that: one point that sticks before
// it touches would throw a body that lands on two edges at once to one side.
template <typename BulletRow>
double ShareOfSlip(const BulletRow& normal, const btContactSolverInfo& info) {
  const auto& point = *static_cast<const btManifoldPoint*>(normal.m_originalContactPoint);
  const double kept = (point.getDistance() + info.m_linearSlop) / info.m_timeStep;
  const double taken = LimitsOf(normal).target;
  if (!(kept > kImpact) || !(taken > 0)) return 1;
  return taken / (taken + kept);
}

template <typename BulletRow>
std::array<double, 2> SoftnessOf(const BulletRow& row, double seconds) {
  const auto& point = *static_cast<const btManifoldPoint*>(row.m_originalContactPoint);
  const auto* axes = static_cast<const FrictionAxes*>(point.m_userPersistentData);
  return axes == nullptr ? std::array<double, 2>{} : axes->Softness(seconds);
}

ImpulseRows::Axes AxesOf(const btSolverConstraint& /*first*/,
                         const btSolverConstraint& /*second*/) {
  return kAsTheyAre;
}
// For contacts of trees, Bullet uses axes of the world and ignores those of the point.
ImpulseRows::Axes AxesOf(const btMultiBodySolverConstraint& first,
                         const btMultiBodySolverConstraint& second) {
  const auto& point = *static_cast<const btManifoldPoint*>(first.m_originalContactPoint);
  const auto* axes = static_cast<const FrictionAxes*>(point.m_userPersistentData);
  if (axes == nullptr) return kAsTheyAre;
  const btVector3 &x = first.m_contactNormal1, &y = second.m_contactNormal1;
  return {{{axes->first.dot(x), axes->first.dot(y)}, {axes->second.dot(x), axes->second.dot(y)}}};
}

}  // namespace

void ImpulseSolver::AddNodes() {
  nodes_.clear();
  node_of_body_.assign(static_cast<std::size_t>(m_tmpSolverBodyPool.size()), -1);
  node_of_tree_.assign(static_cast<std::size_t>(m_data.m_deltaVelocities.size()), -1);
  for (int i = 0; i < m_tmpSolverBodyPool.size(); ++i) {
    const btSolverBody& body = m_tmpSolverBodyPool[i];
    if (body.m_originalBody == nullptr || body.m_invMass.isZero()) continue;
    const int node = static_cast<int>(nodes_.size());
    node_of_body_[static_cast<std::size_t>(i)] = node;
    nodes_.push_back({nullptr, i, node, -1, 0, 6});
  }
}

int ImpulseSolver::NodeOf(int solver_body) const {
  return solver_body < 0 ? -1 : node_of_body_[static_cast<std::size_t>(solver_body)];
}

int ImpulseSolver::NodeOf(btMultiBody* tree, int bullets_first) {
  int& known = node_of_tree_[static_cast<std::size_t>(bullets_first)];
  if (known < 0) {
    known = static_cast<int>(nodes_.size());
    nodes_.push_back({tree, bullets_first, known, -1, 0, tree->getNumDofs() + 6});
  }
  return known;
}

// Returns the node on which a row acts, or -1.
int ImpulseSolver::NodeOf(const btSolverConstraint& row, bool is_first) {
  return NodeOf(is_first ? row.m_solverBodyIdA : row.m_solverBodyIdB);
}

int ImpulseSolver::NodeOf(const btMultiBodySolverConstraint& row, bool is_first) {
  btMultiBody* const tree = is_first ? row.m_multiBodyA : row.m_multiBodyB;
  if (tree != nullptr) return NodeOf(tree, is_first ? row.m_deltaVelAindex : row.m_deltaVelBindex);
  return NodeOf(is_first ? row.m_solverBodyIdA : row.m_solverBodyIdB);
}

int ImpulseSolver::RootOf(int node) {
  auto parent = [&](int of) -> int& { return nodes_[static_cast<std::size_t>(of)].parent; };
  while (parent(node) != node) node = parent(node) = parent(parent(node));
  return node;
}

// The first node stands for the others. Every node with a row gets an island, still unnumbered.
template <typename Rows>
void ImpulseSolver::Join(const Rows& rows) {
  for (int i = 0; i < rows.size(); ++i) {
    const int a = NodeOf(rows[i], true), b = NodeOf(rows[i], false);
    if (a >= 0) nodes_[static_cast<std::size_t>(a)].island = 0;
    if (b >= 0) nodes_[static_cast<std::size_t>(b)].island = 0;
    if (a < 0 || b < 0) continue;
    const int x = RootOf(a), y = RootOf(b);
    nodes_[static_cast<std::size_t>(std::max(x, y))].parent = std::min(x, y);
  }
}

// Friction acts on what its contact acts on.
void ImpulseSolver::JoinNodes() {
  Join(m_tmpSolverNonContactConstraintPool);
  Join(m_multiBodyNonContactConstraints);
  Join(m_tmpSolverContactConstraintPool);
  Join(m_multiBodyNormalContactConstraints);
}

ImpulseSolver::Island& ImpulseSolver::NewIsland() {
  if (island_count_ == islands_.size()) islands_.emplace_back();
  Island& island = islands_[island_count_++];
  island.rows.Clear();
  island.contacts.clear();
  island.bodies = 0;
  return island;
}

void ImpulseSolver::AddBody(Node& node) {
  Island& island = islands_[static_cast<std::size_t>(node.island)];
  ++island.bodies;
  if (node.tree != nullptr) {
    node.first = island.rows.AddBody(
        {&m_data.m_deltaVelocities[node.bullets_first], static_cast<std::size_t>(node.count)});
    return;
  }
  const btSolverBody& body = m_tmpSolverBodyPool[node.bullets_first];
  const btVector3 &v = body.m_deltaLinearVelocity, &w = body.m_deltaAngularVelocity;
  const double velocities[] = {v.x(), v.y(), v.z(), w.x(), w.y(), w.z()};
  node.first = island.rows.AddBody(velocities);
}

// In the order of their first nodes.
void ImpulseSolver::NumberIslands() {
  island_count_ = 0;
  for (std::size_t i = 0; i < nodes_.size(); ++i) {
    Node& node = nodes_[i];
    if (node.island < 0) continue;
    const auto root = static_cast<std::size_t>(RootOf(static_cast<int>(i)));
    if (root == i) {
      node.island = static_cast<int>(island_count_);
      NewIsland();
    } else {
      node.island = nodes_[root].island;
    }
    AddBody(node);
  }
}

template <typename Row>
ImpulseRows::Side ImpulseSolver::SideOfBody(const Node& node, const Row& row, bool is_first) {
  const btSolverBody& body = m_tmpSolverBodyPool[node.bullets_first];
  const btVector3& linear = is_first ? row.m_contactNormal1 : row.m_contactNormal2;
  const btVector3& angular = is_first ? row.m_relpos1CrossNormal : row.m_relpos2CrossNormal;
  const btVector3 linear_response = linear * body.m_invMass * body.m_linearFactor;
  const btVector3 turning =
      (is_first ? row.m_angularComponentA : row.m_angularComponentB) * body.m_angularFactor;
  double* const jacobian = jacobian_[is_first ? 0 : 1];
  double* const response = response_[is_first ? 0 : 1];
  for (int i = 0; i < 3; ++i) {
    jacobian[i] = linear[i];
    jacobian[3 + i] = angular[i];
    response[i] = linear_response[i];
    response[3 + i] = turning[i];
  }
  return {node.first, {jacobian, 6}, {response, 6}};
}

ImpulseRows::Side ImpulseSolver::SideOf(const Node& node, const btSolverConstraint& row,
                                        bool is_first) {
  return SideOfBody(node, row, is_first);
}

ImpulseRows::Side ImpulseSolver::SideOf(const Node& node, const btMultiBodySolverConstraint& row,
                                        bool is_first) {
  if (node.tree == nullptr) return SideOfBody(node, row, is_first);
  const auto count = static_cast<std::size_t>(node.count);
  const int jacobian = is_first ? row.m_jacAindex : row.m_jacBindex;
  return {node.first,
          {&m_data.m_jacobians[jacobian], count},
          {&m_data.m_deltaVelocitiesUnitImpulse[jacobian], count}};
}

// They give way by so much of their inverse mass.
template <typename Rows>
void ImpulseSolver::AddRows(const Rows& rows, double give) {
  for (int i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    const int a = NodeOf(row, true), b = NodeOf(row, false);
    Place& place = rows_.emplace_back();
    if (a < 0 && b < 0) continue;  // it moves nothing
    const auto node = [&](int of) -> const Node& { return nodes_[static_cast<std::size_t>(of)]; };
    ImpulseRows::Limits limits = LimitsOf(row);
    if (row.m_jacDiagABInv > 0) limits.softness += give / row.m_jacDiagABInv;
    place.island = &islands_[static_cast<std::size_t>(node(a < 0 ? b : a).island)];
    place.row = place.island->rows.AddRow(a < 0 ? ImpulseRows::Side{} : SideOf(node(a), row, true),
                                          b < 0 ? ImpulseRows::Side{} : SideOf(node(b), row, false),
                                          limits, row.m_appliedImpulse);
  }
}

// The rows lie one kind after the other: constraints, contacts, friction.
void ImpulseSolver::AddAllRows() {
  rows_.clear();
  AddRows(m_tmpSolverNonContactConstraintPool);
  AddRows(m_multiBodyNonContactConstraints);
  const std::size_t contacts = rows_.size();
  AddRows(m_tmpSolverContactConstraintPool);
  for (std::size_t i = contacts; i < rows_.size(); ++i) {
    if (rows_[i].island == nullptr) continue;
    rows_[i].island->contacts.push_back(static_cast<int>(i - contacts));
  }
  AddRows(m_multiBodyNormalContactConstraints, kGive);
  AddRows(m_tmpSolverContactFrictionConstraintPool);
  AddRows(m_multiBodyFrictionContactConstraints);
}

template <typename Rows>
void ImpulseSolver::AddCones(const Rows& normals, const Rows& friction, int first_normal,
                             int first_friction, const btContactSolverInfo& info) {
  for (int i = 0; i + 1 < friction.size(); i += 2) {
    const auto& row = friction[i];
    const Place& normal = rows_[static_cast<std::size_t>(first_normal + row.m_frictionIndex)];
    const Place& first = rows_[static_cast<std::size_t>(first_friction + i)];
    Place& cone = cones_.emplace_back();
    if (first.island == nullptr) continue;
    const auto& contact = normals[row.m_frictionIndex];
    const double share = ShareOfSlip(contact, info);
    ImpulseRows& rows = first.island->rows;
    for (const int of : {first.row, first.row + 1}) rows.ScaleTarget(of, share);
    cone.island = first.island;
    cone.row = rows.AddCone(normal.row, first.row, row.m_friction, AxesOf(row, friction[i + 1]),
                            SoftnessOf(contact, info.m_timeStep));
  }
}

void ImpulseSolver::AddAllCones(const btContactSolverInfo& info) {
  cones_.clear();
  const int normals =
      m_tmpSolverNonContactConstraintPool.size() + m_multiBodyNonContactConstraints.size();
  const int tree_normals = normals + m_tmpSolverContactConstraintPool.size();
  const int friction = tree_normals + m_multiBodyNormalContactConstraints.size();
  const int tree_friction = friction + m_tmpSolverContactFrictionConstraintPool.size();
  AddCones(m_tmpSolverContactConstraintPool, m_tmpSolverContactFrictionConstraintPool, normals,
           friction, info);
  AddCones(m_multiBodyNormalContactConstraints, m_multiBodyFrictionContactConstraints, tree_normals,
           tree_friction, info);
}

// Takes bodies out of each other, by velocities that are gone after the substep: Bullet's split
// impulses, until they change no more.
void ImpulseSolver::PushApart(const Island& island, int iterations, double tolerance) {
  for (int iteration = 0; iteration < iterations; ++iteration) {
    double most = 0;
    for (const int contact : island.contacts) {
      const btSolverConstraint& row = m_tmpSolverContactConstraintPool[contact];
      const double change = resolveSplitPenetrationImpulse(
          m_tmpSolverBodyPool[row.m_solverBodyIdA], m_tmpSolverBodyPool[row.m_solverBodyIdB], row);
      most = std::max(most, change * change);
    }
    if (most <= tolerance) return;
  }
}

template <typename Rows>
void ImpulseSolver::Store(Rows& rows, int first) {
  for (int i = 0; i < rows.size(); ++i) {
    const Place& place = rows_[static_cast<std::size_t>(first + i)];
    if (place.island != nullptr) rows[i].m_appliedImpulse = place.island->rows.impulse(place.row);
  }
}

template <typename Rows>
void ImpulseSolver::StoreCones(Rows& rows, int first_cone) {
  for (int i = 0; i + 1 < rows.size(); i += 2) {
    const Place& cone = cones_[static_cast<std::size_t>(first_cone + i / 2)];
    if (cone.island == nullptr) continue;
    const auto [x, y] = cone.island->rows.ConeImpulse(cone.row);
    rows[i].m_appliedImpulse = x;
    rows[i + 1].m_appliedImpulse = y;
  }
}

void ImpulseSolver::StoreVelocities() {
  for (const Node& node : nodes_) {
    if (node.island < 0) continue;
    const ImpulseRows& rows = islands_[static_cast<std::size_t>(node.island)].rows;
    const auto v = rows.velocities(node.first, node.count);
    if (node.tree == nullptr) {
      btSolverBody& body = m_tmpSolverBodyPool[node.bullets_first];
      body.m_deltaLinearVelocity.setValue(v[0], v[1], v[2]);
      body.m_deltaAngularVelocity.setValue(v[3], v[4], v[5]);
      continue;
    }
    btScalar* const bullets = &m_data.m_deltaVelocities[node.bullets_first];
    for (int k = 0; k < node.count; ++k) {
      bullets[k] = v[static_cast<std::size_t>(k)] - bullets[k];
    }
    node.tree->applyDeltaVeeMultiDof2(bullets, 1);
    node.tree->setPosUpdated(false);
  }
}

void ImpulseSolver::StoreAll() {
  int first = 0;
  const auto store = [&](auto& rows) {
    Store(rows, first);
    first += rows.size();
  };
  store(m_tmpSolverNonContactConstraintPool);
  store(m_multiBodyNonContactConstraints);
  store(m_tmpSolverContactConstraintPool);
  store(m_multiBodyNormalContactConstraints);
  StoreCones(m_tmpSolverContactFrictionConstraintPool, 0);
  StoreCones(m_multiBodyFrictionContactConstraints,
             m_tmpSolverContactFrictionConstraintPool.size() / 2);
  StoreVelocities();
}

void ImpulseSolver::SolveIslands(const btContactSolverInfo& info) {
  // Waking a thread costs as much as solving some islands of this size.
  constexpr std::size_t kGrain = 4;
  const double tolerance = info.m_leastSquaresResidualThreshold;
  const auto iterations_of = [](const Island& island) {
    return std::clamp(kIterationsOfAll / island.bodies, kMinIterations, kMaxIterations);
  };
  if (info.m_splitImpulse != 0) {
    for (std::size_t i = 0; i < island_count_; ++i) {
      PushApart(islands_[i], iterations_of(islands_[i]), tolerance);
    }
  }
  const auto solve = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      CountSolverIterations(
          islands_[i].rows.Solve(iterations_of(islands_[i]), std::sqrt(tolerance)));
    }
  };
  if (team_ == nullptr) {
    solve(0, island_count_);
  } else {
    team_->ParallelFor(island_count_, kGrain, solve);
  }
}

btScalar ImpulseSolver::solveGroupCacheFriendlyIterations(
    btCollisionObject** /*bodies*/, int /*body_count*/, btPersistentManifold** /*manifolds*/,
    int /*manifold_count*/, btTypedConstraint** /*constraints*/, int /*constraint_count*/,
    const btContactSolverInfo& info, btIDebugDraw* /*debug*/) {
  AddNodes();
  JoinNodes();
  NumberIslands();
  AddAllRows();
  AddAllCones(info);
  SolveIslands(info);
  StoreAll();
  return 0;
}

}  // namespace gsv::dynamics
