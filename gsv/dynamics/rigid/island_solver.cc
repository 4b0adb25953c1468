#include "gsv/dynamics/rigid/island_solver.h"

#include <algorithm>
#include <cmath>

#include "gsv/dynamics/motion/solver_count.h"

namespace gsv::dynamics {
namespace {

using geometry::Vector3;

// The softness of contacts of bodies with joints, as a fraction of J M⁻¹ Jᵀ. Under the weight of a
// robot, a contact gives way by about a micrometre. So wheels and casters on one floor share the
// load, even if their heights differ slightly.
constexpr double kGive = 0.02;
// The compliance of an impulse in one iteration of Newton's method, relative to the inverse mass.
constexpr double kCompliance = 1e-6;
// If J M⁻¹ Jᵀ is below this, no impulse can move the row, apart from rounding.
constexpr double kNothing = 1e-15;

std::size_t IndexOf(int i) { return static_cast<std::size_t>(i); }

}  // namespace

void IslandSolver::Clear() {
  bodies_.clear();
  contacts_.clear();
  pushes_.clear();
}

double IslandSolver::VelocityOf(const Row& row, const std::vector<double>& v) const {
  double sum = 0;
  const int* const columns = columns_.data() + row.begin;
  const double* const values = values_.data() + row.values;
  for (int k = 0; k < row.count; ++k) sum += values[k] * v[IndexOf(columns[k])];
  return sum;
}

std::array<double, 3> IslandSolver::VelocityAt(const ContactRows& rows,
                                               const std::vector<double>& v) const {
  const Row& row = rows.normal;
  const int* const columns = columns_.data() + row.begin;
  const double* const values = values_.data() + row.values;
  double normal = 0, first = 0, second = 0;
  for (int k = 0; k < row.count; ++k) {
    const double rate = v[IndexOf(columns[k])];
    normal += values[k] * rate;
    first += values[row.count + k] * rate;
    second += values[2 * row.count + k] * rate;
  }
  return {normal, first, second};
}

void IslandSolver::AddJointRows(std::span<const std::unique_ptr<MovingBody>> bodies) {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const MovingBody& body = *bodies[IndexOf(bodies_[b])];
    for (const JointRow& joint : body.rows().rows()) {
      Row& row = rows_.emplace_back();
      row.begin = static_cast<int>(columns_.size());
      row.values = static_cast<int>(values_.size());
      row.count = joint.count;
      const auto velocities = body.rows().velocities(joint);
      const auto values = body.rows().values(joint);
      double moved = 0;
      for (std::size_t k = 0; k < values.size(); ++k) {
        columns_.push_back(first_[b] + velocities[k]);
        values_.push_back(values[k]);
        moved += values[k] * values[k] / body.tree().mass(velocities[k], velocities[k]);
      }
      if (!(moved > kNothing)) {
        columns_.resize(IndexOf(row.begin));
        values_.resize(IndexOf(row.values));
        rows_.pop_back();
        continue;
      }
      row.target = joint.target;
      row.softness = joint.softness;
      row.lower = joint.lower;
      row.upper = joint.upper;
      row.compliance = kCompliance * moved;
      row.stiffness = 1 / (moved + joint.softness);
    }
  }
  joint_rows_ = rows_.size();
}

void IslandSolver::AddPushRow(std::span<const std::unique_ptr<MovingBody>> bodies,
                              const PushRow& push) {
  const LinkTree& tree = bodies[IndexOf(push.moving)]->tree();
  Row& row = rows_.emplace_back();
  row.begin = static_cast<int>(columns_.size());
  row.values = static_cast<int>(values_.size());
  tree.PointMotions(0, push.point, motions_);
  const auto chain = tree.Chain(0);
  for (std::size_t k = 0; k < chain.size(); ++k) {
    columns_.push_back(first_of_[IndexOf(push.moving)] + chain[k]);
    values_.push_back(Dot(push.normal, motions_[k]));
  }
  row.count = static_cast<int>(chain.size());
  row.target = push.speed;
  row.upper = push.limit;
  const double moved = tree.Response(
      0, std::span<const double>(values_).subspan(IndexOf(row.values), IndexOf(row.count)));
  row.compliance = kCompliance * moved;
  row.stiffness = moved > 0 ? 1 / moved : 0;
}

// Appends the velocities of one body of a contact to columns_, and their values for the contact's
// three rows to side_values_. Returns the body's part of J M⁻¹ Jᵀ along the normal.
double IslandSolver::AddSide(const MovingBody& body, const Collider& collider, const Vector3& point,
                             double sign, const Contact& contact) {
  const LinkTree& tree = body.tree();
  tree.PointMotions(collider.part, point, motions_);
  const auto chain = tree.Chain(collider.part);
  const std::size_t begin = side_values_[0].size();
  const Vector3 axes[] = {sign * contact.point.normal, sign * contact.axes[0],
                          sign * contact.axes[1]};
  for (std::size_t k = 0; k < chain.size(); ++k) {
    columns_.push_back(first_of_[IndexOf(collider.moving)] + chain[k]);
    for (std::size_t r = 0; r < 3; ++r) side_values_[r].push_back(Dot(axes[r], motions_[k]));
  }
  return tree.Response(collider.part, std::span<const double>(side_values_[0]).subspan(begin));
}

void IslandSolver::AddContactRows(const ContactFinder& finder,
                                  std::span<const std::unique_ptr<MovingBody>> bodies,
                                  const Contact& contact, int index, double substep) {
  ContactRows rows;
  rows.index = index;
  rows.normal.begin = static_cast<int>(columns_.size());
  rows.normal.values = static_cast<int>(values_.size());
  for (auto& values : side_values_) values.clear();
  double moved = 0;
  bool has_tree = false;
  // the relative velocity that bodies with a prescribed motion cause
  std::array<double, 3> known{};
  for (const double sign : {1.0, -1.0}) {
    const Collider& collider = finder.collider(sign > 0 ? contact.first : contact.second);
    const Vector3 point = sign > 0 ? contact.on_first() : contact.point.on_second;
    if (collider.moving >= 0 && bodies[IndexOf(collider.moving)]->tree().size() > 0) {
      const MovingBody& body = *bodies[IndexOf(collider.moving)];
      moved += AddSide(body, collider, point, sign, contact);
      has_tree = has_tree || !body.tree().is_single();
      continue;
    }
    const Vector3 velocity = finder.VelocityOf(collider, point);
    known[0] += sign * Dot(contact.point.normal, velocity);
    known[1] += sign * Dot(contact.axes[0], velocity);
    known[2] += sign * Dot(contact.axes[1], velocity);
  }
  if (!(moved > kNothing)) {
    columns_.resize(IndexOf(rows.normal.begin));
    return;
  }
  rows.normal.count = static_cast<int>(side_values_[0].size());
  for (const auto& values : side_values_)
    values_.insert(values_.end(), values.begin(), values.end());
  rows.normal.softness = has_tree ? kGive * moved : 0;
  rows.normal.compliance = kCompliance * moved;
  rows.normal.stiffness = 1 / (moved + rows.normal.softness);
  rows.normal.upper = JointRows::kNoBound;
  rows.friction = contact.friction;
  for (std::size_t i = 0; i < 2; ++i) {
    const double square = Dot(contact.axes[i], contact.axes[i]);
    rows.compliance[i] = kCompliance * moved * square;
    rows.softness[i] = contact.softness[i] * square;
  }
  rows.stiffness = 1 / (moved + std::max(rows.softness[0], rows.softness[1]));
  SetTargets(contact, has_tree, known, substep, rows);
  contact_rows_.push_back(rows);
}

void IslandSolver::SetTargets(const Contact& contact, bool has_tree,
                              const std::array<double, 3>& known, double substep,
                              ContactRows& rows) const {
  std::array<double, 3> free = VelocityAt(rows, free_);
  for (std::size_t i = 0; i < 3; ++i) free[i] += known[i];
  const double meeting =
      has_tree || !(contact.restitution > 0) ? free[0] : known[0] + VelocityAt(rows, start_)[0];
  const auto targets = TargetsOf(contact, has_tree, meeting, free, substep);
  rows.normal.target = targets[0] - known[0];
  rows.target = {targets[1] - known[1], targets[2] - known[2]};
}

void IslandSolver::Solve(const ContactFinder& finder,
                         std::span<const std::unique_ptr<MovingBody>> bodies,
                         std::vector<Contact>& contacts, std::vector<PushRow>& pushes,
                         std::span<const int> starts, std::span<double> velocities,
                         double substep) {
  size_ = 0;
  first_.clear();
  first_of_.resize(bodies.size());
  place_of_.resize(bodies.size());
  start_.clear();
  free_.clear();
  momenta_.clear();
  rows_.clear();
  contact_rows_.clear();
  columns_.clear();
  values_.clear();
  const auto append = [](std::vector<double>& to, std::span<const double> from) {
    to.insert(to.end(), from.begin(), from.end());
  };
  for (const int moving : bodies_) {
    const LinkTree& tree = bodies[IndexOf(moving)]->tree();
    first_.push_back(size_);
    place_of_[IndexOf(moving)] = static_cast<int>(first_.size()) - 1;
    first_of_[IndexOf(moving)] = size_;
    size_ += tree.size();
    append(start_, tree.velocities());
    append(free_, tree.free());
    append(momenta_, tree.free_momenta());
  }
  is_swept_ = size_ > kMaxHeap && CanSweep(bodies);
  if (is_swept_) {
    SolveBySweeps(finder, bodies, contacts, substep);
    StoreVelocities(bodies, starts, velocities);
    return;
  }
  AddJointRows(bodies);
  for (const int push : pushes_) AddPushRow(bodies, pushes[IndexOf(push)]);
  for (const int contact : contacts_) {
    AddContactRows(finder, bodies, contacts[IndexOf(contact)], contact, substep);
  }
  if (rows_.empty() && contact_rows_.empty()) {
    velocities_ = free_;
  } else if (size_ <= kMaxVelocities && SolveByNewton(bodies)) {
    ApplyImpulses(bodies);
  } else {
    SolveByRows(bodies);
  }
  for (const ContactRows& rows : contact_rows_) {
    contacts[IndexOf(rows.index)].impulse = {std::max(rows.normal.impulse, 0.0), rows.impulse[0],
                                             rows.impulse[1]};
  }
  for (std::size_t i = 0; i < pushes_.size(); ++i) {
    pushes[IndexOf(pushes_[i])].impulse = rows_[joint_rows_ + i].impulse;
  }
  StoreVelocities(bodies, starts, velocities);
}

void IslandSolver::StoreVelocities(std::span<const std::unique_ptr<MovingBody>> bodies,
                                   std::span<const int> starts,
                                   std::span<double> velocities) const {
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const int size = bodies[IndexOf(bodies_[b])]->tree().size();
    std::copy_n(velocities_.begin() + first_[b], size,
                velocities.begin() + starts[IndexOf(bodies_[b])]);
  }
}

// The velocities of Newton's method contain the rounding errors of stiff equations. The velocities
// that follow from the impulses conserve momentum.
void IslandSolver::ApplyImpulses(std::span<const std::unique_ptr<MovingBody>> bodies) {
  velocities_.assign(IndexOf(size_), 0);
  const auto apply = [&](const Row& row, int offset, double impulse) {
    const double* const values = values_.data() + row.values + offset;
    for (int k = 0; k < row.count; ++k) {
      velocities_[IndexOf(columns_[IndexOf(row.begin + k)])] += values[k] * impulse;
    }
  };
  for (const Row& row : rows_) apply(row, 0, row.impulse);
  for (const ContactRows& rows : contact_rows_) {
    if (rows.mode == ContactRows::Mode::kOpen) continue;
    apply(rows.normal, 0, rows.normal.impulse);
    apply(rows.normal, rows.normal.count, rows.impulse[0]);
    apply(rows.normal, 2 * rows.normal.count, rows.impulse[1]);
  }
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const LinkTree& tree = bodies[IndexOf(bodies_[b])]->tree();
    tree.Respond(std::span(velocities_).subspan(IndexOf(first_[b]), IndexOf(tree.size())));
  }
  for (std::size_t i = 0; i < velocities_.size(); ++i) velocities_[i] += free_[i];
}

int IslandSolver::BodyAt(int column) const {
  return static_cast<int>(std::upper_bound(first_.begin(), first_.end(), column) - first_.begin()) -
         1;
}

bool IslandSolver::CanSweep(std::span<const std::unique_ptr<MovingBody>> bodies) const {
  return pushes_.empty() && std::all_of(bodies_.begin(), bodies_.end(), [&](int moving) {
           return bodies[IndexOf(moving)]->tree().is_single();
         });
}

void IslandSolver::SolveBySweeps(const ContactFinder& finder,
                                 std::span<const std::unique_ptr<MovingBody>> bodies,
                                 std::vector<Contact>& contacts, double substep) {
  // The fewer bodies an island has, the more sweeps are allowed. A stack of bodies needs many.
  constexpr int kMaxSweeps = 300, kMinSweeps = 30, kSweepsOfAll = 4800;
  constexpr double kTolerance = 1e-5;  // m/s
  sweeps_.Clear();
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const LinkTree& tree = bodies[IndexOf(bodies_[b])]->tree();
    const double* const v = free_.data() + first_[b];
    sweeps_.AddBody(
        {{v[3], v[4], v[5]}, {v[0], v[1], v[2]}, 1 / tree.part_mass(0), tree.inverse_inertia()});
  }
  for (const int index : contacts_) {
    const Contact& contact = contacts[IndexOf(index)];
    ContactSweeps::Side sides[2];
    Vector3 free, start, known;  // velocities of the first body relative to the second
    for (const int s : {0, 1}) {
      const Collider& collider = finder.collider(s == 0 ? contact.first : contact.second);
      const Vector3 point = s == 0 ? contact.on_first() : contact.point.on_second;
      const double sign = s == 0 ? 1 : -1;
      const bool is_moved =
          collider.moving >= 0 && bodies[IndexOf(collider.moving)]->tree().size() > 0;
      if (!is_moved) {
        known += sign * finder.VelocityOf(collider, point);
        continue;
      }
      const MovingBody& body = *bodies[IndexOf(collider.moving)];
      sides[s] = {place_of_[IndexOf(collider.moving)], point - body.tree().position(0)};
      const ContactSweeps::Body& moved = sweeps_.body(sides[s].body);
      free += sign * (moved.velocity + Cross(moved.angular_velocity, sides[s].arm));
      start += sign * body.VelocityOf(0, point);
    }
    const std::array<Vector3, 3> axes{contact.point.normal, contact.axes[0], contact.axes[1]};
    std::array<double, 3> along, at;
    for (std::size_t i = 0; i < 3; ++i) {
      along[i] = Dot(axes[i], free + known);
      at[i] = Dot(axes[i], known);
    }
    auto targets = TargetsOf(contact, false, Dot(axes[0], start + known), along, substep);
    for (std::size_t i = 0; i < 3; ++i) targets[i] -= at[i];
    std::array<double, 2> softness;
    for (std::size_t i = 0; i < 2; ++i) {
      softness[i] = contact.softness[i] * Dot(contact.axes[i], contact.axes[i]);
    }
    pending_.push_back(
        {sides[0], sides[1], axes, targets, contact.friction, softness, contact.impulse});
  }
  // AddContact() applies the given impulse. So all velocities above were computed before the first
  // call.
  for (const auto& each : pending_) {
    sweeps_.AddContact(each.first, each.second, each.axes, each.targets, each.friction,
                       each.softness, each.impulse);
  }
  pending_.clear();
  const int max_sweeps =
      std::clamp(kSweepsOfAll / static_cast<int>(bodies_.size()), kMinSweeps, kMaxSweeps);
  CountSolverIterations(sweeps_.Solve(max_sweeps, kTolerance));
  velocities_.clear();
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const ContactSweeps::Body& body = sweeps_.body(static_cast<int>(b));
    const Vector3 &v = body.velocity, &w = body.angular_velocity;
    velocities_.insert(velocities_.end(), {w.x, w.y, w.z, v.x, v.y, v.z});
  }
  for (std::size_t i = 0; i < contacts_.size(); ++i) {
    contacts[IndexOf(contacts_[i])].impulse = sweeps_.impulse(static_cast<int>(i));
  }
}

// Adds the row to impulse_rows_, with the jacobian `values`.
void IslandSolver::AddRowTo(const Row& row, const double* values, const ImpulseRows::Limits& limits,
                            std::span<const std::unique_ptr<MovingBody>> bodies) {
  ImpulseRows::Side sides[2];
  int of_side[2] = {-1, -1};
  for (int k = 0; k < row.count; ++k) {
    const int column = columns_[IndexOf(row.begin + k)];
    const int body = BodyAt(column);
    const std::size_t side = of_side[0] < 0 || of_side[0] == body ? 0 : 1;
    const LinkTree& tree = bodies[IndexOf(bodies_[IndexOf(body)])]->tree();
    if (of_side[side] < 0) {
      of_side[side] = body;
      jacobian_[side].assign(IndexOf(tree.size()), 0);
    }
    jacobian_[side][IndexOf(column - first_[IndexOf(body)])] = values[k];
  }
  for (std::size_t side = 0; side < 2; ++side) {
    if (of_side[side] < 0) continue;
    response_[side] = jacobian_[side];
    bodies[IndexOf(bodies_[IndexOf(of_side[side])])]->tree().Respond(response_[side]);
    // ImpulseRows has the bodies' velocities at multiples of four.
    sides[side] = {columns_of_rows_[IndexOf(of_side[side])], jacobian_[side], response_[side]};
  }
  impulse_rows_.AddRow(sides[0], sides[1], limits, 0);
}

void IslandSolver::SolveByRows(std::span<const std::unique_ptr<MovingBody>> bodies) {
  // The fewer bodies an island has, the more iterations are allowed.
  constexpr int kMaxIterations = 80, kMinIterations = 25, kIterationsOfAll = 1600;
  constexpr double kTolerance = 1e-7;  // m/s
  impulse_rows_.Clear();
  columns_of_rows_.clear();
  for (const int moving : bodies_) {
    start_.assign(IndexOf(bodies[IndexOf(moving)]->tree().size()), 0);
    columns_of_rows_.push_back(impulse_rows_.AddBody(start_));
  }
  for (const Row& row : rows_) {
    AddRowTo(row, values_.data() + row.values,
             {row.target - VelocityOf(row, free_), row.softness, row.lower, row.upper}, bodies);
  }
  std::vector<std::array<double, 3>> free;
  free.reserve(contact_rows_.size());
  for (const ContactRows& rows : contact_rows_) {
    free.push_back(VelocityAt(rows, free_));
    AddRowTo(rows.normal, values_.data() + rows.normal.values,
             {rows.normal.target - free.back()[0], rows.normal.softness, 0, 1e10}, bodies);
  }
  const int normals = static_cast<int>(rows_.size());
  const int cones = normals + static_cast<int>(contact_rows_.size());
  for (std::size_t i = 0; i < contact_rows_.size(); ++i) {
    const ContactRows& rows = contact_rows_[i];
    for (int r = 0; r < 2; ++r) {
      AddRowTo(rows.normal, values_.data() + rows.normal.values + (1 + r) * rows.normal.count,
               {rows.target[IndexOf(r)] - free[i][IndexOf(1 + r)], 0, -1, 1}, bodies);
    }
  }
  for (std::size_t i = 0; i < contact_rows_.size(); ++i) {
    const int index = static_cast<int>(i);
    impulse_rows_.AddCone(normals + index, cones + 2 * index, contact_rows_[i].friction,
                          {{{1, 0}, {0, 1}}}, contact_rows_[i].softness);
  }
  const int iterations = std::clamp(kIterationsOfAll / static_cast<int>(bodies_.size()),
                                    kMinIterations, kMaxIterations);
  CountSolverIterations(impulse_rows_.Solve(iterations, kTolerance));
  velocities_ = free_;
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    const int size = bodies[IndexOf(bodies_[b])]->tree().size();
    const auto changes = impulse_rows_.velocities(columns_of_rows_[b], size);
    for (int k = 0; k < size; ++k) velocities_[IndexOf(first_[b] + k)] += changes[IndexOf(k)];
  }
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    rows_[i].impulse = impulse_rows_.impulse(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < contact_rows_.size(); ++i) {
    contact_rows_[i].normal.impulse = impulse_rows_.impulse(normals + static_cast<int>(i));
    contact_rows_[i].impulse = impulse_rows_.ConeImpulse(static_cast<int>(i));
  }
}

}  // namespace gsv::dynamics
