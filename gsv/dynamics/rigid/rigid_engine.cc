#include "gsv/dynamics/rigid/rigid_engine.h"

#include <algorithm>
#include <optional>
#include <tuple>

#include "gsv/dynamics/rigid/resting_state.h"
#include "gsv/dynamics/rigid/rigid_world.h"

namespace gsv::dynamics {
namespace {

using geometry::Vector3;

// Between wheels and ground, for lack of anything better: what SDFormat takes for all surfaces.
constexpr double kTraction = 1;

// Of the point of a planar body, in the world, when its drive moves so.
Vector3 VelocityAt(const PlanarBody& planar, const world::DriveCommand& motion,
                   const geometry::Pose& world_from_model, const Vector3& point) {
  const geometry::Twist twist = planar.kinematics->OriginTwist(motion);
  const Vector3 origin = world_from_model.orientation * Vector3{twist.x, twist.y, 0};
  return origin + Cross({0, 0, twist.angular}, point - world_from_model.position);
}

}  // namespace

struct RigidEngine::Parts {
  std::optional<BulletKit> kit;  // its pools take 8 MiB: only where there is something rigid
  RigidScene scene;
  RigidContacts contacts;
  std::vector<Push> pushes;
  RestingState resting;
};

RigidEngine::RigidEngine() : parts_(std::make_unique<Parts>()) {}
RigidEngine::~RigidEngine() = default;

base::Status RigidEngine::SetLayout(std::shared_ptr<const world::Layout> layout) {
  parts_->resting.Forget();
  if (auto ok = parts_->scene.SetLayout(std::move(layout)); !ok) return ok;
  if (has_bodies() && !parts_->kit) parts_->kit.emplace();
  return {};
}

bool RigidEngine::has_bodies() const { return parts_->scene.has_bodies(); }

void RigidEngine::FindPushes(base::SimTime step, const world::State& before,
                             const std::vector<world::Contact>& contacts,
                             const world::State& state) {
  const RigidScene& scene = parts_->scene;
  parts_->pushes.clear();
  for (const world::Contact& contact : contacts) {
    if (!scene.layout().bodies[contact.second].is_rigid()) continue;
    const PlanarBody& planar = scene.PlanarOf(contact.first);
    const world::BodyState& robot = before.bodies[contact.first];
    const world::DriveCommand wanted =
        planar.kinematics->Next(robot.drive, before.time, base::ToSeconds(step));
    Push push;
    push.robot = contact.first;
    push.object = contact.second;
    push.point = contact.point;
    push.normal = contact.normal;
    push.speed =
        Dot(VelocityAt(planar, wanted, robot.world_from_model, contact.point), contact.normal);
    if (!(push.speed > 0)) continue;
    const Vector3 travel =
        state.bodies[contact.first].world_from_model.position - robot.world_from_model.position;
    push.start = std::max(0.0, Dot(travel, contact.normal) / push.speed);
    push.low = robot.world_from_model.position.z + planar.low;
    push.force = kTraction * planar.mass * Norm(scene.layout().description->gravity);
    parts_->pushes.push_back(push);
  }
}

bool RigidEngine::Move(base::SimTime step, const world::State& before,
                       const std::vector<world::Contact>& contacts, world::State& state) {
  const double seconds = base::ToSeconds(step);
  FindPushes(step, before, contacts, state);
  RestingState& resting = parts_->resting;
  if (resting.Holds(parts_->scene, before, state, seconds)) return false;
  parts_->contacts.Clear();
  RigidWorld world(*parts_->kit, parts_->scene, before, state, seconds);
  world.Run(parts_->pushes, parts_->contacts);
  world.Store(state);
  resting.Remember(parts_->scene, before, state, seconds, world.MakeAreas());
  return !parts_->pushes.empty();
}

void RigidEngine::GoOn(base::SimTime step, const world::State& before, world::State& state) const {
  const std::vector<Push>& pushes = parts_->pushes;
  for (std::size_t i = 0; i < pushes.size();) {
    // Of several that it pushes the slowest tells.
    const int robot = pushes[i].robot;
    double part = 1;
    for (; i < pushes.size() && pushes[i].robot == robot; ++i) {
      part = std::min(part, std::clamp(pushes[i].achieved / pushes[i].speed, 0.0, 1.0));
    }
    const world::DriveCommand wanted = parts_->scene.PlanarOf(robot).kinematics->Next(
        before.bodies[robot].drive, before.time, base::ToSeconds(step));
    world::DriveCommand& actual = state.bodies[robot].drive.actual;
    actual.linear = part * wanted.linear;
    actual.lateral = part * wanted.lateral;
  }
}

std::vector<world::Contact> RigidEngine::OverlapsOf(const world::State& state, int body,
                                                    double tolerance) {
  if (!has_bodies()) return {};
  return RigidWorld(*parts_->kit, parts_->scene, state, state, 0).OverlapsOf(body, tolerance);
}

void RigidEngine::AddContacts(const world::State& before, world::State& state,
                              std::vector<world::Contact>& contacts) {
  const world::Layout& layout = parts_->scene.layout();
  parts_->contacts.AddTo(contacts);
  for (const RigidBody& body : parts_->scene.bodies()) state.bodies[body.body].in_contact = false;
  for (world::Contact& contact : contacts) {
    for (const int index : {contact.first, contact.second}) {
      if (!layout.bodies[index].is_rigid()) continue;
      world::BodyState& body = state.bodies[index];
      contact.began = contact.began || !before.bodies[index].in_contact;
      if (contact.began) ++body.collisions;
      body.in_contact = true;
    }
  }
  std::sort(contacts.begin(), contacts.end(), [](const auto& a, const auto& b) {
    return std::tie(a.first, a.second) < std::tie(b.first, b.second);
  });
}

}  // namespace gsv::dynamics
