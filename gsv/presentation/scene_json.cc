#include "gsv/presentation/scene_json.h"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "gsv/geometry/box_corners.h"
#include "gsv/presentation/pose_list.h"
#include "gsv/presentation/sensor_messages.h"
#include "gsv/sensing/sensor_set.h"
#include "gsv/world/station.h"

namespace gsv::presentation {
namespace {

using Json = nlohmann::ordered_json;
using geometry::Bounds;
using geometry::Pose;
using geometry::Vector3;

Json VectorJson(const Vector3& v) { return {v.x, v.y, v.z}; }

Json ColourJson(const model::Colour& colour) { return {colour.r, colour.g, colour.b}; }

Json PoseJson(const Pose& pose) {
  const Vector3& p = pose.position;
  const geometry::Quaternion& q = pose.orientation;
  return {p.x, p.y, p.z, q.x, q.y, q.z, q.w};
}

const char* KindName(model::Light::Kind kind) {
  switch (kind) {
    case model::Light::Kind::kDirectional:
      return "directional";
    case model::Light::Kind::kPoint:
      return "point";
    case model::Light::Kind::kSpot:
      return "spot";
  }
  return "point";
}

const char* OverlayName(sensing::Overlay overlay) {
  switch (overlay) {
    case sensing::Overlay::kNone:
      return "none";
    case sensing::Overlay::kLines:
      return "lines";
    case sensing::Overlay::kPoints:
      return "points";
    case sensing::Overlay::kImage:
      return "picture";
  }
  return "none";
}

Json LightJson(const model::Light& light) {
  return {{"name", light.name},
          {"kind", KindName(light.kind)},
          {"pose", PoseJson(light.world_from_light)},
          {"direction", VectorJson(light.world_from_light.orientation * light.direction)},
          {"colour", ColourJson(light.diffuse)},
          {"intensity", light.intensity},
          {"range_m", light.range},
          {"attenuation",
           {light.constant_attenuation, light.linear_attenuation, light.quadratic_attenuation}},
          {"inner_angle_rad", light.inner_angle},
          {"outer_angle_rad", light.outer_angle},
          {"cast_shadows", light.cast_shadows}};
}

Json LookJson(const model::SceneLook& look) {
  return {{"ambient", ColourJson(look.ambient)},
          {"background", ColourJson(look.background)},
          {"shadows", look.shadows},
          {"sky", look.sky}};
}

// The distinct sets of sensor parameters. Robots of the same model share their sets.
class ParameterSets {
 public:
  // Returns the index of the sensor's set in the result of Take().
  std::size_t IndexOf(const model::SensorDescription& sensor) {
    Json set = Json::object();
    if (sensor.update_rate > 0) set["update_rate"] = sensor.update_rate;
    for (const auto& [name, value] : sensor.parameters) {
      std::visit([&, &key = name](const auto& held) { set[key] = held; }, value);
    }
    // Invalid UTF-8 in a text is replaced, because dump() would otherwise throw.
    const auto [it, is_new] =
        index_.try_emplace(set.dump(-1, ' ', false, Json::error_handler_t::replace), sets_.size());
    if (is_new) sets_.push_back(std::move(set));
    return it->second;
  }

  Json Take() { return std::move(sets_); }

 private:
  Json sets_ = Json::array();
  std::map<std::string, std::size_t> index_;
};

// Returns the sensors of a body. `known` provides the frustums of its cameras.
Json SensorsJson(const SceneSource& source, const world::Body& body, sensing::SensorSet& known,
                 ParameterSets& parameters) {
  Json sensors = Json::array();
  if (!world::HasAgent(body)) return sensors;
  for (const model::SensorDescription& sensor : source.sensors(body.name)) {
    const sensing::SensorType* type = source.sensor_types.Find(sensor.type);
    const bool has_link =
        sensor.link >= 0 && sensor.link < static_cast<int>(body.model->links.size());
    if (type == nullptr || !has_link) continue;
    Json json{{"name", sensor.name},
              {"type", type->name},
              {"overlay", OverlayName(type->overlay)},
              {"link", body.model->links[sensor.link].name},
              {"pose", PoseJson(sensor.link_from_sensor)},
              {"topic", SensorTopic(body.name, sensor.name)},
              {"parameters", parameters.IndexOf(sensor)}};
    // The key "units" maps a field's path in the sensor's message to its unit, such as
    // "linear_acceleration": "m/s²". The unit also applies to all fields below this path.
    if (auto units = type->layout.Units(); !units.empty()) json["units"] = std::move(units);
    const auto made = known.Of(sensor);
    if (const auto frustum = made ? (*made)->frustum() : std::nullopt) {
      json["horizontal_fov_rad"] = frustum->horizontal_fov;
      json["aspect_ratio"] = frustum->aspect_ratio;
    }
    sensors.push_back(std::move(json));
  }
  return sensors;
}

// Returns the movable joints. Each is given in the frame of its child link if that link has its own
// pose (`moving`), else in the model's frame.
Json JointsJson(const model::Model& model, const std::set<int>& moving) {
  Json joints = Json::array();
  for (const model::Joint& joint : model.joints) {
    if (joint.kind == model::JointKind::kFixed) continue;
    const bool is_moving = moving.contains(joint.child);
    const model::Link& link = model.links[joint.child];
    Json name = nullptr;
    if (is_moving) name = link.name;
    joints.push_back(
        {{"name", joint.name},
         {"kind", model::NameOf(joint.kind)},
         {"link", std::move(name)},
         {"pose", PoseJson(is_moving ? Inverse(link.model_from_link) * joint.model_from_joint
                                     : joint.model_from_joint)},
         {"axis", VectorJson(joint.axis)}});
  }
  return joints;
}

// Whether this is a static body of the world file. Such a body cannot be removed.
bool IsFixed(const world::Layout& layout, const world::Body& body) {
  const auto& models = layout.description->models;
  return body.is_static() &&
         std::any_of(models.begin(), models.end(), [&](const model::PlacedModel& placed) {
           return placed.name == body.name && world::KindOf(placed) == world::BodyKind::kStatic;
         });
}

// Whether this body comes from the world file. After its removal, it can be added again by its
// name, because its model is known.
bool IsOfWorld(const world::Layout& layout, const world::Body& body) {
  const auto& models = layout.description->models;
  return std::any_of(models.begin(), models.end(), [&](const model::PlacedModel& placed) {
    return placed.name == body.name && placed.model == body.model;
  });
}

Json BodyJson(const SceneSource& source, const world::Body& body, const Pose& pose,
              const std::set<int>& moving, sensing::SensorSet& known, ParameterSets& parameters) {
  Json links = Json::array();
  for (const model::Link& link : body.model->links) links.push_back(link.name);
  Json json{{"name", body.name},
            {"model", source.identify(body.model)},
            {"is_static", body.is_static()},
            {"is_robot", body.is_robot()},
            {"is_avatar", body.is_avatar()},
            {"pose", PoseJson(pose)},
            {"links", std::move(links)},
            {"sensors", SensorsJson(source, body, known, parameters)}};
  if (world::IsStation(body)) json["is_station"] = true;
  if (body.is_static() && !IsFixed(*source.snapshot.layout, body)) json["is_fixed"] = false;
  if (body.is_robot() && body.model->drive && body.model->drive->kind == model::DriveKind::kNone) {
    json["has_drive"] = false;
  }
  if (body.is_robot() && IsOfWorld(*source.snapshot.layout, body)) json["is_of_world"] = true;
  if (const std::string id = source.identify_collisions(body.model); !id.empty()) {
    json["collisions"] = id;
  }
  if (Json joints = JointsJson(*body.model, moving); !joints.empty()) {
    json["joints"] = std::move(joints);
  }
  return json;
}

// The masses of a model's links, as its description gives them.
Json InertialsJson(const model::Model& model) {
  Json inertials = Json::array();
  for (const model::Link& link : model.links) {
    const model::Inertial& inertial = link.inertial;
    if (!(inertial.mass > 0)) continue;
    inertials.push_back(
        {{"link", link.name},
         {"mass_kg", inertial.mass},
         {"pose", PoseJson(inertial.link_from_com)},
         {"pose_in_model", PoseJson(link.model_from_link * inertial.link_from_com)},
         {"inertia_kg_m2",
          {inertial.ixx, inertial.iyy, inertial.izz, inertial.ixy, inertial.ixz, inertial.iyz}}});
  }
  return inertials;
}

// Returns the inertial data of all models whose bodies can move.
Json AllInertialsJson(const SceneSource& source) {
  std::map<const model::Model*, std::shared_ptr<const model::Model>> models;
  for (const world::Body& body : source.snapshot.layout->bodies) {
    if (!body.is_static()) models.try_emplace(body.model.get(), body.model);
  }
  // Ordered by identifier, because addresses differ from run to run.
  std::map<std::string, Json> by_identifier;
  for (const auto& [address, model] : models) {
    by_identifier.try_emplace(source.identify(model), InertialsJson(*model));
  }
  Json inertials = Json::object();
  for (auto& [identifier, list] : by_identifier) inertials[identifier] = std::move(list);
  return inertials;
}

Json PoseListJson(const world::Layout& layout) {
  Json list = Json::array();
  for (const PoseEntry& entry : PoseListOf(layout)) {
    Json link = nullptr;
    if (entry.link >= 0) link = layout.bodies[entry.body].model->links[entry.link].name;
    list.push_back({{"body", entry.body}, {"link", std::move(link)}});
  }
  return list;
}

void Grow(std::optional<Bounds>& bounds, const Vector3& point) {
  if (!geometry::IsFinite(point)) return;
  if (!bounds) bounds = Bounds{point, point};
  bounds->min = {std::min(bounds->min.x, point.x), std::min(bounds->min.y, point.y),
                 std::min(bounds->min.z, point.z)};
  bounds->max = {std::max(bounds->max.x, point.x), std::max(bounds->max.y, point.y),
                 std::max(bounds->max.z, point.z)};
}

// Extends `bounds` by the corners of `box`.
void Grow(std::optional<Bounds>& bounds, const Pose& target_from_box, const Bounds& box) {
  for (const Vector3& corner : geometry::CornersOf(box)) Grow(bounds, target_from_box * corner);
}

bool HasEnd(const model::Collision& collision) {
  return !std::holds_alternative<geometry::Plane>(collision.shape);
}

// Returns the bounds in the model's frame, at zero joint positions.
std::optional<Bounds> VisibleBounds(const model::Model& model) {
  std::optional<Bounds> bounds;
  for (const model::Link& link : model.links) {
    for (const model::Visual& visual : link.visuals) {
      if (std::holds_alternative<geometry::Plane>(visual.shape)) continue;
      Grow(bounds, link.model_from_link * visual.link_from_visual, BoundsOf(visual.shape));
    }
  }
  return bounds;
}

}  // namespace

Bounds SceneBounds(const world::Snapshot& snapshot) {
  // The bounds are computed once for each model, because many bodies may share a model.
  std::map<const model::Model*, std::optional<Bounds>> of_model;
  std::optional<Bounds> bounds;
  for (std::size_t i = 0; i < snapshot.layout->bodies.size(); ++i) {
    const model::Model* model = snapshot.layout->bodies[i].model.get();
    const auto [entry, is_new] = of_model.try_emplace(model);
    if (is_new) entry->second = VisibleBounds(*model);
    if (entry->second) Grow(bounds, snapshot.state.bodies[i].world_from_model, *entry->second);
  }
  return bounds.value_or(Bounds{{-5, -5, -5}, {5, 5, 5}});
}

std::string SceneJson(const SceneSource& source) {
  const world::Snapshot& snapshot = source.snapshot;
  const world::Layout& layout = *snapshot.layout;
  const Bounds bounds = SceneBounds(snapshot);
  Json lights = Json::array();
  for (const model::Light& light : layout.description->lights) lights.push_back(LightJson(light));
  Json bodies = Json::array();
  std::vector<std::set<int>> moving(layout.bodies.size());  // moving links of each body
  for (const PoseEntry& entry : PoseListOf(layout)) {
    if (entry.link >= 0) moving[entry.body].insert(entry.link);
  }
  sensing::SensorSet known(source.sensor_types);
  ParameterSets parameters;
  for (std::size_t i = 0; i < layout.bodies.size(); ++i) {
    bodies.push_back(BodyJson(source, layout.bodies[i], snapshot.state.bodies[i].world_from_model,
                              moving[i], known, parameters));
  }
  const Json scene{{"layout_version", layout.version},
                   {"name", layout.description->name},
                   {"bounds", {{"min", VectorJson(bounds.min)}, {"max", VectorJson(bounds.max)}}},
                   {"look", LookJson(layout.description->scene)},
                   {"lights", std::move(lights)},
                   {"bodies", std::move(bodies)},
                   {"inertials", AllInertialsJson(source)},
                   {"sensor_parameters", parameters.Take()},
                   {"poses", PoseListJson(layout)}};
  return scene.dump(-1, ' ', false, Json::error_handler_t::replace);
}

bool HasCollisions(const model::Model& model) {
  return std::any_of(model.links.begin(), model.links.end(), [](const model::Link& link) {
    return std::any_of(link.collisions.begin(), link.collisions.end(), HasEnd);
  });
}

model::Model CollisionModel(const model::Model& model) {
  model::Model shown = model;
  for (model::Link& link : shown.links) {
    link.visuals.clear();
    for (const model::Collision& collision : link.collisions) {
      if (!HasEnd(collision)) continue;
      link.visuals.push_back({collision.name, collision.link_from_collision, collision.shape});
    }
  }
  return shown;
}

std::string SceneJson(const simulation::Simulation& simulation, const IdentifyModel& identify,
                      const IdentifyModel& identify_collisions) {
  const std::shared_ptr<const world::Snapshot> snapshot = simulation.snapshot();
  return SceneJson({*snapshot, simulation.sensor_types(),
                    [&](const std::string& robot) { return simulation.sensors(robot); }, identify,
                    identify_collisions});
}

}  // namespace gsv::presentation
