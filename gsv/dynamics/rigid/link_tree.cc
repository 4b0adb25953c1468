#include "gsv/dynamics/rigid/link_tree.h"

#include <algorithm>
#include <cmath>

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Quaternion;
using geometry::Vector3;
using model::JointKind;

// A pivot of the factorised mass matrix is at least kMinPivot (kg or kg m²), and at least
// kMinPivotShare times the diagonal value of the mass matrix.
constexpr double kMinPivot = 1e-100, kMinPivotShare = 1e-12;

Matrix3 Outer(const Vector3& a, const Vector3& b) { return {b.x * a, b.y * a, b.z * a}; }

void AddTo(Matrix3& sum, const Matrix3& added, double factor = 1) {
  sum.x += factor * added.x;
  sum.y += factor * added.y;
  sum.z += factor * added.z;
}

// a x = b, for a regular matrix.
Vector3 Solve(const Matrix3& a, const Vector3& b) {
  const Vector3 yz = Cross(a.y, a.z);
  const double scale = 1 / Dot(a.x, yz);
  return {scale * Dot(b, yz), scale * Dot(a.x, Cross(b, a.z)), scale * Dot(a.x, Cross(a.y, b))};
}

}  // namespace

LinkTree::LinkTree(const RigidBody& plan) : plan_(plan) {
  const auto& parts = plan.articulation.parts;
  // A single body without mass does not move.
  const bool is_moved = !plan.articulation.is_fixed &&
                        !(parts.size() == 1 && (parts[0].is_kinematic || !(parts[0].mass > 0)));
  base_size_ = is_moved ? 6 : 0;
  size_ = base_size_;
  ball_of_.assign(parts.size(), -1);
  for (std::size_t i = 0; i < parts.size(); ++i) {
    Link link = LinkOf(static_cast<int>(i));
    if (i > 0) {
      link.first = size_;
      link.count = link.kind == JointKind::kBall ? 3 : 1;
      size_ += link.count;
    } else {
      link.count = base_size_;
    }
    if (link.kind == JointKind::kBall && i > 0) {
      ball_of_[i] = static_cast<int>(balls_.size());
      balls_.emplace_back(*plan.model, parts[i]);
    }
    for (int d = link.first + link.count; d-- > link.first;) link.chain.push_back(d);
    if (link.parent >= 0) {
      const auto& above = links_[Index(link.parent)].chain;
      link.chain.insert(link.chain.end(), above.begin(), above.end());
    }
    for (int d = 0; d < link.count; ++d) {
      const auto at = Index(link.count - 1 - d) + 1;
      parents_.push_back(at < link.chain.size() ? link.chain[at] : -1);
    }
    links_.push_back(std::move(link));
  }
  const std::size_t count = parts.size(), size = Index(size_);
  turns_.resize(count);
  joint_positions_.assign(count, 0);
  orientations_.resize(count);
  rotations_.resize(count);
  positions_.resize(count);
  forces_.resize(count);
  torques_.resize(count);
  own_inertias_.resize(count);
  inertias_.resize(count);
  for (auto* values : {&velocities_, &free_, &free_momenta_, &efforts_, &scratch_}) {
    values->assign(size, 0);
  }
  motions_.resize(size);
  for (auto* values : {&bias_turning_, &bias_moving_, &spins_, &speeds_}) values->resize(count);
  masses_.assign(size * size, 0);
}

LinkTree::Link LinkTree::LinkOf(int index) const {
  const auto& parts = plan_.articulation.parts;
  const Part& part = parts[Index(index)];
  Link link;
  link.mass = part.mass;
  link.inertia = part.inertia;
  link.heaviness = part.heaviness;
  if (parts.size() == 1) {
    // A body without inertia gets a large inertia, so that it hardly rotates.
    constexpr double kHardly = 1e3;  // m²
    for (double* moment : {&link.inertia.x, &link.inertia.y, &link.inertia.z}) {
      if (!(*moment > 0)) *moment = kHardly * part.mass;
    }
  }
  if (index == 0) return link;
  const Part& parent = parts[Index(part.parent)];
  const model::Joint& joint = plan_.model->joints[Index(part.joint)];
  const Pose part_from_model = Inverse(part.model_from_part);
  const Pose parent_from_model = Inverse(parent.model_from_part);
  link.parent = part.parent;
  link.joint = part.joint;
  link.kind = joint.kind;
  link.parent_from_part = Normalized((parent_from_model * part.model_from_part).orientation);
  link.pivot_in_parent = parent_from_model * joint.model_from_joint.position;
  link.arm = -(part_from_model * joint.model_from_joint.position);
  link.axis = part_from_model.orientation * (joint.model_from_joint.orientation * joint.axis);
  link.pitch = joint.kind == JointKind::kScrew ? joint.thread_pitch : 0;
  return link;
}

void LinkTree::Load(const world::State& state) {
  const world::BodyState& body = state.bodies[Index(plan_.body)];
  const Pose world_from_base = body.world_from_model * plan_.articulation.parts[0].model_from_part;
  base_ = Normalized(world_from_base.orientation);
  positions_[0] = world_from_base.position;
  if (base_size_ > 0) {
    const Vector3 arm = world_from_base.position - body.world_from_model.position;
    SetBaseVelocity(body.linear_velocity + Cross(body.angular_velocity, arm),
                    body.angular_velocity);
  }
  for (std::size_t i = 1; i < links_.size(); ++i) {
    const Link& link = links_[i];
    if (ball_of_[i] < 0) {
      const std::size_t joint = Index(plan_.first_joint + link.joint);
      joint_positions_[i] = state.joint_positions[joint];
      velocities_[Index(link.first)] = state.joint_velocities[joint];
      continue;
    }
    const BallAngles& ball = balls_[Index(ball_of_[i])];
    std::array<double, 3> angles, rates;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t joint = Index(plan_.first_joint + ball.joints()[k]);
      angles[k] = state.joint_positions[joint];
      rates[k] = state.joint_velocities[joint];
    }
    turns_[i] = ball.Turn(angles);
    const Vector3 omega = ball.AngularVelocity(rates);
    double* const v = &velocities_[Index(link.first)];
    v[0] = omega.x;
    v[1] = omega.y;
    v[2] = omega.z;
  }
}

void LinkTree::Place() {
  orientations_[0] = base_;
  rotations_[0] = MatrixOf(base_);
  if (base_size_ > 0) {
    const Vector3 axes[] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (std::size_t i = 0; i < 3; ++i) {
      motions_[i] = {axes[i], {}};
      motions_[3 + i] = {{}, axes[i]};
    }
  }
  for (int i = 1; i < static_cast<int>(links_.size()); ++i) PlaceLink(i);
}

void LinkTree::PlaceLink(int part) {
  const Link& link = links_[Index(part)];
  const std::size_t parent = Index(link.parent);
  const double at = joint_positions_[Index(part)];
  Quaternion orientation = orientations_[parent] * link.parent_from_part;
  if (link.kind == JointKind::kBall) {
    orientation = orientation * turns_[Index(part)];
  } else if (link.kind != JointKind::kPrismatic) {
    const double c = std::cos(at / 2), s = std::sin(at / 2);
    orientation = orientation * Quaternion{c, s * link.axis.x, s * link.axis.y, s * link.axis.z};
  }
  orientations_[Index(part)] = orientation;
  const Matrix3 rotation = rotations_[Index(part)] = MatrixOf(orientation);
  Vector3 pivot = positions_[parent] + rotations_[parent] * link.pivot_in_parent;
  const Vector3 axis = rotation * link.axis;
  if (link.kind == JointKind::kPrismatic) pivot += at * axis;
  if (link.pitch != 0) pivot += (link.pitch * at) * axis;
  positions_[Index(part)] = pivot + rotation * link.arm;
  const Vector3 from_base = pivot - positions_[0];
  Motion* const motions = &motions_[Index(link.first)];
  if (link.kind == JointKind::kBall) {
    const Vector3 axes[] = {rotation.x, rotation.y, rotation.z};
    for (int d = 0; d < 3; ++d) motions[d] = {axes[d], Cross(from_base, axes[d])};
  } else if (link.kind == JointKind::kPrismatic) {
    motions[0] = {{}, axis};
  } else {
    motions[0] = {axis, Cross(from_base, axis) + link.pitch * axis};
  }
}

void LinkTree::WriteSingle() {
  if (base_size_ == 0) return;
  const Link& link = links_[0];
  own_inertias_[0] = WithPrincipal(rotations_[0], link.inertia);
  inverse_inertia_ =
      WithPrincipal(rotations_[0], {1 / link.inertia.x, 1 / link.inertia.y, 1 / link.inertia.z});
  const Matrix3& inertia = own_inertias_[0];
  const Vector3 columns[] = {inertia.x, inertia.y, inertia.z};
  for (int i = 0; i < 3; ++i) {
    MassAt(0, i) = columns[i].x;
    MassAt(1, i) = columns[i].y;
    MassAt(2, i) = columns[i].z;
    MassAt(3 + i, 3 + i) = link.mass;
  }
}

void LinkTree::WriteMass() {
  if (is_single()) {
    WriteSingle();
    return;
  }
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    const Vector3 at = positions_[i] - positions_[0];
    Inertia& inertia = inertias_[i];
    own_inertias_[i] = WithPrincipal(rotations_[i], link.inertia);
    inertia = {link.mass, link.mass * at, own_inertias_[i]};
    const double square = link.mass * Dot(at, at);
    inertia.turning.x.x += square;
    inertia.turning.y.y += square;
    inertia.turning.z.z += square;
    AddTo(inertia.turning, Outer(at, at), -link.mass);
  }
  for (std::size_t i = links_.size(); i-- > 0;) {
    const Link& link = links_[i];
    for (int d = 0; d < link.count; ++d) WriteMassesOf(static_cast<int>(i), link.first + d);
    if (link.parent < 0) continue;
    Inertia& parent = inertias_[Index(link.parent)];
    parent.mass += inertias_[i].mass;
    parent.moment += inertias_[i].moment;
    AddTo(parent.turning, inertias_[i].turning);
  }
  Factorise();
}

// Writes the row of the mass matrix for `velocity`. If this velocity is 1 and all others are 0,
// this part and all parts below it have a momentum. The entry for another velocity on the chain to
// the base is the component of this momentum along that velocity.
void LinkTree::WriteMassesOf(int part, int velocity) {
  const Inertia& inertia = inertias_[Index(part)];
  const auto& [turning, moving] = motions_[Index(velocity)];
  const Vector3 linear = inertia.mass * moving + Cross(turning, inertia.moment);
  const Vector3 angular = inertia.turning * turning + Cross(inertia.moment, moving);
  for (int other = velocity; other >= 0; other = parents_[Index(other)]) {
    const Motion& motion = motions_[Index(other)];
    MassAt(velocity, other) = Dot(motion.turning, angular) + Dot(motion.moving, linear);
  }
}

// The mass matrix is Lᵀ D L, where L has zeros wherever the mass matrix has. A pivot (a value of D)
// consists of rounding errors only if two velocities move all parts alike, as with parallel axes of
// a universal joint. The same happens if masses differ by more digits than a double has. Then the
// minimum pivot is used instead. It acts like the inertia of a motor at the joint: the joint's
// velocity stays finite, and the other velocities keep their accuracy.
void LinkTree::Factorise() {
  factors_ = masses_;
  const auto at = [&](int row, int column) -> double& {
    return factors_[Index(row * size_ + column)];
  };
  for (int k = size_; k-- > 0;) {
    const double least = std::max(kMinPivot, kMinPivotShare * mass(k, k));
    if (!(at(k, k) > least)) at(k, k) = least;
    const double inverse = 1 / at(k, k);
    for (int i = parents_[Index(k)]; i >= 0; i = parents_[Index(i)]) {
      const double factor = at(k, i) * inverse;
      for (int j = i; j >= 0; j = parents_[Index(j)]) at(i, j) -= factor * at(k, j);
      at(k, i) = factor;
    }
  }
}

double LinkTree::Response(int part, std::span<const double> row) const {
  const auto& chain = links_[Index(part)].chain;
  if (is_single()) {
    // The chain runs backwards: linear z, y, x, then angular z, y, x.
    const Vector3 turning{row[5], row[4], row[3]}, moving{row[2], row[1], row[0]};
    return Dot(turning, inverse_inertia_ * turning) + Dot(moving, moving) / links_[0].mass;
  }
  double sum = 0;
  const std::size_t count = chain.size();
  double* const y = scratch_.data();
  std::copy(row.begin(), row.end(), y);
  for (std::size_t k = 0; k < count; ++k) {
    if (y[k] == 0) continue;
    const double* const factors = factors_.data() + Index(chain[k] * size_);
    for (std::size_t j = k + 1; j < count; ++j) y[j] -= factors[chain[j]] * y[k];
    sum += y[k] * y[k] / factors[chain[k]];
  }
  return sum;
}

void LinkTree::Respond(std::span<double> row) const {
  if (is_single()) {
    if (base_size_ == 0) return;
    const Vector3 turning = inverse_inertia_ * Vector3{row[0], row[1], row[2]};
    row[0] = turning.x;
    row[1] = turning.y;
    row[2] = turning.z;
    for (std::size_t i = 3; i < 6; ++i) row[i] /= links_[0].mass;
    return;
  }
  for (int k = size_; k-- > 0;) {
    const double* const factors = factors_.data() + Index(k * size_);
    for (int j = parents_[Index(k)]; j >= 0; j = parents_[Index(j)]) {
      row[Index(j)] -= factors[j] * row[Index(k)];
    }
    row[Index(k)] /= factors[k];
  }
  for (int k = 0; k < size_; ++k) {
    const double* const factors = factors_.data() + Index(k * size_);
    for (int j = parents_[Index(k)]; j >= 0; j = parents_[Index(j)]) {
      row[Index(k)] -= factors[j] * row[Index(j)];
    }
  }
}

void LinkTree::ClearForces() {
  std::fill(efforts_.begin(), efforts_.end(), 0.0);
  std::fill(forces_.begin(), forces_.end(), Vector3{});
  std::fill(torques_.begin(), torques_.end(), Vector3{});
}

void LinkTree::AddForce(int part, const Vector3& force, const Vector3& torque) {
  forces_[Index(part)] += force;
  torques_[Index(part)] += torque;
}

void LinkTree::AccelerateSingle(double seconds) {
  if (base_size_ == 0) return;
  const Link& link = links_[0];
  const Matrix3& rotation = rotations_[0];
  // The residual and its derivative with respect to the angular velocity, in the body's frame.
  const Vector3 w = TransposeTimes(rotation, base_angular_velocity());
  const Vector3 momentum = Scaled(w, link.inertia);
  const Vector3 residual = seconds * Cross(w, momentum);
  const auto column = [&](const Vector3& axis) {
    const Vector3 turned = Scaled(axis, link.inertia);
    return turned + seconds * (Cross(w, turned) - Cross(momentum, axis));
  };
  const Matrix3 slope{column({1, 0, 0}), column({0, 1, 0}), column({0, 0, 1})};
  const Vector3 turning =
      rotation * (w - Solve(slope, residual)) + seconds * (inverse_inertia_ * torques_[0]);
  const Vector3 moving = base_velocity() + (seconds / link.mass) * forces_[0];
  const Vector3 angular = own_inertias_[0] * turning;
  const double free[] = {turning.x, turning.y, turning.z, moving.x, moving.y, moving.z};
  std::copy(std::begin(free), std::end(free), free_.begin());
  const double momenta[] = {
      angular.x,           angular.y, angular.z, link.mass * moving.x, link.mass * moving.y,
      link.mass * moving.z};
  std::copy(std::begin(momenta), std::end(momenta), free_momenta_.begin());
}

// Adds the forces on the parts, and subtracts the efforts of centrifugal, Coriolis and gyroscopic
// effects.
void LinkTree::AddBias() {
  const std::size_t count = links_.size();
  spins_[0] = base_size_ > 0 ? base_angular_velocity() : Vector3{};
  speeds_[0] = base_size_ > 0 ? base_velocity() : Vector3{};
  bias_turning_[0] = {};
  bias_moving_[0] = -Cross(spins_[0], speeds_[0]);
  for (std::size_t i = 1; i < count; ++i) {
    const Link& link = links_[i];
    const std::size_t parent = Index(link.parent);
    Vector3 turning, moving;
    for (int d = 0; d < link.count; ++d) {
      const Motion& motion = motions_[Index(link.first + d)];
      const double rate = velocities_[Index(link.first + d)];
      turning += rate * motion.turning;
      moving += rate * motion.moving;
    }
    spins_[i] = spins_[parent] + turning;
    speeds_[i] = speeds_[parent] + moving;
    bias_turning_[i] = bias_turning_[parent] + Cross(spins_[i], turning);
    bias_moving_[i] = bias_moving_[parent] + Cross(spins_[i], moving) + Cross(speeds_[i], turning);
  }
  // Replaces the bias accelerations by the wrenches that the motion requires, about the base's
  // centre of mass.
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3 at = positions_[i] - positions_[0];
    const Vector3& spin = spins_[i];
    const Vector3 speed = speeds_[i] + Cross(spin, at);
    const Vector3 acceleration = bias_moving_[i] + Cross(bias_turning_[i], at) + Cross(spin, speed);
    const Vector3 force = links_[i].mass * acceleration - forces_[i];
    const Vector3 torque =
        own_inertias_[i] * bias_turning_[i] + Cross(spin, own_inertias_[i] * spin) - torques_[i];
    bias_moving_[i] = force;
    bias_turning_[i] = torque + Cross(at, force);
  }
  for (std::size_t i = count; i-- > 0;) {
    const Link& link = links_[i];
    for (int d = 0; d < link.count; ++d) {
      const Motion& motion = motions_[Index(link.first + d)];
      efforts_[Index(link.first + d)] -=
          Dot(motion.turning, bias_turning_[i]) + Dot(motion.moving, bias_moving_[i]);
    }
    if (link.parent < 0) continue;
    bias_turning_[Index(link.parent)] += bias_turning_[i];
    bias_moving_[Index(link.parent)] += bias_moving_[i];
  }
}

void LinkTree::Accelerate(double seconds) {
  if (is_single()) {
    AccelerateSingle(seconds);
    return;
  }
  AddBias();
  free_ = efforts_;
  Respond(free_);
  for (std::size_t i = 0; i < free_.size(); ++i) {
    free_[i] = velocities_[i] + seconds * free_[i];
    free_momenta_[i] = seconds * efforts_[i];
  }
  for (int i = 0; i < size_; ++i) {
    const double rate = velocities_[Index(i)];
    free_momenta_[Index(i)] += mass(i, i) * rate;
    for (int j = parents_[Index(i)]; j >= 0; j = parents_[Index(j)]) {
      free_momenta_[Index(i)] += mass(i, j) * velocities_[Index(j)];
      free_momenta_[Index(j)] += mass(i, j) * rate;
    }
  }
}

void LinkTree::Move(std::span<const double> velocities, double seconds) {
  if (base_size_ > 0) {
    Shift(seconds * Vector3{velocities[3], velocities[4], velocities[5]},
          seconds * Vector3{velocities[0], velocities[1], velocities[2]});
  }
  for (std::size_t i = 1; i < links_.size(); ++i) {
    const double* const rate = &velocities[Index(links_[i].first)];
    if (ball_of_[i] < 0) {
      joint_positions_[i] += seconds * rate[0];
    } else {
      turns_[i] = Normalized(turns_[i] * RotationBy(seconds * Vector3{rate[0], rate[1], rate[2]}));
    }
  }
}

void LinkTree::Shift(const Vector3& shift, const Vector3& turn) {
  positions_[0] += shift;
  base_ = Normalized(RotationBy(turn) * base_);
}

Pose LinkTree::pose(int part) const {
  if (part == 0) return {positions_[0], base_};
  return {positions_[Index(part)], Normalized(orientations_[Index(part)])};
}

Vector3 LinkTree::base_velocity() const {
  return base_size_ > 0 ? Vector3{velocities_[3], velocities_[4], velocities_[5]} : Vector3{};
}

Vector3 LinkTree::base_angular_velocity() const {
  return base_size_ > 0 ? Vector3{velocities_[0], velocities_[1], velocities_[2]} : Vector3{};
}

void LinkTree::SetBaseVelocity(const Vector3& velocity, const Vector3& angular_velocity) {
  const double values[] = {angular_velocity.x, angular_velocity.y, angular_velocity.z,
                           velocity.x,         velocity.y,         velocity.z};
  std::copy(std::begin(values), std::end(values), velocities_.begin());
}

Vector3 LinkTree::angular_velocity(int part) const {
  Vector3 sum;
  for (const int d : Chain(part)) sum += velocities_[Index(d)] * motions_[Index(d)].turning;
  return sum;
}

Vector3 LinkTree::VelocityOf(int part, const Vector3& point) const {
  Vector3 turning, moving;
  for (const int d : Chain(part)) {
    turning += velocities_[Index(d)] * motions_[Index(d)].turning;
    moving += velocities_[Index(d)] * motions_[Index(d)].moving;
  }
  return moving + Cross(turning, point - positions_[0]);
}

void LinkTree::PointMotions(int part, const Vector3& point, std::vector<Vector3>& motions) const {
  const Vector3 from_base = point - positions_[0];
  motions.clear();
  for (const int d : Chain(part)) {
    const Motion& motion = motions_[Index(d)];
    motions.push_back(motion.moving + Cross(motion.turning, from_base));
  }
}

}  // namespace gsv::dynamics
