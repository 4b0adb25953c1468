#include "gsv/sensing/devices/joint_wrench.h"

#include <limits>
#include <vector>

#include "gsv/geometry/distance.h"
#include "gsv/sensing/devices/link_motion.h"

namespace gsv::sensing {
namespace {

using geometry::Cross;
using geometry::Pose;
using geometry::Vector3;

// Adds forces to a wrench about a point.
struct WrenchSum {
  Vector3 origin, force, torque;

  void Add(const Vector3& point, const Vector3& push) {
    force += push;
    torque += Cross(point - origin, push);
  }
};

// Returns for each link whether it is in the subtree below the joint.
std::vector<bool> LinksBelow(const model::Model& model, int joint) {
  std::vector<bool> is_below(model.links.size());
  is_below[static_cast<std::size_t>(model.joints[static_cast<std::size_t>(joint)].child)] = true;
  // The loop ends, because each repetition has found at least one more link.
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (const model::Joint& each : model.joints) {
      const auto child = static_cast<std::size_t>(each.child);
      if (each.parent < 0 || !is_below[static_cast<std::size_t>(each.parent)] || is_below[child]) {
        continue;
      }
      is_below[child] = has_changed = true;
    }
  }
  return is_below;
}

// Adds the force and torque that the motion of a link requires, minus the force of gravity.
void AddInertia(const model::Link& link, const LinkMotion& motion, const Vector3& gravity,
                WrenchSum& sum) {
  const model::Inertial& i = link.inertial;
  const Pose world_from_com = motion.world_from_link * i.link_from_com;
  const Vector3 acceleration = motion.AccelerationOf(world_from_com.position);
  sum.Add(world_from_com.position,
          i.mass * (acceleration - (link.has_gravity ? gravity : Vector3{})));
  const geometry::Quaternion com_from_world = Inverse(world_from_com.orientation);
  const Vector3 w = com_from_world * motion.angular_velocity;
  const Vector3 a = com_from_world * motion.angular_acceleration;
  const auto times = [&](const Vector3& v) {
    return Vector3{i.ixx * v.x + i.ixy * v.y + i.ixz * v.z, i.ixy * v.x + i.iyy * v.y + i.iyz * v.z,
                   i.ixz * v.x + i.iyz * v.y + i.izz * v.z};
  };
  sum.torque += world_from_com.orientation * (times(a) + Cross(w, times(w)));
}

// Returns the link with the collision that is nearest to a point of the world, or -1.
int LinkAt(const model::Model& model, const std::vector<LinkMotion>& motions,
           const Vector3& point) {
  double nearest = std::numeric_limits<double>::infinity();
  int found = -1;
  for (std::size_t link = 0; link < model.links.size(); ++link) {
    for (const model::Collision& collision : model.links[link].collisions) {
      const Pose world_from_collision =
          motions[link].world_from_link * collision.link_from_collision;
      const double distance =
          geometry::DistanceTo(collision.shape, Inverse(world_from_collision) * point);
      if (distance >= nearest) continue;
      nearest = distance;
      found = static_cast<int>(link);
    }
  }
  return found;
}

}  // namespace

int JointAbove(const model::Model& model, int link) {
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    if (model.joints[j].child == link) return static_cast<int>(j);
  }
  return -1;
}

JointWrench WrenchOf(const world::Snapshot& snapshot, int body, int joint) {
  const model::Model& model = *snapshot.layout->bodies[static_cast<std::size_t>(body)].model;
  const std::vector<LinkMotion> motions = MotionsOfLinks(snapshot, body);
  const std::vector<bool> is_below = LinksBelow(model, joint);
  const model::Joint& above = model.joints[static_cast<std::size_t>(joint)];
  const auto child = static_cast<std::size_t>(above.child);
  const Pose world_from_joint = motions[child].world_from_link *
                                Inverse(model.links[child].model_from_link) *
                                above.model_from_joint;
  WrenchSum sum{world_from_joint.position, {}, {}};
  for (std::size_t link = 0; link < model.links.size(); ++link) {
    if (!is_below[link]) continue;
    AddInertia(model.links[link], motions[link], snapshot.layout->description->gravity, sum);
  }
  for (const world::Contact& contact : snapshot.contacts) {
    if (contact.first != body && contact.second != body) continue;
    for (const world::ContactPoint& at : world::PointsOf(contact)) {
      const int link = LinkAt(model, motions, at.point);
      if (link < 0 || !is_below[static_cast<std::size_t>(link)]) continue;
      const Vector3 on_second = world::MeanForce(snapshot, at.impulse);
      sum.Add(at.point, contact.second == body ? -on_second : on_second);
    }
  }
  return {sum.origin, sum.force, sum.torque};
}

}  // namespace gsv::sensing
