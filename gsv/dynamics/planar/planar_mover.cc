#include "gsv/dynamics/planar/planar_mover.h"

#include <algorithm>
#include <cmath>

#include "gsv/base/check.h"
#include "gsv/dynamics/planar/mover_collisions.h"
#include "gsv/dynamics/planar/mover_motions.h"
#include "gsv/dynamics/planar/near_obstacles.h"
#include "gsv/dynamics/planar/planar_scene.h"

namespace gsv::dynamics {
namespace {

// Movers are processed in chunks with their own lists, so that results do not depend on the number
// of threads.
constexpr std::size_t kChunk = 16;
// The number of chunks that one thread processes at a time, and the minimum number of chunks for
// which a second thread saves time.
constexpr std::size_t kChunksAtOnce = 4, kMinChunks = 16;

// The same two numbers for the search for near movers. The range is divided among the threads almost
// as in the loop with kMoversAtOnce, so that each thread finds its movers in its cache.
constexpr std::size_t kNearChunksAtOnce = 1, kMinNearChunks = 4;

// StepMany() moves the movers that may touch something in one thread, but Step() divides all movers
// among the threads. So StepMany() returns false if more than 1 / kMaxNearShare of the movers may
// touch something. Its next kPatience calls return false without a check.
constexpr std::size_t kMaxNearShare = 4;
constexpr int kPatience = 16;

// The number of movers that a thread moves by several steps at a time.
constexpr std::size_t kMoversAtOnce = 8;

// A step has up to three legs: the commanded arc; after a contact, a slide along the obstacle; then
// a rotation in place.
class TeamMover final : public PlanarMover {
 public:
  explicit TeamMover(std::shared_ptr<base::ThreadTeam> team)
      : team_(std::move(team)), motions_(scene_), obstacles_(scene_), pairs_(scene_, *team_) {}

  base::Status SetLayout(std::shared_ptr<const world::Layout> layout) override;
  void Step(base::SimTime step, world::State& state,
            std::vector<world::Contact>& contacts) override;
  bool StepMany(base::SimTime step, int count, world::State& state,
                std::vector<world::Contact>& contacts, MotionFollower& follower) override;
  std::vector<world::Contact> Overlaps(const world::State& state, double tolerance) override;
  std::vector<world::Contact> OverlapsOf(const world::State& state, int body,
                                         double tolerance) override;

 private:
  struct Stopped {
    std::uint32_t mover;
    double remaining;  // time left in this step, s
    Journey journey;
  };
  struct alignas(64) Chunk {  // aligned to a cache line, because threads write to adjacent chunks
    bool is_as_sliced, has_room;
    // Used by FindNear(): bit i stands for mover i of the chunk, which may touch something.
    std::uint32_t near;
    std::vector<std::uint32_t> in_contact;  // movers that were in contact before the step
    std::vector<Stopped> stopped;
  };

  std::size_t count() const { return scene_.movers().size(); }
  template <typename Work>
  void ForEachChunk(const Work& work);

  void Slice(const world::State& state);
  // Slices the dynamic bodies that a mover may touch in a step of `seconds`.
  void SliceVisibleObstacles(const world::State& state, double seconds);
  void AddSight(std::uint32_t mover);
  void Begin(const world::State& state, double seconds);
  void BeginChunk(std::size_t index, const world::State& state, double seconds);
  void EndChunk(std::size_t index, double seconds, world::State& state);
  // Adds a mover to a chunk at the start of a step, and moves it in the step's first leg.
  void BeginMover(std::size_t chunk, std::uint32_t mover, const world::State& state,
                  base::SimTime now, double seconds);
  void EndMover(std::size_t chunk, std::uint32_t mover, double seconds, world::State& state);
  void ClearChunk(std::size_t index);
  // Moves the stopped movers in the rest of the step, and computes the contacts.
  void Finish(double seconds, world::State& state, std::vector<world::Contact>& contacts);
  // Lists in near_ the movers that may touch something in the next `count` steps. Returns false if
  // StepMany() must return false.
  bool FindNear(const world::State& state, double seconds, int count);
  void FindNearChunk(std::size_t index, const world::State& state, double seconds, int count);
  // Moves a mover by `count` steps in which it touches nothing.
  void MoveFreely(std::uint32_t mover, base::SimTime step, int count, world::State& state,
                  MotionFollower& follower);
  // Moves the movers of near_ by one step from the time `now`.
  void StepNear(base::SimTime now, double seconds, world::State& state,
                std::vector<world::Contact>& contacts);
  void ListTouching();
  // Stops movers where they touch each other.
  void StopPairs();
  void RunStopped();
  void SlideAlong(double seconds);
  void TurnOnTheSpot();
  void CollectContacts(double gap, std::vector<world::Contact>& contacts);
  void CountContacts(std::vector<world::Contact>& contacts, world::State& state) const;
  bool FindNeighbours(std::uint32_t mover, const world::State& state);

  const std::shared_ptr<base::ThreadTeam> team_;
  PlanarScene scene_;
  std::vector<Sight> sights_;  // the areas in which movers look for obstacles, if there are dynamic
                               // bodies
  MoverMotions motions_;
  NearObstacles obstacles_;
  MoverCollisions pairs_;
  std::vector<Chunk> chunks_;
  std::vector<BodyPair> touching_;         // pairs that touched at the step's start, in ascending
                                           // order
  std::vector<Stopped> stopped_;           // movers that were stopped in this step, in ascending
                                           // order
  std::vector<std::uint32_t> neighbours_;  // used by OverlapsOf()

  // Used by StepMany().
  std::vector<std::uint8_t> is_near_;  // for each mover, whether it may touch something
  std::vector<std::uint32_t> near_;    // these movers, in ascending order
  // Whether the movers of near_ take their steps, while the team moves the other movers.
  bool moves_near_ = false;
  int patience_ = 0;  // number of further calls of StepMany() that return false at once
};

base::Status TeamMover::SetLayout(std::shared_ptr<const world::Layout> layout) {
  if (auto ok = scene_.SetLayout(std::move(layout)); !ok) return ok;
  chunks_.resize((count() + kChunk - 1) / kChunk);
  motions_.Resize();
  is_near_.assign(count(), 0);
  patience_ = 0;
  return {};
}

template <typename Work>
void TeamMover::ForEachChunk(const Work& work) {
  const std::size_t at_once = chunks_.size() < kMinChunks ? kMinChunks : kChunksAtOnce;
  team_->ParallelFor(chunks_.size(), at_once, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) work(i);
  });
}

void TeamMover::Slice(const world::State& state) {
  scene_.Slice(state);
  obstacles_.Reset(chunks_.size());
  pairs_.Reset();
}

void TeamMover::AddSight(std::uint32_t mover) {
  const geometry::PlanarPosition& at = motions_.positions[mover];
  sights_.push_back(
      {{at.x, at.y}, scene_.footprint(mover).radius + motions_.reaches[mover] + kLookAround});
}

void TeamMover::SliceVisibleObstacles(const world::State& state, double seconds) {
  if (!scene_.has_dynamic()) return;
  sights_.clear();
  for (std::uint32_t m = 0; m < count(); ++m) {
    motions_.Load(m, state);
    motions_.FollowCommand(m, state, state.time, seconds);
    AddSight(m);
  }
  scene_.SliceDynamicObstacles(state, sights_);
}

// Finds the obstacles and pairs that may collide in a step of `seconds`. With 0 s, finds those that
// overlap now, because nothing moves.
void TeamMover::Begin(const world::State& state, double seconds) {
  if (!scene_.HasValidSlices(state)) Slice(state);
  SliceVisibleObstacles(state, seconds);
  const auto all = [&](bool Chunk::*is) {
    return std::all_of(chunks_.begin(), chunks_.end(), [&](const Chunk& c) { return c.*is; });
  };
  const auto begin_chunk = [&](std::size_t i) { BeginChunk(i, state, seconds); };
  ForEachChunk(begin_chunk);
  if (!all(&Chunk::is_as_sliced)) {
    Slice(state);
    scene_.SliceDynamicObstacles(state, sights_);
    ForEachChunk(begin_chunk);
  }
  if (!all(&Chunk::has_room)) pairs_.FindCandidates(motions_.positions, motions_.reaches);
  pairs_.Find(motions_.positions, motions_.reaches);
  ListTouching();
}

void TeamMover::BeginChunk(std::size_t index, const world::State& state, double seconds) {
  ClearChunk(index);
  const std::size_t end = std::min(count(), (index + 1) * kChunk);
  for (auto m = static_cast<std::uint32_t>(index * kChunk); m < end; ++m) {
    BeginMover(index, m, state, state.time, seconds);
  }
  obstacles_.Stop(index, motions_.positions, motions_.twists, motions_.times, motions_.normals);
}

void TeamMover::ClearChunk(std::size_t index) {
  Chunk& chunk = chunks_[index];
  chunk.is_as_sliced = chunk.has_room = true;
  chunk.near = 0;
  chunk.in_contact.clear();
  chunk.stopped.clear();
  obstacles_.Clear(index);
}

[[gnu::always_inline]] inline void TeamMover::BeginMover(std::size_t index, std::uint32_t m,
                                                         const world::State& state,
                                                         base::SimTime now, double seconds) {
  Chunk& chunk = chunks_[index];
  const world::BodyState& body = state.bodies[scene_.movers()[m].body];
  motions_.Load(m, state);
  motions_.FollowCommand(m, state, now, seconds);
  if (body.in_contact) chunk.in_contact.push_back(m);
  if (!scene_.IsSlicedAtHeight(m, body.world_from_model.position.z)) chunk.is_as_sliced = false;
  if (!pairs_.HasRoom(m, motions_.positions[m], motions_.reaches[m])) chunk.has_room = false;
  obstacles_.Find(index, m, motions_.positions[m], motions_.reaches[m]);
}

void TeamMover::ListTouching() {
  touching_.clear();
  obstacles_.AddTouching(touching_);
  pairs_.AddTouching(touching_);
  std::sort(touching_.begin(), touching_.end());
}

void TeamMover::EndChunk(std::size_t index, double seconds, world::State& state) {
  const std::size_t end = std::min(count(), (index + 1) * kChunk);
  for (auto m = static_cast<std::uint32_t>(index * kChunk); m < end; ++m) {
    EndMover(index, m, seconds, state);
  }
}

[[gnu::always_inline]] inline void TeamMover::EndMover(std::size_t chunk, std::uint32_t m,
                                                       double seconds, world::State& state) {
  Journey journey;
  motions_.RunLeg(m, journey);
  if (motions_.times[m] < seconds && Moves(motions_.twists[m])) {
    chunks_[chunk].stopped.push_back({m, seconds - motions_.times[m], journey});
  } else {
    motions_.Store(m, journey, seconds, state);
  }
  motions_.SetLeg(m, geometry::Twist{}, 0);
}

void TeamMover::StopPairs() {
  const auto stop = moves_near_ ? &MoverCollisions::StopAlone : &MoverCollisions::Stop;
  (pairs_.*stop)(motions_.positions, motions_.twists, motions_.times, motions_.normals);
}

void TeamMover::RunStopped() {
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    obstacles_.Stop(i, motions_.positions, motions_.twists, motions_.times, motions_.normals);
  }
  StopPairs();
  for (Stopped& stopped : stopped_) motions_.RunLeg(stopped.mover, stopped.journey);
}

void TeamMover::SlideAlong(double seconds) {
  bool any = false;
  for (const Stopped& stopped : stopped_) {
    const std::uint32_t m = stopped.mover;
    world::DriveCommand& motion = motions_.drives[m];
    const geometry::PlanarPosition& at = motions_.positions[m];
    const Vector2 normal = motions_.normals[m];
    const Vector2 into{at.cosine * normal.x + at.sine * normal.y,
                       at.cosine * normal.y - at.sine * normal.x};
    const double blocked = std::max(0.0, into.x * motion.linear + into.y * motion.lateral);
    const bool slides = motions_.kinematics(m).can_move_sideways();
    motion.linear = slides ? motion.linear - blocked * into.x : 0;
    motion.lateral = slides ? motion.lateral - blocked * into.y : 0;
    if (!slides || std::hypot(motion.linear, motion.lateral) * seconds < kStopGap) {
      motion.linear = motion.lateral = 0;
      continue;
    }
    motions_.SetLeg(m, {motion.linear, motion.lateral, 0}, stopped.remaining);
    any = true;
  }
  if (!any) return;
  RunStopped();
  for (const Stopped& stopped : stopped_) {
    if (motions_.times[stopped.mover] >= stopped.remaining) continue;
    motions_.drives[stopped.mover].linear = motions_.drives[stopped.mover].lateral = 0;
  }
}

void TeamMover::TurnOnTheSpot() {
  for (const Stopped& stopped : stopped_) {
    const std::uint32_t m = stopped.mover;
    if (!motions_.kinematics(m).can_turn_on_the_spot()) motions_.drives[m].angular = 0;
    motions_.SetLeg(m, motions_.kinematics(m).OriginTwist({0, 0, motions_.drives[m].angular}),
                    stopped.remaining);
  }
  RunStopped();
  for (const Stopped& stopped : stopped_) {
    world::DriveCommand& motion = motions_.drives[stopped.mover];
    const double time = motions_.times[stopped.mover];
    // A base that slides along an obstacle keeps the direction of its velocity in the world. So the
    // velocity is converted to the frame of the rotated base.
    const double angle = motion.angular * time;
    motion = {motion.linear * std::cos(angle) + motion.lateral * std::sin(angle),
              motion.lateral * std::cos(angle) - motion.linear * std::sin(angle), motion.angular};
    if (time < stopped.remaining) motion.angular = 0;
  }
}

void TeamMover::CollectContacts(double gap, std::vector<world::Contact>& contacts) {
  ContactCollector collector(contacts, gap);
  obstacles_.Collect(motions_.positions, collector);
  pairs_.Collect(motions_.positions, collector);
  collector.Finish(touching_);
}

void TeamMover::CountContacts(std::vector<world::Contact>& contacts, world::State& state) const {
  for (world::Contact& contact : contacts) {
    world::BodyState& first = state.bodies[contact.first];
    world::BodyState& second = state.bodies[contact.second];
    const bool both_driven = scene_.layout().bodies[contact.second].is_planar();
    // If the base did not touch this body at the start of the step, the contact begins now.
    contact.began = contact.began || !first.in_contact || (both_driven && !second.in_contact);
    if (!contact.began) continue;
    ++first.collisions;
    if (both_driven) ++second.collisions;
  }
  for (const Chunk& chunk : chunks_) {
    for (const std::uint32_t m : chunk.in_contact) {
      state.bodies[scene_.movers()[m].body].in_contact = false;
    }
  }
  for (const world::Contact& contact : contacts) {
    state.bodies[contact.first].in_contact = true;
    if (scene_.layout().bodies[contact.second].is_planar()) {
      state.bodies[contact.second].in_contact = true;
    }
  }
}

void TeamMover::Step(base::SimTime step, world::State& state,
                     std::vector<world::Contact>& contacts) {
  GSV_CHECK(step > base::SimTime(0));
  const double seconds = base::ToSeconds(step);
  Begin(state, seconds);
  StopPairs();
  ForEachChunk([&](std::size_t i) { EndChunk(i, seconds, state); });
  Finish(seconds, state, contacts);
}

void TeamMover::Finish(double seconds, world::State& state, std::vector<world::Contact>& contacts) {
  stopped_.clear();
  for (const Chunk& chunk : chunks_) {
    stopped_.insert(stopped_.end(), chunk.stopped.begin(), chunk.stopped.end());
  }
  if (!stopped_.empty()) {
    SlideAlong(seconds);
    TurnOnTheSpot();
    for (const Stopped& stopped : stopped_)
      motions_.Store(stopped.mover, stopped.journey, seconds, state);
  }
  CollectContacts(kTouchGap, contacts);
  CountContacts(contacts, state);
}

// Most movers are far from everything that they could touch in a few steps. Each of these movers
// takes all its steps at once, while its data are in the cache. The result is the same as with
// single steps: in each single step, no obstacle and no other mover would be near such a mover.
// Meanwhile, the calling thread moves the other movers step by step.
bool TeamMover::StepMany(base::SimTime step, int steps, world::State& state,
                         std::vector<world::Contact>& contacts, MotionFollower& follower) {
  GSV_CHECK(step > base::SimTime(0) && steps >= 2);
  const double seconds = base::ToSeconds(step);
  if (patience_ > 0) {
    --patience_;
    return false;
  }
  if (scene_.has_dynamic() || !scene_.HasValidSlices(state)) return false;
  if (!FindNear(state, seconds, steps)) return false;
  const auto move_freely = [&](std::size_t begin, std::size_t end) {
    for (auto m = static_cast<std::uint32_t>(begin); m < end; ++m) {
      if (is_near_[m] == 0) MoveFreely(m, step, steps, state, follower);
    }
  };
  const auto move_near = [&] {
    moves_near_ = true;
    for (int i = 0; i < steps; ++i) {
      StepNear(state.time + i * step, seconds, state, contacts);
      for (const std::uint32_t m : near_) {
        follower.OnMoved(scene_.movers()[m].body, 1, steps - 1 - i, true);
      }
    }
    moves_near_ = false;
    follower.OnContacts();
  };
  team_->ParallelFor(count(), kMoversAtOnce, move_freely, move_near);
  return true;
}

bool TeamMover::FindNear(const world::State& state, double seconds, int steps) {
  const std::size_t at_once = chunks_.size() < kMinNearChunks ? kMinNearChunks : kNearChunksAtOnce;
  team_->ParallelFor(chunks_.size(), at_once, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) FindNearChunk(i, state, seconds, steps);
  });
  bool has_room = true;
  for (const Chunk& chunk : chunks_) {
    if (!chunk.is_as_sliced) return false;
    has_room = has_room && chunk.has_room;
  }
  if (!has_room) pairs_.FindCandidates(motions_.positions, motions_.reaches);
  for (std::uint32_t m = 0; m < count(); ++m) {
    is_near_[m] = chunks_[m / kChunk].near >> m % kChunk & 1;
  }
  pairs_.MarkNear(motions_.positions, motions_.reaches, is_near_);
  near_.clear();
  for (std::uint32_t m = 0; m < count(); ++m) {
    if (is_near_[m] != 0) near_.push_back(m);
  }
  if (near_.size() * kMaxNearShare <= count()) return true;
  patience_ = kPatience;
  return false;
}

void TeamMover::FindNearChunk(std::size_t index, const world::State& state, double seconds,
                              int steps) {
  ClearChunk(index);
  Chunk& chunk = chunks_[index];
  const std::size_t end = std::min(count(), (index + 1) * kChunk);
  for (auto m = static_cast<std::uint32_t>(index * kChunk); m < end; ++m) {
    const world::BodyState& body = state.bodies[scene_.movers()[m].body];
    const geometry::Vector3& origin = body.world_from_model.position;
    motions_.SetReach(m, state, seconds, steps);
    const double reach = motions_.reaches[m];
    geometry::PlanarPosition& at = motions_.positions[m];
    at.x = origin.x, at.y = origin.y;  // Load() sets the heading if obstacles_.Find() needs it
    if (!scene_.IsSlicedAtHeight(m, origin.z)) chunk.is_as_sliced = false;
    if (!pairs_.HasRoom(m, at, reach)) chunk.has_room = false;
    if (!obstacles_.IsClear(m, at, reach)) {
      motions_.Load(m, state);
      obstacles_.Find(index, m, at, reach);
    }
    const bool is_near = body.in_contact || !obstacles_.IsClear(m, at, reach);
    // Not a byte for each mover: threads would write to one cache line at the same time.
    chunk.near |= static_cast<std::uint32_t>(is_near) << m % kChunk;
  }
  obstacles_.Clear(index);  // StepNear() calls obstacles_.Find() again in each of its steps
}

[[gnu::flatten]] void TeamMover::MoveFreely(std::uint32_t m, base::SimTime step, int steps,
                                            world::State& state, MotionFollower& follower) {
  const double seconds = base::ToSeconds(step);
  const int index = scene_.movers()[m].body;
  const world::DriveState& drive = state.bodies[index].drive;
  base::SimTime now = state.time;
  for (int left = steps - 1; left >= 0; --left, now += step) {
    const world::DriveCommand before = drive.actual;
    // If the base did not rotate in the previous step, its position is already what Load() would
    // compute from the state.
    if (left == steps - 1 || motions_.twists[m].angular != 0) motions_.Load(m, state);
    motions_.FollowCommand(m, state, now, seconds);
    Journey journey;
    motions_.RunLeg(m, journey);
    motions_.Store(m, journey, seconds, state);
    follower.OnMoved(index, 1, left, false);
    const bool is_steady = left > 0 && motions_.IsStraightAndSteady(m, before) &&
                           !motions_.kinematics(m).BecomesStale(drive, now, now + left * step);
    if (!is_steady) continue;
    motions_.Repeat(m, journey, left, state);
    follower.OnMoved(index, left, 0, false);
    break;
  }
  motions_.SetLeg(m, geometry::Twist{}, 0);
}

// All movers of near_ are in the first chunk. The other chunks are empty.
void TeamMover::StepNear(base::SimTime now, double seconds, world::State& state,
                         std::vector<world::Contact>& contacts) {
  if (near_.empty()) {
    contacts.clear();
    return;
  }
  ClearChunk(0);
  for (const std::uint32_t m : near_) BeginMover(0, m, state, now, seconds);
  obstacles_.Stop(0, motions_.positions, motions_.twists, motions_.times, motions_.normals);
  pairs_.FindMarked(motions_.positions, motions_.reaches);
  ListTouching();
  StopPairs();
  for (const std::uint32_t m : near_) EndMover(0, m, seconds, state);
  Finish(seconds, state, contacts);
}

std::vector<world::Contact> TeamMover::Overlaps(const world::State& state, double tolerance) {
  std::vector<world::Contact> contacts;
  Begin(state, 0);
  CollectContacts(-tolerance, contacts);
  return contacts;
}

// Lists the movers whose discs overlap the disc of one mover. Returns false if a body has moved
// since it was sliced.
bool TeamMover::FindNeighbours(std::uint32_t mover, const world::State& state) {
  neighbours_.clear();
  const auto& movers = scene_.movers();
  const geometry::Vector3& at = state.bodies[movers[mover].body].world_from_model.position;
  bool is_as_sliced = true;
  for (std::uint32_t m = 0; m < movers.size(); ++m) {
    const geometry::Pose& pose = state.bodies[movers[m].body].world_from_model;
    is_as_sliced = is_as_sliced && scene_.IsSlicedAtHeight(m, pose.position.z);
    const Vector2 apart{pose.position.x - at.x, pose.position.y - at.y};
    const double reach =
        scene_.footprint(m).radius + scene_.footprint(mover).radius + 2 * kTouchGap;
    if (m == mover || Dot(apart, apart) > reach * reach) continue;
    motions_.Load(m, state);
    neighbours_.push_back(m);
  }
  return is_as_sliced;
}

std::vector<world::Contact> TeamMover::OverlapsOf(const world::State& state, int body,
                                                  double tolerance) {
  const auto& movers = scene_.movers();
  const auto found =
      std::lower_bound(movers.begin(), movers.end(), body,
                       [](const Mover& mover, int index) { return mover.body < index; });
  if (found == movers.end() || found->body != body) {
    auto contacts = Overlaps(state, tolerance);
    std::erase_if(contacts, [&](const world::Contact& c) { return c.second != body; });
    return contacts;
  }
  const auto mover = static_cast<std::uint32_t>(found - movers.begin());
  if (!scene_.HasValidSlices(state) || !FindNeighbours(mover, state)) {
    Slice(state);
    FindNeighbours(mover, state);
  }
  for (std::size_t i = 0; i < chunks_.size(); ++i) obstacles_.Clear(i);
  motions_.Load(mover, state);
  motions_.FollowCommand(mover, state, state.time, 0);
  sights_.clear();
  AddSight(mover);
  scene_.SliceDynamicObstacles(state, sights_);
  obstacles_.Find(mover / kChunk, mover, motions_.positions[mover], 0);
  pairs_.FindOf(mover, neighbours_, motions_.positions);
  ListTouching();
  std::vector<world::Contact> contacts;
  CollectContacts(-tolerance, contacts);
  return contacts;
}

}  // namespace

std::unique_ptr<PlanarMover> MakePlanarMover(std::shared_ptr<base::ThreadTeam> team) {
  if (team == nullptr) team = std::make_shared<base::ThreadTeam>(1);
  return std::make_unique<TeamMover>(std::move(team));
}

}  // namespace gsv::dynamics
