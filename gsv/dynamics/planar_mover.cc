#include "gsv/dynamics/planar_mover.h"

#include <algorithm>
#include <cmath>

#include "gsv/base/check.h"
#include "gsv/dynamics/obstacles.h"
#include "gsv/dynamics/planar_scene.h"
#include "gsv/dynamics/planar_solver.h"

namespace gsv::dynamics {
namespace {

using geometry::Quaternion;

// Where a body stands and how it heads, without a detour through angles.
PlanarPosition PositionOf(const geometry::Pose& pose) {
  const Quaternion& q = pose.orientation;
  const double cosine = 1 - 2 * (q.y * q.y + q.z * q.z), sine = 2 * (q.w * q.z + q.x * q.y);
  const double length = std::sqrt(cosine * cosine + sine * sine);
  if (!(length > 0)) return {pose.position.x, pose.position.y, 1, 0};
  return {pose.position.x, pose.position.y, cosine / length, sine / length};
}

double SpeedOf(const Twist& twist) { return std::sqrt(twist.x * twist.x + twist.y * twist.y); }

// A step has up to three legs: the commanded arc; for what ran into something, a slide along it;
// then a turn on the spot.
class PlanarMover final : public Engine {
 public:
  PlanarMover() : solver_(scene_) {}

  base::Status SetLayout(std::shared_ptr<const world::Layout> layout) override {
    return scene_.SetLayout(std::move(layout));
  }
  std::vector<world::Contact> Step(base::SimTime step, world::State& state) override;
  std::vector<world::Contact> Overlaps(const world::State& state, double tolerance) override;

 private:
  std::size_t count() const { return scene_.movers().size(); }
  void Load(const world::State& state);
  void FollowCommands(const world::State& state, double seconds);
  void RunArcs(double seconds);
  void SlideAlong(double seconds);
  void TurnOnTheSpot();
  void RunLeg();
  void TurnJoints(double seconds, world::State& state) const;
  void Store(world::State& state) const;
  void CountContacts(std::vector<world::Contact>& contacts, world::State& state) const;

  PlanarScene scene_;
  PlanarSolver solver_;

  // One entry for each of the scene's movers.
  std::vector<PlanarPosition> positions_;
  std::vector<world::DriveCommand> motions_;  // of the drive: while it moves, and then at the end
  std::vector<Travel> travels_;               // so far in this step
  std::vector<double> distances_;             // of the model's origin, so far in this step
  std::vector<double> remaining_;             // s of this step that a stopped base has left
  std::vector<Twist> twists_;                 // in this leg
  std::vector<double> times_;                 // in this leg
  std::vector<double> reaches_;
  std::vector<Vector2> normals_;
  std::vector<std::uint32_t> stopped_;  // movers that ran into something
};

void PlanarMover::Load(const world::State& state) {
  scene_.Prepare(state);
  positions_.resize(count());
  for (std::size_t m = 0; m < count(); ++m) {
    positions_[m] = PositionOf(state.bodies[scene_.movers()[m].body].world_from_model);
  }
}

void PlanarMover::FollowCommands(const world::State& state, double seconds) {
  motions_.resize(count());
  twists_.resize(count());
  reaches_.resize(count());
  for (std::size_t m = 0; m < count(); ++m) {
    const Mover& mover = scene_.movers()[m];
    motions_[m] = mover.kinematics->Next(state.bodies[mover.body].drive, state.time, seconds);
    twists_[m] = mover.kinematics->OriginTwist(motions_[m]);
    reaches_[m] =
        (SpeedOf(twists_[m]) + std::abs(twists_[m].angular) * mover.spin_radius) * seconds;
  }
}

void PlanarMover::RunLeg() {
  solver_.Run(positions_, twists_, times_, normals_);
  for (std::size_t m = 0; m < count(); ++m) {
    if (times_[m] <= 0) continue;
    positions_[m] = Advance(positions_[m], twists_[m], times_[m]);
    distances_[m] += SpeedOf(twists_[m]) * times_[m];
    const double reference_x = scene_.movers()[m].kinematics->reference_x();
    travels_[m].forward += twists_[m].x * times_[m];
    travels_[m].left += (twists_[m].y + twists_[m].angular * reference_x) * times_[m];
    travels_[m].angle += twists_[m].angular * times_[m];
  }
}

void PlanarMover::RunArcs(double seconds) {
  travels_.assign(count(), Travel{});
  distances_.assign(count(), 0.0);
  remaining_.assign(count(), 0.0);
  times_.assign(count(), seconds);
  normals_.resize(count());
  stopped_.clear();
  RunLeg();
  for (std::size_t m = 0; m < count(); ++m) {
    if (times_[m] >= seconds || twists_[m] == Twist{}) continue;
    remaining_[m] = seconds - times_[m];
    stopped_.push_back(static_cast<std::uint32_t>(m));
  }
}

void PlanarMover::SlideAlong(double seconds) {
  twists_.assign(count(), Twist{});
  times_.assign(count(), 0.0);
  bool any = false;
  for (const std::uint32_t m : stopped_) {
    world::DriveCommand& motion = motions_[m];
    const Vector2 into = {
        positions_[m].cosine * normals_[m].x + positions_[m].sine * normals_[m].y,
        positions_[m].cosine * normals_[m].y - positions_[m].sine * normals_[m].x};
    const double blocked = std::max(0.0, into.x * motion.linear + into.y * motion.lateral);
    const bool slides = scene_.movers()[m].kinematics->can_move_sideways();
    motion.linear = slides ? motion.linear - blocked * into.x : 0;
    motion.lateral = slides ? motion.lateral - blocked * into.y : 0;
    if (!slides || std::hypot(motion.linear, motion.lateral) * seconds < kStopGap) {
      motion.linear = motion.lateral = 0;
      continue;
    }
    twists_[m] = {motion.linear, motion.lateral, 0};
    times_[m] = remaining_[m];
    any = true;
  }
  if (!any) return;
  RunLeg();
  for (const std::uint32_t m : stopped_) {
    if (times_[m] < remaining_[m]) motions_[m].linear = motions_[m].lateral = 0;
  }
}

void PlanarMover::TurnOnTheSpot() {
  twists_.assign(count(), Twist{});
  times_.assign(count(), 0.0);
  for (const std::uint32_t m : stopped_) {
    const DriveKinematics& kinematics = *scene_.movers()[m].kinematics;
    if (!kinematics.can_turn_on_the_spot()) motions_[m].angular = 0;
    twists_[m] = kinematics.OriginTwist({0, 0, motions_[m].angular});
    times_[m] = remaining_[m];
  }
  RunLeg();
  for (const std::uint32_t m : stopped_) {
    world::DriveCommand& motion = motions_[m];
    // A slide goes on in its direction in the world, which the base has turned against.
    const double angle = motion.angular * times_[m];
    motion = {motion.linear * std::cos(angle) + motion.lateral * std::sin(angle),
              motion.lateral * std::cos(angle) - motion.linear * std::sin(angle), motion.angular};
    if (times_[m] < remaining_[m]) motion.angular = 0;
  }
}

void PlanarMover::TurnJoints(double seconds, world::State& state) const {
  for (std::size_t m = 0; m < count(); ++m) {
    const Mover& mover = scene_.movers()[m];
    const world::Body& body = scene_.layout().bodies[mover.body];
    const std::size_t joints = body.model->joints.size();
    mover.kinematics->TurnJoints(
        travels_[m], motions_[m], seconds,
        std::span(state.joint_positions).subspan(body.first_joint, joints),
        std::span(state.joint_velocities).subspan(body.first_joint, joints));
  }
}

void PlanarMover::Store(world::State& state) const {
  for (std::size_t m = 0; m < count(); ++m) {
    world::BodyState& body = state.bodies[scene_.movers()[m].body];
    const PlanarPosition& at = positions_[m];
    body.world_from_model.position.x = at.x;
    body.world_from_model.position.y = at.y;
    if (travels_[m].angle != 0) {
      body.world_from_model.orientation =
          Normalized(geometry::FromAxisAngle({0, 0, 1}, travels_[m].angle) *
                     body.world_from_model.orientation);
    }
    const Twist twist = scene_.movers()[m].kinematics->OriginTwist(motions_[m]);
    body.linear_velocity = {at.cosine * twist.x - at.sine * twist.y,
                            at.sine * twist.x + at.cosine * twist.y, 0};
    body.angular_velocity = {0, 0, twist.angular};
    body.drive.actual = motions_[m];
    body.distance += distances_[m];
  }
}

void PlanarMover::CountContacts(std::vector<world::Contact>& contacts, world::State& state) const {
  std::vector<int> touching;
  const auto count_for = [&](int body, bool began) {
    if (!IsDriven(scene_.layout().bodies[body])) return;
    if (began) ++state.bodies[body].collisions;
    touching.push_back(body);
  };
  for (world::Contact& contact : contacts) {
    // Where the caller says that a base touched nothing, the contact begins.
    contact.began = contact.began || !state.bodies[contact.first].in_contact ||
                    (IsDriven(scene_.layout().bodies[contact.second]) &&
                     !state.bodies[contact.second].in_contact);
    count_for(contact.first, contact.began);
    count_for(contact.second, contact.began);
  }
  for (const Mover& mover : scene_.movers()) state.bodies[mover.body].in_contact = false;
  for (const int body : touching) state.bodies[body].in_contact = true;
}

std::vector<world::Contact> PlanarMover::Step(base::SimTime step, world::State& state) {
  GSV_CHECK(step > base::SimTime(0));
  const double seconds = base::ToSeconds(step);
  Load(state);
  FollowCommands(state, seconds);
  solver_.Begin(positions_, reaches_);
  RunArcs(seconds);
  if (!stopped_.empty()) {
    SlideAlong(seconds);
    TurnOnTheSpot();
  }
  TurnJoints(seconds, state);
  Store(state);
  std::vector<world::Contact> contacts = solver_.FindContacts(positions_, kTouchGap);
  CountContacts(contacts, state);
  return contacts;
}

std::vector<world::Contact> PlanarMover::Overlaps(const world::State& state, double tolerance) {
  Load(state);
  reaches_.assign(count(), 0.0);
  solver_.Begin(positions_, reaches_);
  return solver_.FindContacts(positions_, -tolerance);
}

}  // namespace

std::unique_ptr<Engine> MakePlanarMover() { return std::make_unique<PlanarMover>(); }

}  // namespace gsv::dynamics
