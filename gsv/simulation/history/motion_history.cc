#include "gsv/simulation/history/motion_history.h"

#include <cmath>
#include <utility>

namespace gsv::simulation {
namespace {

constexpr SimTime kSamplePeriod = std::chrono::milliseconds(100);
constexpr SimTime kStillAfter = std::chrono::seconds(1);
constexpr double kMoved = 0.01;   // m
constexpr double kTurned = 0.02;  // rad

bool HasLeft(const geometry::Pose& anchor, const geometry::Pose& pose) {
  static const double least_cosine = std::cos(kTurned / 2);
  const geometry::Vector3 way = pose.position - anchor.position;
  if (Dot(way, way) > kMoved * kMoved) return true;
  const geometry::Quaternion& a = anchor.orientation;
  const geometry::Quaternion& b = pose.orientation;
  return std::abs(a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z) < least_cosine;
}

// Returns the command that the drive applies; zero after its timeout.
world::DriveCommand CommandInEffect(const world::Snapshot& snapshot, std::size_t body) {
  const world::DriveState& drive = snapshot.state.bodies[body].drive;
  if (drive.command == world::DriveCommand{}) return {};
  const auto& described = snapshot.layout->bodies[body].model->drive;
  const SimTime timeout = described ? described->command_timeout : SimTime(0);
  const bool is_stale = timeout > SimTime(0) && snapshot.state.time - drive.command_time >= timeout;
  return is_stale ? world::DriveCommand{} : drive.command;
}

}  // namespace

bool IsStuck(const Motion& motion, SimTime stuck_after) {
  return !motion.is_moving && motion.commanded_for >= stuck_after &&
         motion.command != world::DriveCommand{};
}

MotionHistory::Track MotionHistory::Begin(const world::Snapshot& snapshot, std::size_t body) {
  Track track;
  track.anchor = snapshot.state.bodies[body].world_from_model;
  track.anchored_at = track.moved_at = track.moves_since = track.contact_since =
      snapshot.state.time;
  return track;
}

void MotionHistory::FollowLayout(const world::Snapshot& snapshot) {
  const auto before = std::exchange(layout_, snapshot.layout);
  std::vector<Track> tracks;
  tracks.reserve(layout_->bodies.size());
  for (std::size_t i = 0; i < layout_->bodies.size(); ++i) {
    const int known = before == nullptr ? -1 : before->Find(layout_->bodies[i].name);
    tracks.push_back(known < 0 ? Begin(snapshot, i) : tracks_[static_cast<std::size_t>(known)]);
  }
  tracks_ = std::move(tracks);
}

SimTime MotionHistory::NextSampling(SimTime now) {
  return (now / kSamplePeriod + 1) * kSamplePeriod;
}

void MotionHistory::Follow(const world::Snapshot& snapshot) {
  const SimTime now = snapshot.state.time;
  if (now < sampled_) layout_ = nullptr;
  const bool is_due = now / kSamplePeriod != sampled_ / kSamplePeriod;
  if (snapshot.layout != layout_) {
    FollowLayout(snapshot);
  } else if (!is_due) {
    return;
  }
  const SimTime passed = now > sampled_ ? now - sampled_ : SimTime(0);
  sampled_ = now;
  for (std::size_t i = 0; i < tracks_.size(); ++i) {
    if (!layout_->bodies[i].is_robot()) continue;
    const world::BodyState& body = snapshot.state.bodies[i];
    Track& track = tracks_[i];
    if (HasLeft(track.anchor, body.world_from_model)) {
      if (!track.has_moved || now - track.moved_at >= kStillAfter) track.moves_since = now;
      track.moved_at = now;
      track.has_moved = true;
      track.commanded_for = SimTime(0);
      track.anchored_at = now - kStillAfter;
    } else if (CommandInEffect(snapshot, i) != world::DriveCommand{}) {
      track.commanded_for += passed;
    }
    if (now - track.anchored_at >= kStillAfter) {
      track.anchor = body.world_from_model;
      track.anchored_at = now;
    }
    if (body.in_contact && !track.is_in_contact) track.contact_since = now;
    track.is_in_contact = body.in_contact;
  }
}

Motion MotionHistory::Of(const world::Snapshot& snapshot, int body) const {
  const auto index = static_cast<std::size_t>(body);
  const world::BodyState& state = snapshot.state.bodies[index];
  Motion motion;
  motion.command = CommandInEffect(snapshot, index);
  motion.linear = Norm(state.linear_velocity);
  motion.angular = state.angular_velocity.z;
  // The index of the body in the last layout. A body that was added later has no history yet.
  int known = body;
  if (snapshot.layout != layout_) {
    known = layout_ == nullptr ? -1 : layout_->Find(snapshot.layout->bodies[index].name);
  }
  const Track track = known < 0 ? Begin(snapshot, index) : tracks_[static_cast<std::size_t>(known)];
  motion.has_moved = track.has_moved;
  motion.is_moving = track.has_moved && snapshot.state.time - track.moved_at < kStillAfter;
  motion.since = motion.is_moving ? track.moves_since : track.moved_at;
  motion.commanded_for = motion.is_moving ? SimTime(0) : track.commanded_for;
  motion.contact_since = track.contact_since;
  return motion;
}

std::vector<int> ContactPartners(const world::Snapshot& snapshot) {
  std::vector<int> partners(snapshot.layout->bodies.size(), -1);
  const auto note = [&](int body, int other) {
    int& partner = partners[static_cast<std::size_t>(body)];
    if (partner < 0) partner = other;
  };
  for (const world::Contact& contact : snapshot.contacts) {
    if (contact.supports) continue;
    note(contact.first, contact.second);
    note(contact.second, contact.first);
  }
  return partners;
}

}  // namespace gsv::simulation
