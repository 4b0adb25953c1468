#include "gsv/dynamics/rigid/rigid_step.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Vector3;

// s: the longest and the shortest substep
constexpr double kLongest = 1e-3, kShortest = 1e-3 / 16;
// Substeps are shortened, so that a body moves in a substep by at most this fraction of half of its
// smallest thickness. So it passes through nothing.
constexpr double kPassable = 0.4;
// m: planar bodies that are closer than this to the area of a rigid body are obstacles in the step
constexpr double kNear = 0.05;

std::size_t At(int i) { return static_cast<std::size_t>(i); }

}  // namespace

template <typename Work>
void RigidStep::ForEachBody(const Work& work) {
  // Waking a thread costs as much as preparing this number of bodies.
  constexpr std::size_t kGrain = 16;
  const auto all = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) work(*bodies_[i]);
  };
  if (team_ == nullptr) {
    all(0, bodies_.size());
  } else {
    team_->ParallelFor(bodies_.size(), kGrain, all);
  }
}

void RigidStep::SetScene(const RigidScene& scene) {
  scene_ = &scene;
  bodies_.clear();
  starts_.clear();
  int size = 0;
  for (const RigidBody& body : scene.bodies()) {
    bodies_.push_back(std::make_unique<MovingBody>(body, *scene.layout().description));
    starts_.push_back(size);
    size += bodies_.back()->tree().size();
  }
  velocities_.assign(At(size), 0);
  finder_.SetScene(scene, bodies_);
}

void RigidStep::Start(const world::State& before, const world::State& after, double seconds) {
  seconds_ = seconds;
  ForEachBody([&](MovingBody& body) {
    body.Load(before);
    body.Place();
  });
  finder_.Start(before);
  finder_.PlaceBodies();
  AddPlanarNear(before, after);
}

std::vector<Area> RigidStep::MakeAreas() const {
  std::vector<Area> areas;
  const double fall = Norm(scene_->layout().description->gravity) * seconds_ * seconds_ / 2;
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    Area area;
    finder_.Bounds(static_cast<int>(i), area.low, area.high);
    const double reach = kNear + fall + bodies_[i]->Speed() * seconds_;
    area.low -= Vector3{reach, reach, reach};
    area.high += Vector3{reach, reach, reach};
    areas.push_back(area);
  }
  return areas;
}

void RigidStep::AddPlanarNear(const world::State& before, const world::State& after) {
  planar_.clear();
  if (scene_->planar().empty()) return;
  const std::vector<Area> areas = MakeAreas();
  for (const Solid& solid : scene_->planar()) {
    if (!IsNear(solid, before, after, areas)) continue;
    const Pose& start = before.bodies[At(solid.body)].world_from_model;
    const Pose& end = after.bodies[At(solid.body)].world_from_model;
    const double turn =
        geometry::WrapAngle(geometry::Yaw(end.orientation) - geometry::Yaw(start.orientation));
    finder_.AddPlanar(solid);
    planar_.push_back({&solid, start, end.position - start.position, turn});
  }
  MovePlanar(0);
}

void RigidStep::MovePlanar(double time) {
  for (std::size_t i = 0; i < planar_.size(); ++i) {
    const Planar& planar = planar_[i];
    const double part = seconds_ > 0 ? time / seconds_ : 0;
    const double rate = seconds_ > 0 ? 1 / seconds_ : 0;
    finder_.MovePlanar(
        static_cast<int>(i),
        {planar.start.position + part * planar.travel,
         geometry::FromAxisAngle({0, 0, 1}, part * planar.turn) * planar.start.orientation},
        rate * planar.travel, {0, 0, rate * planar.turn});
  }
}

void RigidStep::AddPushes(std::span<const Push> pushes) {
  pushes_.clear();
  for (std::size_t i = 0; i < pushes.size(); ++i) {
    const auto found = std::find_if(bodies_.begin(), bodies_.end(), [&](const auto& body) {
      return body->plan().body == pushes[i].object;
    });
    if (found == bodies_.end() || !(*found)->tree().is_single() || (*found)->tree().size() == 0) {
      continue;
    }
    ActivePush& push = pushes_.emplace_back();
    push.push = static_cast<int>(i);
    push.row.moving = static_cast<int>(found - bodies_.begin());
    push.row.normal = pushes[i].normal;
    push.row.speed = pushes[i].speed;
    Vector3 low, high;
    finder_.Bounds(push.row.moving, low, high);
    // The push acts where a tipping body leans on the robot. This is at the lowest height at which
    // the body and the pushing part of the robot overlap.
    Vector3 point = pushes[i].point;
    point.z = std::max(pushes[i].low, low.z);
    push.point_in_body = Inverse((*found)->tree().pose(0)) * point;
  }
}

// A push acts from the time at which its robot reaches the body.
void RigidStep::StartPushes(std::span<const Push> pushes, double time, double substep) {
  push_rows_.clear();
  for (ActivePush& push : pushes_) {
    const Push& of = pushes[At(push.push)];
    push.has_started = push.has_started || time >= of.start;
    push.row.limit = push.has_started ? of.force * substep : 0;
    push.row.impulse = 0;
    push.row.point = bodies_[At(push.row.moving)]->tree().pose(0) * push.point_in_body;
    push_rows_.push_back(push.row);
  }
}

double RigidStep::SubstepFor(double left) const {
  double longest = kLongest;
  for (const auto& body : bodies_) {
    const double speed = body->Speed(), room = kPassable * body->thickness();
    if (speed * longest > room) longest = room / speed;
  }
  return left / std::ceil(left / std::max(longest, kShortest) - 1e-9);
}

// Returns the moving body on which impulses on a collider act, or -1.
int RigidStep::MovedBy(int collider) const {
  const int moving = finder_.collider(collider).moving;
  return moving >= 0 && bodies_[At(moving)]->tree().size() > 0 ? moving : -1;
}

int RigidStep::RootOf(int moving) {
  while (parents_[At(moving)] != moving) {
    moving = parents_[At(moving)] = parents_[At(parents_[At(moving)])];
  }
  return moving;
}

// Merges the islands of two bodies (union-find). The body with the lowest index represents its
// island.
void RigidStep::Join(int a, int b) {
  const int x = RootOf(a), y = RootOf(b);
  parents_[At(std::max(x, y))] = std::min(x, y);
}

// Lists the islands in the order of their first bodies.
void RigidStep::MakeIslands() {
  const int count = static_cast<int>(bodies_.size());
  parents_.resize(bodies_.size());
  for (int i = 0; i < count; ++i) parents_[At(i)] = i;
  for (const Contact& contact : *contacts_) {
    const int a = MovedBy(contact.first), b = MovedBy(contact.second);
    if (a >= 0 && b >= 0) Join(a, b);
  }
  islands_of_.assign(bodies_.size(), -1);
  island_count_ = 0;
  for (int i = 0; i < count; ++i) {
    if (bodies_[At(i)]->tree().size() == 0) continue;
    const int root = RootOf(i);
    if (root == i) {
      islands_of_[At(i)] = static_cast<int>(island_count_);
      if (island_count_ == islands_.size()) islands_.emplace_back();
      islands_[island_count_++].Clear();
    }
    islands_of_[At(i)] = islands_of_[At(root)];
    islands_[At(islands_of_[At(i)])].AddBody(i);
  }
  for (std::size_t i = 0; i < contacts_->size(); ++i) {
    const Contact& contact = (*contacts_)[i];
    int moving = MovedBy(contact.first);
    if (moving < 0) moving = MovedBy(contact.second);
    if (moving >= 0) islands_[At(islands_of_[At(moving)])].AddContact(static_cast<int>(i));
  }
  for (std::size_t i = 0; i < push_rows_.size(); ++i) {
    islands_[At(islands_of_[At(push_rows_[i].moving)])].AddPush(static_cast<int>(i));
  }
}

void RigidStep::SolveIslands(double substep) {
  // Waking a thread costs as much as solving this number of islands of this size.
  constexpr std::size_t kGrain = 4;
  shifts_.assign(bodies_.size(), {});
  const auto solve = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      islands_[i].Solve(finder_, bodies_, *contacts_, push_rows_, starts_, velocities_, substep);
      islands_[i].RemoveOverlaps(finder_, bodies_, *contacts_, substep, shifts_);
    }
  };
  if (team_ == nullptr) {
    solve(0, island_count_);
  } else {
    team_->ParallelFor(island_count_, kGrain, solve);
  }
}

void RigidStep::KeepImpulses(double substep) {
  kept_ = nullptr;
  for (std::size_t i = 0; i < island_count_; ++i) {
    if (!islands_[i].starts_from_impulses()) continue;
    if (kept_ == nullptr) kept_ = std::make_shared<KeptImpulses>();
    for (const int contact : islands_[i].contacts()) {
      kept_->Add(finder_, (*contacts_)[At(contact)], substep);
    }
  }
  if (kept_ != nullptr) kept_->Finish();
}

void RigidStep::MoveBodies(double substep) {
  is_touched_.assign(bodies_.size(), 0);
  for (const Contact& contact : *contacts_) {
    if (!(contact.impulse[0] > 0) && !(contact.point.distance < 0)) continue;
    for (const int collider : {contact.first, contact.second}) {
      const int moving = finder_.collider(collider).moving;
      if (moving >= 0) is_touched_[At(moving)] = 1;
    }
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    MovingBody& body = *bodies_[i];
    body.AfterSubstep(
        std::span<const double>(velocities_).subspan(At(starts_[i]), At(body.tree().size())),
        is_touched_[i] != 0, substep);
    body.Separate(shifts_[i], substep);
  }
}

void RigidStep::TakeSubstep(double time, double substep, std::span<const Push> pushes,
                            RigidContacts& contacts) {
  MovePlanar(time);
  ForEachBody([&](MovingBody& body) { body.BeforeSubstep(substep); });
  StartPushes(pushes, time, substep);
  contacts_ = &finder_.Find(substep);
  const auto* const kept =
      kept_ != nullptr ? kept_.get() : dynamic_cast<const KeptImpulses*>(kept_before_.get());
  if (kept != nullptr) kept->StartFrom(finder_, *contacts_, substep);
  MakeIslands();
  SolveIslands(substep);
  KeepImpulses(substep);
  contacts.Add(finder_, *contacts_);
  MoveBodies(substep);
  for (std::size_t i = 0; i < pushes_.size(); ++i) pushes_[i].impulse += push_rows_[i].impulse;
  ForEachBody([](MovingBody& body) { body.Place(); });
  finder_.PlaceBodies();
}

void RigidStep::Run(const world::State& before, const world::State& after, double seconds,
                    std::span<Push> pushes, RigidContacts& contacts) {
  Start(before, after, seconds);
  kept_before_ = before.engine;
  kept_ = nullptr;
  AddPushes(pushes);
  for (double time = 0; seconds - time > 1e-12;) {
    const double substep = SubstepFor(seconds - time);
    TakeSubstep(time, substep, pushes, contacts);
    time += substep;
  }
  for (const ActivePush& push : pushes_) {
    const LinkTree& tree = bodies_[At(push.row.moving)]->tree();
    Push& of = pushes[At(push.push)];
    of.achieved = Dot(of.normal, tree.VelocityOf(0, tree.pose(0) * push.point_in_body));
    of.impulse = push.impulse;
  }
}

std::vector<world::Contact> RigidStep::OverlapsOf(const world::State& state, int body,
                                                  double tolerance) {
  Start(state, state, 0);
  std::map<BodyPair, double> depths;
  for (const Contact& contact : finder_.Find(0)) {
    const int a = finder_.collider(contact.first).solid->body;
    const int b = finder_.collider(contact.second).solid->body;
    if (a == b || (a != body && b != body)) continue;
    const double depth = -contact.point.distance;
    if (!(depth > tolerance)) continue;
    double& deepest = depths[{std::min(a, b), std::max(a, b)}];
    deepest = std::max(deepest, depth);
  }
  std::vector<world::Contact> overlaps;
  for (const auto& [pair, depth] : depths) {
    world::Contact& overlap = overlaps.emplace_back();
    overlap.first = pair.first;
    overlap.second = pair.second;
    overlap.depth = depth;
  }
  return overlaps;
}

void RigidStep::Store(world::State& state) const {
  bool all_rest = true;
  for (const auto& body : bodies_) all_rest = body->Store(seconds_, state) && all_rest;
  // If all bodies are at rest, the stored impulses stay, because RestingState compares them.
  if (!all_rest || kept_ == nullptr || state.engine == nullptr) state.engine = kept_;
}

}  // namespace gsv::dynamics
