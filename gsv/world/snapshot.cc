#include "gsv/world/snapshot.h"

#include <algorithm>
#include <cmath>

#include "gsv/base/check.h"
#include "gsv/world/accelerations.h"

namespace gsv::world {
namespace {

using geometry::Pose;

bool Moves(model::JointKind kind) { return kind != model::JointKind::kFixed; }

// Returns the parent joint of each link, or -1.
std::vector<int> ParentJoints(const model::Model& model) {
  std::vector<int> parent_joint(model.links.size(), -1);
  for (std::size_t j = 0; j < model.joints.size(); ++j) {
    parent_joint[model.joints[j].child] = static_cast<int>(j);
  }
  return parent_joint;
}

// Returns how a joint at `position` displaces the links below it, in the model's frame.
Pose Displacement(const model::Joint& joint, double position) {
  if (!Moves(joint.kind) || position == 0.0) return {};
  Pose motion;
  if (joint.kind == model::JointKind::kPrismatic) {
    motion.position = joint.axis * position;
  } else {
    motion.orientation = geometry::FromAxisAngle(joint.axis, position);
    if (joint.kind == model::JointKind::kScrew) {
      motion.position = joint.axis * (joint.thread_pitch * position);
    }
  }
  return joint.model_from_joint * motion * Inverse(joint.model_from_joint);
}

// Returns the parent joint of one link, or -1.
int ParentJoint(const model::Model& model, int link) {
  for (std::size_t j = model.joints.size(); j-- > 0;) {
    if (model.joints[j].child == link) return static_cast<int>(j);
  }
  return -1;
}

// Returns how all joints above a link displace it, in the model's frame. `parent_joint` returns the
// parent joint of a link, or -1.
template <class Parent>
Pose LinkDisplacement(const model::Model& model, std::span<const double> joint_positions, int link,
                      const Parent& parent_joint) {
  Pose displacement;
  // The loop starts at the link and ends at the root. It ends, because a forest has at most
  // links.size() levels.
  std::size_t level = 0;
  for (int j = parent_joint(link); j >= 0; j = link >= 0 ? parent_joint(link) : -1) {
    GSV_CHECK(level++ < model.links.size());
    displacement = Displacement(model.joints[j], joint_positions[j]) * displacement;
    link = model.joints[j].parent;
  }
  return displacement;
}

std::span<const double> JointPositions(const Snapshot& snapshot, int body) {
  const Body& b = snapshot.layout->bodies[body];
  return std::span(snapshot.state.joint_positions).subspan(b.first_joint, b.model->joints.size());
}

}  // namespace

std::vector<ContactPoint> PointsOf(const Contact& contact) {
  if (!contact.points.empty()) return contact.points;
  const double impulse = std::isfinite(contact.impulse) ? contact.impulse : 0;
  return {{contact.point, contact.normal, contact.depth, impulse * contact.normal}};
}

geometry::Vector3 MeanForce(const Snapshot& snapshot, const geometry::Vector3& impulse) {
  if (snapshot.step_length.count() <= 0) return {};
  return impulse * (1 / base::ToSeconds(snapshot.step_length));
}

void KeepBodyVelocities(std::span<const BodyState> bodies, std::span<Acceleration> kept) {
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    kept[i] = {bodies[i].linear_velocity, bodies[i].angular_velocity};
  }
}

void FinishBodyAccelerations(std::span<const BodyState> bodies, double step_seconds,
                             std::span<Acceleration> accelerations) {
  const double per_second = 1 / step_seconds;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    Acceleration& mean = accelerations[i];
    mean.linear = per_second * (bodies[i].linear_velocity - mean.linear);
    mean.angular = per_second * (bodies[i].angular_velocity - mean.angular);
  }
}

void FinishJointAccelerations(std::span<const double> velocities, double step_seconds,
                              std::span<double> accelerations) {
  const double per_second = 1 / step_seconds;
  for (std::size_t i = 0; i < velocities.size(); ++i) {
    accelerations[i] = per_second * (velocities[i] - accelerations[i]);
  }
}

void KeepVelocities(const State& state, std::vector<Acceleration>& accelerations,
                    std::vector<double>& joint_accelerations) {
  joint_accelerations = state.joint_velocities;
  accelerations.resize(state.bodies.size());
  KeepBodyVelocities(state.bodies, accelerations);
}

void FinishContacts(const State& state, const std::vector<Acceleration>& kept,
                    std::vector<Contact>& contacts) {
  const auto velocity = [&](int body, const geometry::Vector3& point) {
    const Acceleration& of_origin = kept[static_cast<std::size_t>(body)];
    const geometry::Vector3& origin =
        state.bodies[static_cast<std::size_t>(body)].world_from_model.position;
    return of_origin.linear + Cross(of_origin.angular, point - origin);
  };
  for (Contact& contact : contacts) {
    contact.closing_speed = 0;
    if (!contact.began) continue;
    const geometry::Vector3 closing =
        velocity(contact.first, contact.point) - velocity(contact.second, contact.point);
    contact.closing_speed = std::max(0.0, Dot(closing, contact.normal));
  }
}

void FinishAccelerations(const State& state, double step_seconds,
                         std::vector<Acceleration>& accelerations,
                         std::vector<double>& joint_accelerations) {
  FinishJointAccelerations(state.joint_velocities, step_seconds, joint_accelerations);
  FinishBodyAccelerations(state.bodies, step_seconds, accelerations);
}

std::vector<Pose> LinkPoses(const model::Model& model, std::span<const double> joint_positions) {
  GSV_CHECK(joint_positions.size() == model.joints.size());
  const std::vector<int> parent_joint = ParentJoints(model);
  std::vector<Pose> model_from_link;
  model_from_link.reserve(model.links.size());
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    model_from_link.push_back(LinkDisplacement(model, joint_positions, static_cast<int>(i),
                                               [&](int link) { return parent_joint[link]; }) *
                              model.links[i].model_from_link);
  }
  return model_from_link;
}

std::vector<Pose> LinkPoses(const Snapshot& snapshot, int body) {
  std::vector<Pose> poses =
      LinkPoses(*snapshot.layout->bodies[body].model, JointPositions(snapshot, body));
  for (Pose& pose : poses) pose = snapshot.state.bodies[body].world_from_model * pose;
  return poses;
}

// All calls are inlined, because this function is called very often in worlds with many robots.
[[gnu::flatten]] Pose LinkPose(const Snapshot& snapshot, int body, int link) {
  const model::Model& model = *snapshot.layout->bodies[body].model;
  return snapshot.state.bodies[body].world_from_model *
         LinkDisplacement(model, JointPositions(snapshot, body), link,
                          [&](int of) { return ParentJoint(model, of); }) *
         model.links[link].model_from_link;
}

[[gnu::flatten]] Pose ModelFromLink(const Snapshot& snapshot, int body, int link) {
  const model::Model& model = *snapshot.layout->bodies[body].model;
  return LinkDisplacement(model, JointPositions(snapshot, body), link,
                          [&](int of) { return ParentJoint(model, of); }) *
         model.links[link].model_from_link;
}

std::vector<int> MovingLinks(const model::Model& model) {
  const std::vector<int> parent_joint = ParentJoints(model);
  std::vector<int> moving;
  for (std::size_t i = 0; i < model.links.size(); ++i) {
    int link = static_cast<int>(i);
    for (std::size_t level = 0; link >= 0 && parent_joint[link] >= 0; ++level) {
      GSV_CHECK(level < model.links.size());
      const model::Joint& joint = model.joints[parent_joint[link]];
      if (Moves(joint.kind)) {
        moving.push_back(static_cast<int>(i));
        break;
      }
      link = joint.parent;
    }
  }
  return moving;
}

}  // namespace gsv::world
