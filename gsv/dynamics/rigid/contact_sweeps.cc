#include "gsv/dynamics/rigid/contact_sweeps.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gsv::dynamics {
namespace {

using geometry::Vector3;

std::size_t AsIndex(int i) { return static_cast<std::size_t>(i); }

}  // namespace

void ContactSweeps::Clear() {
  bodies_.clear();
  contacts_.clear();
}

int ContactSweeps::AddBody(const Body& body) {
  bodies_.push_back(body);
  return static_cast<int>(bodies_.size()) - 1;
}

void ContactSweeps::AddContact(const Side& first, const Side& second,
                               const std::array<Vector3, 3>& axes,
                               const std::array<double, 3>& targets, double friction,
                               const std::array<double, 2>& softness,
                               const std::array<double, 3>& impulse) {
  Contact& contact = contacts_.emplace_back();
  contact.first = first.body;
  contact.second = second.body;
  contact.arm_first = first.arm;
  contact.arm_second = second.arm;
  contact.axes = axes;
  contact.targets = targets;
  contact.friction = friction;
  double normal = 0;
  contact.softness = softness;
  contact.a = softness[0];
  contact.b = softness[1];
  contact.c = 0;
  for (const Side* side : {&first, &second}) {
    auto& turns = side == &first ? contact.turn_first : contact.turn_second;
    turns = {};
    if (side->body < 0) continue;
    const Body& body = bodies_[AsIndex(side->body)];
    std::array<Vector3, 3> moments;
    for (std::size_t i = 0; i < 3; ++i) {
      moments[i] = Cross(side->arm, axes[i]);
      turns[i] = body.inverse_inertia * moments[i];
    }
    const auto moved = [&](std::size_t i, std::size_t j) {
      return body.inverse_mass * Dot(axes[i], axes[j]) + Dot(moments[i], turns[j]);
    };
    normal += moved(0, 0);
    contact.a += moved(1, 1);
    contact.b += moved(2, 2);
    contact.c += moved(1, 2);
  }
  contact.inverse_normal = normal > 0 ? 1 / normal : 0;
  const double determinant = contact.a * contact.b - contact.c * contact.c;
  contact.inverse_determinant = determinant > 0 ? 1 / determinant : 0;
  const double half = (contact.a - contact.b) / 2;
  const double most = (contact.a + contact.b) / 2 + std::sqrt(half * half + contact.c * contact.c);
  contact.inverse_most = most > 0 ? 1 / most : 0;
  contact.impulse = {};
  const double radius = friction * impulse[0];
  const double length = std::sqrt(impulse[1] * impulse[1] + impulse[2] * impulse[2]);
  const double scale = length > radius ? radius / length : 1;
  if (!(impulse[0] > 0)) return;
  contact.impulse = {impulse[0], scale * impulse[1], scale * impulse[2]};
  for (std::size_t i = 0; i < 3; ++i) Apply(contact, i, contact.impulse[i]);
}

// Of the first side relative to the second.
inline Vector3 ContactSweeps::VelocityAt(const Contact& contact) const {
  Vector3 velocity;
  if (contact.first >= 0) {
    const Body& body = bodies_[AsIndex(contact.first)];
    velocity = body.velocity + Cross(body.angular_velocity, contact.arm_first);
  }
  if (contact.second >= 0) {
    const Body& body = bodies_[AsIndex(contact.second)];
    velocity -= body.velocity + Cross(body.angular_velocity, contact.arm_second);
  }
  return velocity;
}

inline void ContactSweeps::Apply(const Contact& contact, std::size_t axis, double impulse) {
  if (contact.first >= 0) {
    Body& body = bodies_[AsIndex(contact.first)];
    body.velocity += (impulse * body.inverse_mass) * contact.axes[axis];
    body.angular_velocity += impulse * contact.turn_first[axis];
  }
  if (contact.second >= 0) {
    Body& body = bodies_[AsIndex(contact.second)];
    body.velocity -= (impulse * body.inverse_mass) * contact.axes[axis];
    body.angular_velocity -= impulse * contact.turn_second[axis];
  }
}

// Returns how much a velocity changes, in m/s.
double ContactSweeps::SolveContact(Contact& contact) {
  const double missing = contact.targets[0] - Dot(contact.axes[0], VelocityAt(contact));
  const double normal = std::max(0.0, contact.impulse[0] + missing * contact.inverse_normal);
  const double change = normal - contact.impulse[0];
  if (normal == 0 && change == 0 && contact.impulse[1] == 0 && contact.impulse[2] == 0) return 0;
  contact.impulse[0] = normal;
  if (change != 0) Apply(contact, 0, change);
  const double most_normal = std::abs(change) / contact.inverse_normal;
  if (contact.inverse_most == 0) return most_normal;
  const Vector3 velocity = VelocityAt(contact);
  const double x = contact.targets[1] - Dot(contact.axes[1], velocity) -
                   contact.softness[0] * contact.impulse[1];
  const double y = contact.targets[2] - Dot(contact.axes[2], velocity) -
                   contact.softness[1] * contact.impulse[2];
  const double radius = contact.friction * normal;
  // Friction that stops the slip, or if it is too large, a step against the slip.
  double first = contact.impulse[1] + contact.inverse_determinant * (contact.b * x - contact.c * y);
  double second =
      contact.impulse[2] + contact.inverse_determinant * (contact.a * y - contact.c * x);
  if (!(first * first + second * second <= radius * radius)) {
    first = contact.impulse[1] + contact.inverse_most * x;
    second = contact.impulse[2] + contact.inverse_most * y;
    const double length = std::sqrt(first * first + second * second);
    if (length > radius) {
      first *= radius / length;
      second *= radius / length;
    }
  }
  const double change_first = first - contact.impulse[1];
  const double change_second = second - contact.impulse[2];
  contact.impulse[1] = first;
  contact.impulse[2] = second;
  Apply(contact, 1, change_first);
  Apply(contact, 2, change_second);
  return std::max(most_normal,
                  std::max(std::abs(change_first), std::abs(change_second)) / contact.inverse_most);
}

// By the number of contacts between a contact and one with what does not move.
void ContactSweeps::Order() {
  const int count = static_cast<int>(contacts_.size());
  constexpr int kFar = 1 << 30;
  // The contacts of each body, in a row.
  first_of_body_.assign(bodies_.size() + 1, 0);
  for (const Contact& contact : contacts_) {
    for (const int body : {contact.first, contact.second}) {
      if (body >= 0) ++first_of_body_[AsIndex(body) + 1];
    }
  }
  std::partial_sum(first_of_body_.begin(), first_of_body_.end(), first_of_body_.begin());
  contacts_of_body_.resize(AsIndex(first_of_body_.back()));
  std::vector<int> at(first_of_body_.begin(), first_of_body_.end() - 1);
  levels_.assign(bodies_.size(), kFar);
  queue_.clear();
  for (int i = 0; i < count; ++i) {
    const Contact& contact = contacts_[AsIndex(i)];
    for (const int body : {contact.first, contact.second}) {
      if (body >= 0) contacts_of_body_[AsIndex(at[AsIndex(body)]++)] = i;
    }
    if (contact.first >= 0 && contact.second >= 0) continue;
    const int body = std::max(contact.first, contact.second);
    if (levels_[AsIndex(body)] == 0) continue;
    levels_[AsIndex(body)] = 0;
    queue_.push_back(body);
  }
  for (std::size_t next = 0; next < queue_.size(); ++next) {
    const int body = queue_[next];
    for (int k = first_of_body_[AsIndex(body)]; k < first_of_body_[AsIndex(body) + 1]; ++k) {
      const Contact& contact = contacts_[AsIndex(contacts_of_body_[AsIndex(k)])];
      const int other = contact.first == body ? contact.second : contact.first;
      if (other < 0 || levels_[AsIndex(other)] != kFar) continue;
      levels_[AsIndex(other)] = levels_[AsIndex(body)] + 1;
      queue_.push_back(other);
    }
  }
  const auto level_of = [&](int i) {
    const Contact& contact = contacts_[AsIndex(i)];
    if (contact.first < 0 || contact.second < 0) return -1;
    return std::max(levels_[AsIndex(contact.first)], levels_[AsIndex(contact.second)]);
  };
  order_.resize(contacts_.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::stable_sort(order_.begin(), order_.end(),
                   [&](int a, int b) { return level_of(a) < level_of(b); });
}

int ContactSweeps::Solve(int max_sweeps, double tolerance) {
  Order();
  const std::size_t count = order_.size();
  for (int sweep = 1; sweep <= max_sweeps; ++sweep) {
    double most = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t at = sweep % 2 == 1 ? i : count - 1 - i;
      most = std::max(most, SolveContact(contacts_[AsIndex(order_[at])]));
    }
    if (most <= tolerance) return sweep;
  }
  return max_sweeps;
}

}  // namespace gsv::dynamics
