// What people change by hand of a world that stands still, and how it is told so that it can be
// repeated.
#include <algorithm>

#include "gsv/simulation/stepping_simulation.h"

namespace gsv::simulation {
namespace {

// Wall time that behaviours elsewhere have to end the turn during which somebody paused.
constexpr std::chrono::seconds kTurnPatience{2};
// Of objects that were taken away so many can come back.
constexpr std::size_t kMostRemoved = 1000;

const model::PlacedModel* FindInWorld(const world::Layout& layout, const std::string& name) {
  const auto& models = layout.description->models;
  const auto found =
      std::find_if(models.begin(), models.end(),
                   [&](const model::PlacedModel& placed) { return placed.name == name; });
  return found == models.end() ? nullptr : &*found;
}

}  // namespace

void SteppingSimulation::AwaitTurns() {
  Lock lock(shared_->mutex);
  if (shared_->mode != Mode::kLockstep || shared_->phase != Phase::kPaused) return;
  shared_->changed.wait_for(lock, kTurnPatience, [this] { return shared_->running == 0; });
}

void SteppingSimulation::Tell(Edit edit, const char* event, const std::string& detail) {
  edit.step = state_.step;
  edit.time = state_.time;
  {
    const std::lock_guard lock(shared_->mutex);
    was_edited_ = was_edited_ || was_started_;
    edit.halt = run_;
    const bool stands_still = shared_->phase == Phase::kCreated || shared_->phase == Phase::kPaused;
    const bool all_wait = shared_->running == 0 && shared_->ready.empty();
    edit.moment = stands_still && !turns_have_begun_ ? Edit::Moment::kBeforeTurns
                  : stands_still && all_wait         ? Edit::Moment::kAfterTurns
                                                     : Edit::Moment::kAmidTurns;
  }
  const std::string body = edit.body;
  AddEvent(event, body, detail, std::make_shared<const Edit>(std::move(edit)));
}

bool SteppingSimulation::was_edited() const {
  const std::lock_guard lock(shared_->mutex);
  return was_edited_;
}

base::Status SteppingSimulation::CheckMayEdit() const {
  const std::lock_guard lock(shared_->mutex);
  return RefuseUnless({Phase::kCreated, Phase::kPaused}, "change what stands in it");
}

base::Result<int> SteppingSimulation::FindLoose(const std::string& name) const {
  const int body = layout_->Find(name);
  if (body < 0) {
    return base::Fail(base::ErrorCode::kNotFound, "there is nothing of that name", name);
  }
  const model::PlacedModel* const placed = FindInWorld(*layout_, name);
  if (layout_->bodies[body].is_static() && placed != nullptr &&
      world::KindOf(*placed) == world::BodyKind::kStatic) {
    return base::Fail(base::ErrorCode::kNotFound, "it is fixed to the world", name);
  }
  return body;
}

base::Result<world::Body> SteppingSimulation::BodyOf(const ObjectSpecification& object) const {
  world::Body body;
  if (object.model != nullptr) {
    body.model = object.model;
    body.kind = world::KindOf(*body.model, body.model->is_static, body.model->movement);
  } else if (const int index = layout_->Find(object.copy_of); index >= 0) {
    body.model = layout_->bodies[index].model;
    body.kind = layout_->bodies[index].kind;
  } else if (const auto removed =
                 std::find_if(removed_.rbegin(), removed_.rend(),
                              [&](const world::Body& each) { return each.name == object.copy_of; });
             removed != removed_.rend()) {
    body.model = removed->model;
    body.kind = removed->kind;
  } else if (const auto* placed = FindInWorld(*layout_, object.copy_of)) {
    body.model = placed->model;
    body.kind = world::KindOf(*placed);
  } else {
    return base::Fail(base::ErrorCode::kNotFound, "there is nothing of that name to make a copy of",
                      object.copy_of);
  }
  if (body.model->drive) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "it has a drive, so it is to be added as a robot", body.model->name);
  }
  return body;
}

base::Result<std::string> SteppingSimulation::NameOf(const ObjectSpecification& object,
                                                     const model::Model& model) const {
  if (!object.name.empty()) {
    if (auto ok = CheckName(object.name); !ok) return base::Fail(ok.error());
    if (layout_->Find(object.name) < 0) return object.name;
    return base::Fail(base::ErrorCode::kInvalidArgument, "a body of that name is there already",
                      object.name);
  }
  std::string name = model.name;
  for (int number = 2; layout_->Find(name) >= 0; ++number) {
    name = model.name + "_" + std::to_string(number);
  }
  return name;
}

base::Result<std::string> SteppingSimulation::AddObject(ObjectSpecification object) {
  const std::lock_guard control(control_mutex_);
  if (!geometry::IsFinite(object.world_from_object)) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "the pose is not finite", object.name);
  }
  AwaitTurns();
  const auto world_lock = LockWorld();
  if (!world_lock) return base::Fail(RefuseStuck().error());
  if (auto ok = CheckMayEdit(); !ok) return base::Fail(ok.error());
  auto body = BodyOf(object);
  if (!body) return base::Fail(body.error());
  auto name = NameOf(object, *body->model);
  if (!name) return base::Fail(name.error());
  body->name = *name;
  body->initial_pose = object.on_ground ? StandingPose(*body->model, object.world_from_object)
                                        : object.world_from_object;
  Edit edit;
  edit.kind = Edit::Kind::kAddObject;
  edit.body = *name;
  edit.copy_of = object.model == nullptr ? object.copy_of : "";
  if (object.model != nullptr) edit.model = SourceOf(*object.model);
  edit.world_from_body = object.world_from_object;
  edit.on_ground = object.on_ground;
  std::vector<world::Body> bodies = layout_->bodies;
  bodies.push_back(*std::move(body));
  if (auto ok = ChangeLayout(std::move(bodies), {*name}); !ok) return base::Fail(ok.error());
  {
    const std::lock_guard lock(shared_->mutex);
    IndexAgents();
  }
  Tell(std::move(edit), "object_added",
       "at " + PlaceText(state_.bodies[layout_->Find(*name)].world_from_model));
  return *name;
}

base::Status SteppingSimulation::RemoveObject(const std::string& name) {
  const std::lock_guard control(control_mutex_);
  AwaitTurns();
  const auto world_lock = LockWorld();
  if (!world_lock) return RefuseStuck();
  if (auto ok = CheckMayEdit(); !ok) return ok;
  const auto body = FindLoose(name);
  if (!body) return base::Fail(body.error());
  if (layout_->bodies[*body].is_robot()) {
    return base::Fail(base::ErrorCode::kInvalidArgument,
                      "it is a robot, so it is to be removed as one", name);
  }
  removed_.push_back(layout_->bodies[*body]);
  if (removed_.size() > kMostRemoved) removed_.pop_front();
  std::vector<world::Body> bodies = layout_->bodies;
  bodies.erase(bodies.begin() + *body);
  if (auto ok = ChangeLayout(std::move(bodies), {}); !ok) return ok;
  {
    const std::lock_guard lock(shared_->mutex);
    IndexAgents();
  }
  Edit edit;
  edit.kind = Edit::Kind::kRemove;
  edit.body = name;
  Tell(std::move(edit), "object_removed");
  return {};
}

base::Status SteppingSimulation::PlaceBody(const std::string& name,
                                           const geometry::Pose& world_from_body, bool on_ground) {
  const std::lock_guard control(control_mutex_);
  if (!geometry::IsFinite(world_from_body)) {
    return base::Fail(base::ErrorCode::kInvalidArgument, "the pose is not finite", name);
  }
  AwaitTurns();
  const auto world_lock = LockWorld();
  if (!world_lock) return RefuseStuck();
  if (auto ok = CheckMayEdit(); !ok) return ok;
  const auto body = FindLoose(name);
  if (!body) return base::Fail(body.error());
  std::vector<world::Body> bodies = layout_->bodies;
  bodies[*body].initial_pose =
      on_ground ? StandingPose(*bodies[*body].model, world_from_body, *body) : world_from_body;
  if (auto ok = ChangeLayout(std::move(bodies), {name}); !ok) return ok;
  Edit edit;
  edit.kind = Edit::Kind::kPlace;
  edit.body = name;
  edit.world_from_body = world_from_body;
  edit.on_ground = on_ground;
  Tell(std::move(edit), "body_placed", "at " + PlaceText(state_.bodies[*body].world_from_model));
  return {};
}

}  // namespace gsv::simulation
