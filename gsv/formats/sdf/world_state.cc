#include "gsv/formats/sdf/world_state.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>
#include <sstream>
#include <vector>

#include "gsv/formats/sdf/loop_gap.h"
#include "gsv/formats/sdf/sdf_xml.h"
#include "gsv/formats/sdf/value_text.h"
#include "gsv/formats/sdf/world_frames.h"

namespace gsv::formats {
namespace {

using geometry::Pose;
using model::JointKind;
using tinyxml2::XMLElement;

constexpr int kMaxStateDepth = 32;
// If all joint positions of a model are closer to zero than this (rad or m), they count as zero.
// Then the placed model needs no copy with its own start positions, and stays shared.
constexpr double kAtZero = 1e-9;
constexpr double kMaxLoopGap = 1e-3;  // m: a larger gap of a loop is reported

std::string NameAttribute(const XMLElement& element) {
  const char* name = element.Attribute("name");
  return name == nullptr ? "" : name;
}

std::optional<Pose> StatePose(const XMLElement& element, const ReadingContext& context) {
  if (element.FirstChildElement("pose") == nullptr) return std::nullopt;
  auto pose = ReadPose(element);
  if (pose) return pose->pose;
  context.Warn(pose.error().message + "; the state's pose is ignored",
               PlaceOf(context.source, element));
  return std::nullopt;
}

// Calls `visit` with each child that has one of two names, because SDFormat 1.12 renamed these
// elements.
template <typename Visit>
void ForEachChild(const XMLElement& parent, const char* name, const char* newer, Visit visit) {
  for (auto* child = parent.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    if (std::strcmp(child->Name(), name) == 0 || std::strcmp(child->Name(), newer) == 0) {
      visit(*child);
    }
  }
}

// Reads <angle axis="0">, which SDFormat has up to 1.11, or <axis_state><position>.
std::optional<double> PositionOf(const XMLElement& joint) {
  const XMLElement* element = joint.FirstChildElement("angle");
  if (const auto* axis = joint.FirstChildElement("axis_state")) {
    element = axis->FirstChildElement("position");
  }
  if (element == nullptr || element->GetText() == nullptr) return std::nullopt;
  const LeadingNumber number = LeadingNumberOf(element->GetText());
  if (!number.is_number || !std::isfinite(number.value)) return std::nullopt;
  return element->BoolAttribute("degrees", false) ? number.value * std::numbers::pi / 180
                                                  : number.value;
}

// Returns the displacement of a joint's child frame relative to its parent frame.
double Displacement(const model::Joint& joint, const Pose& joint_from_moved) {
  if (joint.kind == JointKind::kPrismatic) return Dot(joint.axis, joint_from_moved.position);
  const auto& q = joint_from_moved.orientation;
  return geometry::WrapAngle(2 * std::atan2(Dot(joint.axis, {q.x, q.y, q.z}), q.w));
}

}  // namespace

bool IsStateOf(const XMLElement& world, const XMLElement& state) {
  const char* const of = state.Attribute("world_name");
  const char* const name = world.Attribute("name");
  return of == nullptr || name == nullptr || std::strcmp(of, name) == 0;
}

void TakeInsertions(XMLElement& state, XMLElement& world) {
  auto* const insertions = state.FirstChildElement("insertions");
  if (insertions == nullptr) return;
  XMLElement* next = nullptr;
  for (auto* child = insertions->FirstChildElement(); child != nullptr; child = next) {
    next = child->NextSiblingElement();
    if (std::strcmp(child->Name(), "model") == 0 || std::strcmp(child->Name(), "light") == 0) {
      world.InsertEndChild(child);
    }
  }
}

void AddDeletions(const XMLElement& state, std::set<std::string>& names) {
  const auto* const deletions = state.FirstChildElement("deletions");
  if (deletions == nullptr) return;
  for (auto* name = deletions->FirstChildElement("name"); name != nullptr;
       name = name->NextSiblingElement("name")) {
    if (name->GetText() != nullptr) names.insert(name->GetText());
  }
}

void WorldState::Read(XMLElement& world, const ReadingContext& context) {
  while (auto* state = world.FirstChildElement("state")) {
    if (IsStateOf(world, *state)) {
      ReadState(*state, world, context);
    } else {
      context.Warn("the <state> is one of the world \"" +
                       std::string(state->Attribute("world_name")) +
                       "\", not of this one; it is ignored",
                   PlaceOf(context.source, *state));
    }
    world.DeleteChild(state);
  }
}

void WorldState::ReadState(XMLElement& state, XMLElement& world, const ReadingContext& context) {
  TakeInsertions(state, world);
  AddDeletions(state, deleted_);
  ForEachChild(state, "model", "model_state", [&](const XMLElement& model) {
    ModelState& saved = models_[NameAttribute(model)];
    saved.place = PlaceOf(context.source, model);
    ReadModel(model, "", kMaxStateDepth, context, saved);
  });
  ForEachChild(state, "light", "light_state", [&](const XMLElement& light) {
    if (const auto pose = StatePose(light, context)) {
      lights_[NameAttribute(light)] = {*pose, PlaceOf(context.source, light)};
    }
  });
}

void WorldState::ReadModel(const XMLElement& element, const std::string& scope, int levels_left,
                           const ReadingContext& context, ModelState& state) {
  if (levels_left == 0) return;
  if (scope.empty()) {
    if (const auto pose = StatePose(element, context)) state.pose = pose;
  }
  ForEachChild(element, "link", "link_state", [&](const XMLElement& link) {
    if (const auto pose = StatePose(link, context)) {
      state.links[scope + NameAttribute(link)] = *pose;
    }
  });
  ForEachChild(element, "joint", "joint_state", [&](const XMLElement& joint) {
    if (const auto position = PositionOf(joint)) {
      state.joints[scope + NameAttribute(joint)] = *position;
    }
  });
  ForEachChild(element, "model", "model_state", [&](const XMLElement& inner) {
    ReadModel(inner, scope + NameAttribute(inner) + "::", levels_left - 1, context, state);
  });
}

std::vector<double> WorldState::PositionsOf(const model::Model& model, const ModelState& state,
                                            const Pose& world_from_model) {
  const auto pose_of = [&](int link) -> std::optional<Pose> {
    if (link < 0) return world_from_model;
    const auto found = state.links.find(model.links[static_cast<std::size_t>(link)].name);
    return found == state.links.end() ? std::nullopt : std::optional(found->second);
  };
  const auto at_zero = [&](int link) {
    return link < 0 ? Pose{} : model.links[static_cast<std::size_t>(link)].model_from_link;
  };
  std::vector<double> positions;
  bool has_moved = false;
  for (const model::Joint& joint : model.joints) {
    double position = 0;
    const auto parent = pose_of(joint.parent), child = pose_of(joint.child);
    const auto written = state.joints.find(joint.name);
    if (!model::TakesCommands(joint.kind)) {
      position = 0;
    } else if (parent && child) {
      const Pose joint_from_parent = Inverse(joint.model_from_joint) * at_zero(joint.parent);
      const Pose child_from_joint = Inverse(at_zero(joint.child)) * joint.model_from_joint;
      position =
          Displacement(joint, joint_from_parent * (Inverse(*parent) * *child) * child_from_joint);
    } else if (written != state.joints.end()) {
      position = written->second;
    }
    position = std::clamp(position, joint.position_limits.min, joint.position_limits.max);
    has_moved = has_moved || std::abs(position) > kAtZero;
    positions.push_back(position);
  }
  return has_moved ? positions : std::vector<double>{};
}

void WorldState::Apply(model::PlacedModel& placed, const ReadingContext& context) const {
  const auto found = models_.find(placed.name);
  if (found == models_.end() || placed.model->script != nullptr) return;
  const ModelState& state = found->second;
  if (state.pose) placed.world_from_model = *state.pose;
  const model::Link& first = placed.model->links.front();
  if (const auto link = state.links.find(first.name); link != state.links.end()) {
    placed.world_from_model = link->second * Inverse(first.model_from_link);
  }
  std::vector<double> positions = PositionsOf(*placed.model, state, placed.world_from_model);
  if (positions.empty()) return;
  auto moved = std::make_shared<model::Model>(*placed.model);
  moved->start_positions = std::move(positions);
  for (const model::Joint& loop : moved->loop_joints) {
    const double gap = LoopGap(*moved, loop);
    if (!(gap > kMaxLoopGap)) continue;
    std::ostringstream text;
    text.precision(3);
    text << "the <state> leaves the loop that the joint \"" << loop.name << "\" closes open by "
         << gap << " m; the links snap together in the first steps";
    context.Warn(text.str(), state.place);
  }
  placed.model = std::move(moved);
}

std::optional<Pose> WorldState::LightPose(const std::string& name) const {
  const auto found = lights_.find(name);
  return found == lights_.end() ? std::nullopt : std::optional(found->second.pose);
}

void WorldState::ReportMissing(const model::WorldDescription& world,
                               const ReadingContext& context) const {
  const auto find = [](const auto& all, const std::string& name) {
    return std::find_if(all.begin(), all.end(),
                        [&](const auto& each) { return each.name == name; });
  };
  const auto warn = [&](const std::string& owner, const char* kind, const std::string& name,
                        const std::string& place) {
    context.Warn("the <state> names the " + std::string(kind) + " \"" + name + "\", but " + owner +
                     " has no such part; this part of the state is ignored",
                 place);
  };
  for (const auto& [name, state] : models_) {
    if (IsDeleted(name)) continue;
    const auto placed = find(world.models, name);
    if (placed == world.models.end()) {
      warn("the world", "model", name, state.place);
      continue;
    }
    for (const auto& [link, pose] : state.links) {
      if (find(placed->model->links, link) == placed->model->links.end()) {
        warn("the model " + name, "link", link, state.place);
      }
    }
    for (const auto& [joint, position] : state.joints) {
      if (find(placed->model->joints, joint) == placed->model->joints.end()) {
        warn("the model " + name, "joint", joint, state.place);
      }
    }
  }
  for (const auto& [name, state] : lights_) {
    if (!IsDeleted(name) && find(world.lights, name) == world.lights.end()) {
      warn("the world", "light", name, state.place);
    }
  }
}

}  // namespace gsv::formats
