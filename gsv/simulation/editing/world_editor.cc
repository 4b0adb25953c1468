#include "gsv/simulation/editing/world_editor.h"

#include <algorithm>
#include <utility>

#include "gsv/sensing/rays/ground.h"
#include "gsv/simulation/editing/body_names.h"
#include "gsv/simulation/editing/carry_over.h"
#include "gsv/simulation/editing/placement.h"
#include "gsv/simulation/limits.h"
#include "gsv/simulation/world/device_loop.h"

namespace gsv::simulation {
namespace {

// The maximum number of removed objects that can be restored.
constexpr std::size_t kMaxRemoved = 1000;

const model::PlacedModel* FindInWorld(const world::Layout& layout, const std::string& name) {
  const auto& models = layout.description->models;
  const auto found =
      std::find_if(models.begin(), models.end(),
                   [&](const model::PlacedModel& placed) { return placed.name == name; });
  return found == models.end() ? nullptr : &*found;
}

base::Status CheckRoomFor(std::size_t more, const std::vector<world::Body>& bodies) {
  const std::size_t max = ProcessLimits().robots;
  const auto there = static_cast<std::size_t>(std::count_if(
      bodies.begin(), bodies.end(), [](const world::Body& body) { return body.is_robot(); }));
  if (there <= max && more <= max - there) return {};
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "a simulation may have at most " + std::to_string(max) +
                        " robots here; remove some first, or raise --limit robots");
}

}  // namespace

geometry::Pose WorldEditor::StandingPose(const model::Model& model, geometry::Pose pose,
                                         int own) const {
  const auto may_carry = [this, own](int body) GSV_REQUIRES(world_mutex) {
    return body != own && !world_.layout()->bodies[static_cast<std::size_t>(body)].is_robot();
  };
  const auto solids = shared_->rays.At(shared_->history.latest());
  const double floor = sensing::FloorHeight(*solids, pose.position.x, pose.position.y, may_carry);
  pose.position.z = floor - model::LowestPoint(model, pose.orientation);
  return pose;
}

base::Status WorldEditor::AddRobots(std::vector<RobotSpecification>& robots) {
  if (auto ok = NameRobots(*world_.layout(), robots); !ok) return ok;
  std::vector<world::Body> bodies = world_.layout()->bodies;
  if (auto ok = CheckRoomFor(robots.size(), bodies); !ok) return ok;
  std::vector<std::string> added;
  for (const RobotSpecification& robot : robots) {
    world::Body body;
    body.name = robot.name;
    body.model = robot.model;
    body.initial_pose = robot.on_ground ? StandingPose(*robot.model, robot.world_from_robot)
                                        : robot.world_from_robot;
    const model::Movement movement = robot.movement.value_or(robot.model->movement);
    body.kind =
        robot.is_avatar ? world::BodyKind::kAvatar : world::KindOf(*robot.model, false, movement);
    bodies.push_back(std::move(body));
    added.push_back(robot.name);
  }
  return ChangeBodies(std::move(bodies), added);
}

base::Status WorldEditor::Resolve(const world::Layout& layout,
                                  const std::vector<std::string>& placed, world::State& state) {
  auto pushed_out = ResolvePlacement(world_.engine(), layout, placed, state);
  if (!pushed_out) return base::Fail(pushed_out.error());
  for (PushedOut& robot : *pushed_out) {
    events_.Emit("robot_moved", std::move(robot.robot), std::move(robot.sentence));
  }
  return {};
}

base::Status WorldEditor::ChangeBodies(std::vector<world::Body> bodies,
                                       const std::vector<std::string>& placed) {
  return ChangeWorld(std::move(bodies), world_.layout()->description, placed);
}

base::Status WorldEditor::ChangeWorld(std::vector<world::Body> bodies,
                                      std::shared_ptr<const model::WorldDescription> description,
                                      const std::vector<std::string>& placed) {
  const world::Layout& old_layout = *world_.layout();
  const std::uint32_t version = old_layout.version + 1;
  auto layout = world::MakeLayout(version, std::move(bodies), std::move(description));
  world::State state = CarryOver(old_layout, world_.state(), *layout);
  CarryOverDevices(*layout, placed, state);
  auto status = world_.TryLayout(layout, state);
  for (const std::string& name : placed) ResetToInitialPose(*layout, layout->Find(name), state);
  if (status) status = Resolve(*layout, placed, state);
  if (!status) {
    if (const auto back = world_.Restore(); !back) return back;
    return status;
  }
  MoveDevices(*layout, state.time, state);
  // A reset moves a robot to its initial pose. For a robot that was pushed out of an overlap when
  // it was added, this is the pose to which it was pushed. Moving a robot after the first step does
  // not change its initial pose.
  std::vector<world::Body> settled = layout->bodies;
  for (const std::string& name : placed) {
    world::Body& body = settled[static_cast<std::size_t>(layout->Find(name))];
    const bool starts_here = state.step == 0 || body.is_static();
    const int old = starts_here ? -1 : old_layout.Find(name);
    const auto now = static_cast<std::size_t>(layout->Find(name));
    body.initial_pose = old >= 0 ? old_layout.bodies[static_cast<std::size_t>(old)].initial_pose
                                 : state.bodies[now].world_from_model;
  }
  if (auto ok = world_.Replace(world::MakeLayout(version, std::move(settled), layout->description),
                               std::move(state));
      !ok) {
    return ok;
  }
  TakeChange(placed);
  return {};
}

void WorldEditor::TakeChange(const std::vector<std::string>& placed) {
  auto latest = std::make_shared<world::Snapshot>(world_.InitialSnapshot());
  if (latest->state.step == 0) {
    shared_->history.Restart(std::move(latest));
    return;
  }
  const auto carry_over = [&layout = world_.layout(),
                           &now = std::as_const(world_).state()](const world::Snapshot& earlier) {
    return std::make_shared<world::Snapshot>(CarryOver(earlier, layout, now));
  };
  // Sensors keep what they have sampled, and the contacts and accelerations of the last step.
  world::State state = std::move(latest->state);
  *latest = *carry_over(*shared_->history.latest());
  latest->state = std::move(state);
  ForgetMotion(placed, *latest);
  shared_->history.Change(std::move(latest), carry_over);
}

base::Result<int> WorldEditor::FindMovable(const std::string& name) const {
  const int body = world_.layout()->Find(name);
  if (body < 0) {
    return base::Fail(base::ErrorCode::kNotFound, "there is no body of this name", name);
  }
  const model::PlacedModel* const placed = FindInWorld(*world_.layout(), name);
  if (world_.layout()->bodies[static_cast<std::size_t>(body)].is_static() && placed != nullptr &&
      world::KindOf(*placed) == world::BodyKind::kStatic) {
    return base::Fail(base::ErrorCode::kNotFound,
                      "the body is fixed to the world, so it cannot be moved or removed", name);
  }
  return body;
}

base::Result<world::Body> WorldEditor::BodyOf(const ObjectSpecification& object) const {
  const world::Layout& layout = *world_.layout();
  world::Body body;
  if (object.model != nullptr) {
    body.model = object.model;
    body.kind = world::KindOf(*body.model, body.model->is_static, body.model->movement);
  } else if (const int index = layout.Find(object.copy_of); index >= 0) {
    body.model = layout.bodies[static_cast<std::size_t>(index)].model;
    body.kind = layout.bodies[static_cast<std::size_t>(index)].kind;
    body.pedestrian = layout.bodies[static_cast<std::size_t>(index)].pedestrian;
  } else if (const auto removed =
                 std::find_if(removed_.rbegin(), removed_.rend(),
                              [&](const world::Body& each) { return each.name == object.copy_of; });
             removed != removed_.rend()) {
    body.model = removed->model;
    body.kind = removed->kind;
    body.pedestrian = removed->pedestrian;
  } else if (const auto* placed = FindInWorld(layout, object.copy_of)) {
    body.model = placed->model;
    body.kind = world::KindOf(*placed);
  } else {
    return base::Fail(base::ErrorCode::kNotFound, "there is no object of this name to copy",
                      object.copy_of);
  }
  if (body.model->drive) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "the model has a drive; add it as a robot",
                      body.model->name);
  }
  return body;
}

base::Result<std::string> WorldEditor::NameOf(const ObjectSpecification& object,
                                              const model::Model& model) const {
  if (object.name.empty()) return FreeName(*world_.layout(), model.name);
  if (auto ok = CheckBodyName(object.name); !ok) return base::Fail(ok.error());
  if (world_.layout()->Find(object.name) < 0) return object.name;
  return base::Fail(base::ErrorCode::kInvalidArgument, "there is already a body of this name",
                    object.name);
}

base::Result<std::string> WorldEditor::AddObject(const ObjectSpecification& object) {
  auto body = BodyOf(object);
  if (!body) return base::Fail(body.error());
  auto name = NameOf(object, *body->model);
  if (!name) return base::Fail(name.error());
  body->name = *name;
  body->initial_pose = object.on_ground ? StandingPose(*body->model, object.world_from_object)
                                        : object.world_from_object;
  std::vector<world::Body> bodies = world_.layout()->bodies;
  bodies.push_back(*std::move(body));
  if (auto ok = ChangeBodies(std::move(bodies), {*name}); !ok) return base::Fail(ok.error());
  return *name;
}

base::Status WorldEditor::RemoveObject(const std::string& name) {
  const auto body = FindMovable(name);
  if (!body) return base::Fail(body.error());
  const world::Body& object = world_.layout()->bodies[static_cast<std::size_t>(*body)];
  if (object.is_robot()) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "the body is a robot; remove it as a robot", name);
  }
  removed_.push_back(object);
  if (removed_.size() > kMaxRemoved) removed_.pop_front();
  return Remove({name});
}

base::Status WorldEditor::Remove(const std::vector<std::string>& names) {
  std::vector<world::Body> bodies = world_.layout()->bodies;
  std::erase_if(bodies, [&](const world::Body& body) {
    return std::find(names.begin(), names.end(), body.name) != names.end();
  });
  return ChangeBodies(std::move(bodies), {});
}

base::Status WorldEditor::Place(const std::string& name, const geometry::Pose& world_from_body,
                                bool on_ground) {
  const auto body = FindMovable(name);
  if (!body) return base::Fail(body.error());
  return PlaceAny(*body, world_from_body, on_ground);
}

base::Status WorldEditor::PlaceAny(int body, const geometry::Pose& world_from_body,
                                   bool on_ground) {
  std::vector<world::Body> bodies = world_.layout()->bodies;
  world::Body& placed = bodies[static_cast<std::size_t>(body)];
  placed.initial_pose =
      on_ground ? StandingPose(*placed.model, world_from_body, body) : world_from_body;
  const std::string name = placed.name;
  return ChangeBodies(std::move(bodies), {name});
}

base::Status WorldEditor::SetGravity(const geometry::Vector3& gravity) {
  auto description = std::make_shared<model::WorldDescription>(*world_.layout()->description);
  description->gravity = gravity;
  return ChangeWorld(world_.layout()->bodies, std::move(description), {});
}

base::Status WorldEditor::SetInitialPoses(const std::map<std::string, geometry::Pose>& poses) {
  if (poses.empty()) return {};
  std::vector<world::Body> bodies = world_.layout()->bodies;
  for (world::Body& body : bodies) {
    const auto pose = poses.find(body.name);
    if (pose != poses.end()) body.initial_pose = pose->second;
  }
  return ChangeBodies(std::move(bodies), {});
}

}  // namespace gsv::simulation
