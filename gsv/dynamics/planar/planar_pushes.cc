#include "gsv/dynamics/planar/planar_pushes.h"

#include <algorithm>

#include "gsv/dynamics/motion/articulation.h"
#include "gsv/dynamics/shapes/footprint.h"

namespace gsv::dynamics {
namespace {

using geometry::Vector3;

// The friction coefficient between wheels and ground: SDFormat's default for all surfaces.
constexpr double kTraction = 1;

// The velocity, in the world frame, of a point of a planar body whose drive has this motion.
Vector3 VelocityAt(const DriveKinematics& kinematics, const world::DriveCommand& motion,
                   const geometry::Pose& world_from_model, const Vector3& point) {
  const geometry::Twist twist = kinematics.OriginTwist(motion);
  const Vector3 origin = world_from_model.orientation * Vector3{twist.x, twist.y, 0};
  return origin + Cross({0, 0, twist.angular}, point - world_from_model.position);
}

}  // namespace

base::Status PlanarPushes::SetLayout(std::shared_ptr<const world::Layout> layout) {
  layout_ = std::move(layout);
  pushers_.clear();
  const std::vector<world::Body>& bodies = layout_->bodies;
  const auto is_rigid = [](const world::Body& body) { return body.is_rigid(); };
  if (std::none_of(bodies.begin(), bodies.end(), is_rigid)) return {};
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (!bodies[i].is_planar()) continue;
    const model::Model& model = *bodies[i].model;
    const Footprint footprint = MakeFootprint(model, {});
    auto kinematics = model.drive ? DriveKinematics::Create(model)
                                  : base::Result<DriveKinematics>(DriveKinematics::Free());
    if (!kinematics) return base::Fail(kinematics.error());
    pushers_.push_back({static_cast<int>(i), footprint.heights.low + ClimbHeight(model, footprint),
                        MakeArticulation(model).mass, *std::move(kinematics)});
  }
  return {};
}

const PlanarPushes::Pusher& PlanarPushes::PusherOf(int body) const {
  return *std::lower_bound(pushers_.begin(), pushers_.end(), body,
                           [](const Pusher& pusher, int b) { return pusher.body < b; });
}

std::span<Push> PlanarPushes::Find(base::SimTime step, const world::State& before,
                                   const world::State& state,
                                   const std::vector<world::Contact>& contacts) {
  pushes_.clear();
  for (const world::Contact& contact : contacts) {
    if (!layout_->bodies[contact.second].is_rigid()) continue;
    const Pusher& pusher = PusherOf(contact.first);
    const world::BodyState& robot = before.bodies[contact.first];
    const world::DriveCommand wanted =
        pusher.kinematics.Next(robot.drive, before.time, base::ToSeconds(step));
    Push push;
    push.robot = contact.first;
    push.object = contact.second;
    push.point = contact.point;
    push.normal = contact.normal;
    push.speed = Dot(VelocityAt(pusher.kinematics, wanted, robot.world_from_model, contact.point),
                     contact.normal);
    if (!(push.speed > 0)) continue;
    const Vector3 travel =
        state.bodies[contact.first].world_from_model.position - robot.world_from_model.position;
    push.start = std::max(0.0, Dot(travel, contact.normal) / push.speed);
    push.low = robot.world_from_model.position.z + pusher.low;
    push.force = kTraction * pusher.mass * Norm(layout_->description->gravity);
    pushes_.push_back(push);
  }
  return pushes_;
}

void PlanarPushes::LimitSpeeds(base::SimTime step, const world::State& before,
                               world::State& state) const {
  for (std::size_t i = 0; i < pushes_.size();) {
    const int robot = pushes_[i].robot;
    double part = 1;
    for (; i < pushes_.size() && pushes_[i].robot == robot; ++i) {
      part = std::min(part, std::clamp(pushes_[i].achieved / pushes_[i].speed, 0.0, 1.0));
    }
    const world::DriveCommand wanted = PusherOf(robot).kinematics.Next(
        before.bodies[robot].drive, before.time, base::ToSeconds(step));
    world::DriveCommand& actual = state.bodies[robot].drive.actual;
    actual.linear = part * wanted.linear;
    actual.lateral = part * wanted.lateral;
  }
}

void PlanarPushes::SetImpulses(std::vector<world::Contact>& contacts) const {
  for (const Push& push : pushes_) {
    const auto contact = std::find_if(
        contacts.begin(), contacts.end(),
        [&](const world::Contact& c) { return c.first == push.robot && c.second == push.object; });
    if (contact != contacts.end()) contact->impulse = push.impulse;
  }
}

}  // namespace gsv::dynamics
