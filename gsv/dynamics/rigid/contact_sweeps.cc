#include "gsv/dynamics/rigid/contact_sweeps.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "gsv/base/each_processor.h"

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
  contact.normal = 0;
  contact.coupling = {};
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
    contact.normal += moved(0, 0);
    contact.coupling[0] += moved(1, 0);
    contact.coupling[1] += moved(2, 0);
    contact.a += moved(1, 1);
    contact.b += moved(2, 2);
    contact.c += moved(1, 2);
  }
  const double half = (contact.a - contact.b) / 2;
  contact.max = (contact.a + contact.b) / 2 + std::sqrt(half * half + contact.c * contact.c);
  contact.impulse = {};
  const double radius = friction * impulse[0];
  const double length = std::sqrt(impulse[1] * impulse[1] + impulse[2] * impulse[2]);
  const double scale = length > radius ? radius / length : 1;
  if (!(impulse[0] > 0)) return;
  contact.impulse = {impulse[0], scale * impulse[1], scale * impulse[2]};
  for (std::size_t i = 0; i < 3; ++i) Apply(contact, i, contact.impulse[i]);
}

void ContactSweeps::Apply(const Contact& contact, std::size_t axis, double impulse) {
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

bool ContactSweeps::CanTake(const Batch& batch, int first, int second) {
  for (std::size_t i = 0; i < kFour && batch.contacts[i] >= 0; ++i) {
    for (const int body : {batch.first[i], batch.second[i]}) {
      if (body >= 0 && (body == first || body == second)) return false;
    }
  }
  return true;
}

void ContactSweeps::Fill(Batch& batch, std::size_t value, const Contact& contact) const {
  const auto put = [value](Batch::Vectors& to, const Vector3& from) {
    to[0][value] = from.x;
    to[1][value] = from.y;
    to[2][value] = from.z;
  };
  const auto inverse = [](double x) { return x > 0 ? 1 / x : 0; };
  batch.first[value] = contact.first;
  batch.second[value] = contact.second;
  put(batch.arm_first, contact.arm_first);
  put(batch.arm_second, contact.arm_second);
  for (std::size_t i = 0; i < 3; ++i) {
    put(batch.axes[i], contact.axes[i]);
    put(batch.turn_first[i], contact.turn_first[i]);
    put(batch.turn_second[i], contact.turn_second[i]);
    batch.targets[i][value] = contact.targets[i];
    batch.impulse[i][value] = contact.impulse[i];
  }
  for (std::size_t i = 0; i < 2; ++i) {
    batch.coupling[i][value] = contact.coupling[i];
    batch.softness[i][value] = contact.softness[i];
  }
  batch.normal[value] = contact.normal;
  batch.inverse_normal[value] = inverse(contact.normal);
  batch.a[value] = contact.a;
  batch.b[value] = contact.b;
  batch.c[value] = contact.c;
  batch.inverse_determinant[value] = inverse(contact.a * contact.b - contact.c * contact.c);
  batch.max[value] = contact.max;
  batch.inverse_max[value] = inverse(contact.max);
  batch.friction[value] = contact.friction;
}

int ContactSweeps::LevelOf(int contact) const {
  const Contact& of = contacts_[AsIndex(contact)];
  if (of.first < 0 || of.second < 0) return -1;
  return std::max(levels_[AsIndex(of.first)], levels_[AsIndex(of.second)]);
}

// Puts the contacts into batches, level by level. Contacts of one batch share no body. A contact is
// added to the first of at most kOpen open batches of its level that has space and contains neither
// of its bodies. So the solver may process a contact before other contacts that precede it in
// order_.
void ContactSweeps::MakeBatches() {
  constexpr std::size_t kOpen = 12;
  batches_.clear();
  open_.clear();
  int level = -1;
  for (const int index : order_) {
    if (LevelOf(index) != level) open_.clear();
    level = LevelOf(index);
    const Contact& contact = contacts_[AsIndex(index)];
    auto at = std::find_if(open_.begin(), open_.end(), [&](int batch) {
      return CanTake(batches_[AsIndex(batch)], contact.first, contact.second);
    });
    if (at == open_.end()) {
      if (open_.size() == kOpen) open_.erase(open_.begin());
      open_.push_back(static_cast<int>(batches_.size()));
      Batch& batch = batches_.emplace_back();
      batch.contacts = batch.first = batch.second = {-1, -1, -1, -1};
      at = open_.end() - 1;
    }
    Batch& batch = batches_[AsIndex(*at)];
    const auto value = static_cast<std::size_t>(
        std::find(batch.contacts.begin(), batch.contacts.end(), -1) - batch.contacts.begin());
    batch.contacts[value] = index;
    Fill(batch, value, contact);
    if (value + 1 == kFour) open_.erase(at);
  }
  const int nothing = static_cast<int>(bodies_.size());
  for (Batch& batch : batches_) {
    for (std::size_t i = 0; i < kFour; ++i) {
      if (batch.first[i] < 0) batch.first[i] = nothing;
      if (batch.second[i] < 0) batch.second[i] = nothing;
    }
  }
}

// Solves four contacts at once. Returns the largest change of a velocity at these contacts, m/s.
__attribute__((always_inline)) inline double ContactSweeps::Solve(Batch& batch, double* motions) {
  constexpr std::size_t kSize = 8;  // values of the motion of one body
  FourDoubles v1[kFour], w1[kFour], v2[kFour], w2[kFour];
  for (std::size_t i = 0; i < kFour; ++i) {
    const double* const first = motions + kSize * AsIndex(batch.first[i]);
    const double* const second = motions + kSize * AsIndex(batch.second[i]);
    v1[i] = FourAt(first);
    w1[i] = FourAt(first + kFour);
    v2[i] = FourAt(second);
    w2[i] = FourAt(second + kFour);
  }
  Transpose(v1);
  Transpose(w1);
  Transpose(v2);
  Transpose(w2);
  const auto &r1 = batch.arm_first, &r2 = batch.arm_second;
  // The velocity of the first side relative to the second.
  const FourDoubles x =
      v1[0] + (w1[1] * r1[2] - w1[2] * r1[1]) - v2[0] - (w2[1] * r2[2] - w2[2] * r2[1]);
  const FourDoubles y =
      v1[1] + (w1[2] * r1[0] - w1[0] * r1[2]) - v2[1] - (w2[2] * r2[0] - w2[0] * r2[2]);
  const FourDoubles z =
      v1[2] + (w1[0] * r1[1] - w1[1] * r1[0]) - v2[2] - (w2[0] * r2[1] - w2[1] * r2[0]);
  FourDoubles missing[3], change[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& axis = batch.axes[i];
    missing[i] = batch.targets[i] - (axis[0] * x + axis[1] * y + axis[2] * z);
  }
  auto& impulse = batch.impulse;
  const FourDoubles zero{};
  const FourDoubles wanted = impulse[0] + missing[0] * batch.inverse_normal;
  const FourDoubles normal = wanted > zero ? wanted : zero;
  change[0] = normal - impulse[0];
  const FourDoubles radius = batch.friction * normal;
  // Computes the friction that stops the slip. If this friction exceeds its limit (`radius`),
  // replaces it by one gradient step: the previous friction plus an impulse against the slip,
  // shortened to the limit.
  const FourDoubles slip_a =
      missing[1] - batch.coupling[0] * change[0] - batch.softness[0] * impulse[1];
  const FourDoubles slip_b =
      missing[2] - batch.coupling[1] * change[0] - batch.softness[1] * impulse[2];
  FourDoubles first =
      impulse[1] + batch.inverse_determinant * (batch.b * slip_a - batch.c * slip_b);
  FourDoubles second =
      impulse[2] + batch.inverse_determinant * (batch.a * slip_b - batch.c * slip_a);
  const FourDoubles square = first * first + second * second, limit = radius * radius;
  if (!(square[0] <= limit[0]) || !(square[1] <= limit[1]) || !(square[2] <= limit[2]) ||
      !(square[3] <= limit[3])) {
    for (std::size_t i = 0; i < kFour; ++i) {
      if (square[i] <= limit[i]) continue;
      double a = impulse[1][i] + batch.inverse_max[i] * slip_a[i];
      double b = impulse[2][i] + batch.inverse_max[i] * slip_b[i];
      const double length = std::sqrt(a * a + b * b);
      const double scale = length > radius[i] ? radius[i] / length : 1;
      first[i] = scale * a;
      second[i] = scale * b;
    }
  }
  change[1] = first - impulse[1];
  change[2] = second - impulse[2];
  impulse[0] = normal;
  impulse[1] = first;
  impulse[2] = second;
  FourDoubles largest{};
  for (std::size_t i = 0; i < 3; ++i) {
    const FourDoubles size = change[i] > zero ? change[i] : -change[i];
    const FourDoubles speed = size * (i == 0 ? batch.normal : batch.max);
    largest = speed > largest ? speed : largest;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const FourDoubles total =
        batch.axes[0][k] * change[0] + batch.axes[1][k] * change[1] + batch.axes[2][k] * change[2];
    v1[k] += v1[3] * total;
    v2[k] -= v2[3] * total;
    w1[k] += batch.turn_first[0][k] * change[0] + batch.turn_first[1][k] * change[1] +
             batch.turn_first[2][k] * change[2];
    w2[k] -= batch.turn_second[0][k] * change[0] + batch.turn_second[1][k] * change[1] +
             batch.turn_second[2][k] * change[2];
  }
  Transpose(v1);
  Transpose(w1);
  Transpose(v2);
  Transpose(w2);
  for (std::size_t i = 0; i < kFour; ++i) {
    double* const of_first = motions + kSize * AsIndex(batch.first[i]);
    double* const of_second = motions + kSize * AsIndex(batch.second[i]);
    FourAt(of_first) = v1[i];
    FourAt(of_first + kFour) = w1[i];
    FourAt(of_second) = v2[i];
    FourAt(of_second + kFour) = w2[i];
  }
  return std::max(std::max(largest[0], largest[1]), std::max(largest[2], largest[3]));
}

GSV_FOR_EACH_PROCESSOR
double ContactSweeps::Sweep(std::vector<Batch>& batches, bool is_forwards, double* motions) {
  double max = 0;
  const std::size_t count = batches.size();
  for (std::size_t i = 0; i < count; ++i) {
    max = std::max(max, Solve(batches[is_forwards ? i : count - 1 - i], motions));
  }
  return max;
}

// Computes the levels of the bodies by a breadth-first search from the fixed bodies. Then orders
// the contacts by level.
void ContactSweeps::Order() {
  const int count = static_cast<int>(contacts_.size());
  constexpr int kFar = 1 << 30;
  // the contacts of each body, one body after the other
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
  order_.resize(contacts_.size());
  std::iota(order_.begin(), order_.end(), 0);
  std::stable_sort(order_.begin(), order_.end(),
                   [&](int a, int b) { return LevelOf(a) < LevelOf(b); });
}

int ContactSweeps::Solve(int max_sweeps, double tolerance) {
  Order();
  MakeBatches();
  motions_.clear();
  for (const Body& body : bodies_) {
    const Vector3 &v = body.velocity, &w = body.angular_velocity;
    motions_.insert(motions_.end(), {v.x, v.y, v.z, body.inverse_mass, w.x, w.y, w.z, 0});
  }
  motions_.resize(motions_.size() + 2 * kFour);
  int sweep = 1;
  while (Sweep(batches_, sweep % 2 == 1, motions_.data()) > tolerance && sweep < max_sweeps) {
    ++sweep;
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const double* const m = motions_.data() + 2 * kFour * i;
    bodies_[i].velocity = {m[0], m[1], m[2]};
    bodies_[i].angular_velocity = {m[4], m[5], m[6]};
  }
  for (const Batch& batch : batches_) {
    for (std::size_t i = 0; i < kFour && batch.contacts[i] >= 0; ++i) {
      contacts_[AsIndex(batch.contacts[i])].impulse = {batch.impulse[0][i], batch.impulse[1][i],
                                                       batch.impulse[2][i]};
    }
  }
  return sweep;
}

}  // namespace gsv::dynamics
