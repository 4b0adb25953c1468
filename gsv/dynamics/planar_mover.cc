#include "gsv/dynamics/planar_mover.h"

#include <algorithm>
#include <cmath>

#include "gsv/base/check.h"
#include "gsv/dynamics/near_obstacles.h"
#include "gsv/dynamics/near_pairs.h"
#include "gsv/dynamics/obstacles.h"
#include "gsv/dynamics/planar_scene.h"

namespace gsv::dynamics {
namespace {

using geometry::Quaternion;

// Movers are taken in chunks, each with lists of its own, so that no outcome depends on threads.
constexpr std::size_t kChunk = 128;
// So many chunks pay for another thread.
constexpr std::size_t kChunksAtOnce = 4;

// Where a body stands and how it heads, without a detour through angles.
PlanarPosition PositionOf(const geometry::Pose& pose) {
  const Quaternion& q = pose.orientation;
  const double cosine = 1 - 2 * (q.y * q.y + q.z * q.z), sine = 2 * (q.w * q.z + q.x * q.y);
  const double length = std::sqrt(cosine * cosine + sine * sine);
  if (!(length > 0)) return {pose.position.x, pose.position.y, 1, 0};
  return {pose.position.x, pose.position.y, cosine / length, sine / length};
}

double SpeedOf(const Twist& twist) {
  return twist.y == 0 ? std::abs(twist.x) : std::sqrt(twist.x * twist.x + twist.y * twist.y);
}

bool Moves(const Twist& twist) { return twist.x != 0 || twist.y != 0 || twist.angular != 0; }

// What a mover has covered in a step.
struct Journey {
  Travel travel;
  double distance = 0;  // of the model's origin
};

// A step has up to three legs: the commanded arc; for what ran into something, a slide along it;
// then a turn on the spot.
class PlanarMover final : public Engine {
 public:
  explicit PlanarMover(std::shared_ptr<base::ThreadTeam> team)
      : team_(std::move(team)), obstacles_(scene_), pairs_(scene_, *team_) {}

  base::Status SetLayout(std::shared_ptr<const world::Layout> layout) override;
  void Step(base::SimTime step, world::State& state,
            std::vector<world::Contact>& contacts) override;
  std::vector<world::Contact> Overlaps(const world::State& state, double tolerance) override;
  std::vector<world::Contact> OverlapsOf(const world::State& state, int body,
                                         double tolerance) override;

 private:
  struct Stopped {
    std::uint32_t mover;
    double remaining;  // s of this step
    Journey journey;
  };
  struct alignas(64) Chunk {  // of its own cache line, since threads write next to each other
    bool is_as_sliced, has_room;
    std::vector<std::uint32_t> in_contact;  // before the step
    std::vector<Stopped> stopped;
  };

  std::size_t count() const { return scene_.movers().size(); }
  const DriveKinematics& kinematics(std::size_t mover) const {
    return scene_.kind(scene_.movers()[mover]).kinematics;
  }
  template <typename Work>
  void ForEachChunk(const Work& work);

  void Slice(const world::State& state);
  void Begin(const world::State& state, double seconds);
  void BeginChunk(std::size_t index, const world::State& state, double seconds);
  void EndChunk(std::size_t index, double seconds, world::State& state);
  void FollowCommand(std::uint32_t m, const world::State& state, double seconds);
  void ListTouching();
  void SetLeg(std::uint32_t m, const Twist& twist, double seconds);
  void RunLeg(std::uint32_t m, Journey& journey);
  void RunStopped();
  void SlideAlong(double seconds);
  void TurnOnTheSpot();
  void Store(std::uint32_t m, const Journey& journey, double seconds, world::State& state) const;
  void CollectContacts(double gap, std::vector<world::Contact>& contacts);
  void CountContacts(std::vector<world::Contact>& contacts, world::State& state) const;
  bool FindNeighbours(std::uint32_t mover, const world::State& state);

  const std::shared_ptr<base::ThreadTeam> team_;
  PlanarScene scene_;
  NearObstacles obstacles_;
  NearPairs pairs_;
  std::vector<Chunk> chunks_;
  std::vector<BodyPair> touching_;         // at the step's start, ascending
  std::vector<Stopped> stopped_;           // in this step, ascending
  std::vector<std::uint32_t> neighbours_;  // for OverlapsOf()

  // One entry for each of the scene's movers.
  std::vector<PlanarPosition> positions_;
  std::vector<world::DriveCommand> motions_;  // of the drive: while it moves, and then at the end
  std::vector<Twist> twists_;                 // in this leg
  std::vector<double> times_;                 // in this leg
  std::vector<double> reaches_;               // how far any part may get in this step
  std::vector<Vector2> normals_;              // of those stopped: to what is in the way
};

base::Status PlanarMover::SetLayout(std::shared_ptr<const world::Layout> layout) {
  if (auto ok = scene_.SetLayout(std::move(layout)); !ok) return ok;
  chunks_.resize((count() + kChunk - 1) / kChunk);
  positions_.resize(count());
  motions_.resize(count());
  twists_.resize(count());
  times_.resize(count());
  reaches_.resize(count());
  normals_.resize(count());
  return {};
}

template <typename Work>
void PlanarMover::ForEachChunk(const Work& work) {
  team_->Share(chunks_.size(), kChunksAtOnce, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) work(i);
  });
}

void PlanarMover::Slice(const world::State& state) {
  scene_.Slice(state);
  obstacles_.Reset(chunks_.size());
  pairs_.Reset();
}

// For a step of 0 s everybody stays.
void PlanarMover::Begin(const world::State& state, double seconds) {
  if (!scene_.StandsAsSliced(state)) Slice(state);
  const auto all = [&](bool Chunk::*is) {
    return std::all_of(chunks_.begin(), chunks_.end(), [&](const Chunk& c) { return c.*is; });
  };
  const auto begin_chunk = [&](std::size_t i) { BeginChunk(i, state, seconds); };
  ForEachChunk(begin_chunk);
  if (!all(&Chunk::is_as_sliced)) {
    Slice(state);
    ForEachChunk(begin_chunk);
  }
  if (!all(&Chunk::has_room)) pairs_.FindCandidates(positions_, reaches_);
  pairs_.Find(positions_, reaches_);
  ListTouching();
}

void PlanarMover::BeginChunk(std::size_t index, const world::State& state, double seconds) {
  Chunk& chunk = chunks_[index];
  chunk.is_as_sliced = chunk.has_room = true;
  chunk.in_contact.clear();
  chunk.stopped.clear();
  obstacles_.Clear(index);
  const std::size_t end = std::min(count(), (index + 1) * kChunk);
  for (auto m = static_cast<std::uint32_t>(index * kChunk); m < end; ++m) {
    const world::BodyState& body = state.bodies[scene_.movers()[m].body];
    positions_[m] = PositionOf(body.world_from_model);
    FollowCommand(m, state, seconds);
    if (body.in_contact) chunk.in_contact.push_back(m);
    if (!scene_.IsAsSliced(m, body.world_from_model.position.z)) chunk.is_as_sliced = false;
    if (!pairs_.HasRoom(m, positions_[m], reaches_[m])) chunk.has_room = false;
    obstacles_.Find(index, m, positions_[m], reaches_[m]);
  }
  obstacles_.Stop(index, positions_, twists_, times_, normals_);
}

void PlanarMover::FollowCommand(std::uint32_t m, const world::State& state, double seconds) {
  const Mover& mover = scene_.movers()[m];
  const MoverKind& kind = scene_.kind(mover);
  motions_[m] = seconds > 0
                    ? kind.kinematics.Next(state.bodies[mover.body].drive, state.time, seconds)
                    : world::DriveCommand{};
  SetLeg(m, kind.kinematics.OriginTwist(motions_[m]), seconds);
  reaches_[m] = (SpeedOf(twists_[m]) + std::abs(twists_[m].angular) * kind.spin_radius) * seconds;
}

void PlanarMover::ListTouching() {
  touching_.clear();
  obstacles_.AddTouching(touching_);
  pairs_.AddTouching(touching_);
  std::sort(touching_.begin(), touching_.end());
}

void PlanarMover::SetLeg(std::uint32_t m, const Twist& twist, double seconds) {
  twists_[m] = twist;
  times_[m] = Moves(twist) ? seconds : 0;
}

void PlanarMover::RunLeg(std::uint32_t m, Journey& journey) {
  const double time = times_[m];
  if (time <= 0) return;
  const Twist& twist = twists_[m];
  positions_[m] = Advance(positions_[m], twist, time);
  journey.distance += SpeedOf(twist) * time;
  journey.travel.forward += twist.x * time;
  journey.travel.left += (twist.y + twist.angular * kinematics(m).reference_x()) * time;
  journey.travel.angle += twist.angular * time;
}

void PlanarMover::EndChunk(std::size_t index, double seconds, world::State& state) {
  const std::size_t end = std::min(count(), (index + 1) * kChunk);
  for (auto m = static_cast<std::uint32_t>(index * kChunk); m < end; ++m) {
    Journey journey;
    RunLeg(m, journey);
    if (times_[m] < seconds && Moves(twists_[m])) {
      chunks_[index].stopped.push_back({m, seconds - times_[m], journey});
    } else {
      Store(m, journey, seconds, state);
    }
    SetLeg(m, Twist{}, 0);
  }
}

void PlanarMover::RunStopped() {
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    obstacles_.Stop(i, positions_, twists_, times_, normals_);
  }
  pairs_.Stop(positions_, twists_, times_, normals_);
  for (Stopped& stopped : stopped_) RunLeg(stopped.mover, stopped.journey);
}

void PlanarMover::SlideAlong(double seconds) {
  bool any = false;
  for (const Stopped& stopped : stopped_) {
    const std::uint32_t m = stopped.mover;
    world::DriveCommand& motion = motions_[m];
    const Vector2 into = {
        positions_[m].cosine * normals_[m].x + positions_[m].sine * normals_[m].y,
        positions_[m].cosine * normals_[m].y - positions_[m].sine * normals_[m].x};
    const double blocked = std::max(0.0, into.x * motion.linear + into.y * motion.lateral);
    const bool slides = kinematics(m).can_move_sideways();
    motion.linear = slides ? motion.linear - blocked * into.x : 0;
    motion.lateral = slides ? motion.lateral - blocked * into.y : 0;
    if (!slides || std::hypot(motion.linear, motion.lateral) * seconds < kStopGap) {
      motion.linear = motion.lateral = 0;
      continue;
    }
    SetLeg(m, {motion.linear, motion.lateral, 0}, stopped.remaining);
    any = true;
  }
  if (!any) return;
  RunStopped();
  for (const Stopped& stopped : stopped_) {
    if (times_[stopped.mover] >= stopped.remaining) continue;
    motions_[stopped.mover].linear = motions_[stopped.mover].lateral = 0;
  }
}

void PlanarMover::TurnOnTheSpot() {
  for (const Stopped& stopped : stopped_) {
    const std::uint32_t m = stopped.mover;
    if (!kinematics(m).can_turn_on_the_spot()) motions_[m].angular = 0;
    SetLeg(m, kinematics(m).OriginTwist({0, 0, motions_[m].angular}), stopped.remaining);
  }
  RunStopped();
  for (const Stopped& stopped : stopped_) {
    world::DriveCommand& motion = motions_[stopped.mover];
    const double time = times_[stopped.mover];
    // A slide goes on in its direction in the world, which the base has turned against.
    const double angle = motion.angular * time;
    motion = {motion.linear * std::cos(angle) + motion.lateral * std::sin(angle),
              motion.lateral * std::cos(angle) - motion.linear * std::sin(angle), motion.angular};
    if (time < stopped.remaining) motion.angular = 0;
  }
}

void PlanarMover::Store(std::uint32_t m, const Journey& journey, double seconds,
                        world::State& state) const {
  const Mover& mover = scene_.movers()[m];
  world::BodyState& body = state.bodies[mover.body];
  const PlanarPosition& at = positions_[m];
  body.world_from_model.position.x = at.x;
  body.world_from_model.position.y = at.y;
  if (journey.travel.angle != 0) {
    body.world_from_model.orientation =
        Normalized(geometry::FromAxisAngle({0, 0, 1}, journey.travel.angle) *
                   body.world_from_model.orientation);
  }
  const Twist twist = kinematics(m).OriginTwist(motions_[m]);
  body.linear_velocity = {at.cosine * twist.x - at.sine * twist.y,
                          at.sine * twist.x + at.cosine * twist.y, 0};
  body.angular_velocity = {0, 0, twist.angular};
  body.drive.actual = motions_[m];
  body.distance += journey.distance;
  kinematics(m).TurnJoints(
      journey.travel, motions_[m], seconds,
      std::span(state.joint_positions).subspan(mover.first_joint, mover.joint_count),
      std::span(state.joint_velocities).subspan(mover.first_joint, mover.joint_count));
}

void PlanarMover::CollectContacts(double gap, std::vector<world::Contact>& contacts) {
  ContactCollector collector(contacts, gap);
  obstacles_.Collect(positions_, collector);
  pairs_.Collect(positions_, collector);
  collector.Finish(touching_);
}

void PlanarMover::CountContacts(std::vector<world::Contact>& contacts, world::State& state) const {
  for (world::Contact& contact : contacts) {
    world::BodyState& first = state.bodies[contact.first];
    world::BodyState& second = state.bodies[contact.second];
    const bool both_driven = IsDriven(scene_.layout().bodies[contact.second]);
    // Where the caller says that a base touched nothing, the contact begins.
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
    if (IsDriven(scene_.layout().bodies[contact.second])) {
      state.bodies[contact.second].in_contact = true;
    }
  }
}

void PlanarMover::Step(base::SimTime step, world::State& state,
                       std::vector<world::Contact>& contacts) {
  GSV_CHECK(step > base::SimTime(0));
  const double seconds = base::ToSeconds(step);
  Begin(state, seconds);
  pairs_.Stop(positions_, twists_, times_, normals_);
  ForEachChunk([&](std::size_t i) { EndChunk(i, seconds, state); });
  stopped_.clear();
  for (const Chunk& chunk : chunks_) {
    stopped_.insert(stopped_.end(), chunk.stopped.begin(), chunk.stopped.end());
  }
  if (!stopped_.empty()) {
    SlideAlong(seconds);
    TurnOnTheSpot();
    for (const Stopped& stopped : stopped_) Store(stopped.mover, stopped.journey, seconds, state);
  }
  CollectContacts(kTouchGap, contacts);
  CountContacts(contacts, state);
}

std::vector<world::Contact> PlanarMover::Overlaps(const world::State& state, double tolerance) {
  std::vector<world::Contact> contacts;
  Begin(state, 0);
  CollectContacts(-tolerance, contacts);
  return contacts;
}

// Lists the movers whose discs overlap that of one; false if not all stand as they were sliced.
bool PlanarMover::FindNeighbours(std::uint32_t mover, const world::State& state) {
  neighbours_.clear();
  const auto& movers = scene_.movers();
  const geometry::Vector3& at = state.bodies[movers[mover].body].world_from_model.position;
  bool is_as_sliced = true;
  for (std::uint32_t m = 0; m < movers.size(); ++m) {
    const geometry::Pose& pose = state.bodies[movers[m].body].world_from_model;
    is_as_sliced = is_as_sliced && scene_.IsAsSliced(m, pose.position.z);
    const Vector2 apart{pose.position.x - at.x, pose.position.y - at.y};
    const double reach =
        scene_.footprint(m).radius + scene_.footprint(mover).radius + 2 * kTouchGap;
    if (m == mover || Dot(apart, apart) > reach * reach) continue;
    positions_[m] = PositionOf(pose);
    neighbours_.push_back(m);
  }
  return is_as_sliced;
}

std::vector<world::Contact> PlanarMover::OverlapsOf(const world::State& state, int body,
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
  if (!scene_.StandsAsSliced(state) || !FindNeighbours(mover, state)) {
    Slice(state);
    FindNeighbours(mover, state);
  }
  for (std::size_t i = 0; i < chunks_.size(); ++i) obstacles_.Clear(i);
  positions_[mover] = PositionOf(state.bodies[body].world_from_model);
  obstacles_.Find(mover / kChunk, mover, positions_[mover], 0);
  pairs_.FindOf(mover, neighbours_, positions_);
  ListTouching();
  std::vector<world::Contact> contacts;
  CollectContacts(-tolerance, contacts);
  return contacts;
}

}  // namespace

std::unique_ptr<Engine> MakePlanarMover(std::shared_ptr<base::ThreadTeam> team) {
  if (team == nullptr) team = std::make_shared<base::ThreadTeam>(1);
  return std::make_unique<PlanarMover>(std::move(team));
}

}  // namespace gsv::dynamics
