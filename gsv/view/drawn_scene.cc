#include "gsv/view/drawn_scene.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <nlohmann/json.hpp>

#include "gsv/view/framing.h"

namespace gsv::view {
namespace {

using SceneJson = nlohmann::json;
using geometry::Pose;
using geometry::Vector3;

const SceneJson& MemberOf(const SceneJson& object, const char* name) {
  static const SceneJson kNothing;
  if (!object.is_object()) return kNothing;
  const auto found = object.find(name);
  return found == object.end() ? kNothing : *found;
}

// Returns the member if it is a list, otherwise an empty list.
const SceneJson& ListOf(const SceneJson& object, const char* name) {
  static const SceneJson kEmpty = SceneJson::array();
  const SceneJson& list = MemberOf(object, name);
  return list.is_array() ? list : kEmpty;
}

std::string TextOf(const SceneJson& object, const char* name) {
  const SceneJson& text = MemberOf(object, name);
  return text.is_string() ? text.get<std::string>() : std::string();
}

double NumberOf(const SceneJson& json, double otherwise) {
  const double value = json.is_number() ? json.get<double>() : otherwise;
  return std::isfinite(value) ? value : otherwise;
}

double NumberIn(const SceneJson& list, std::size_t index, double otherwise) {
  return list.is_array() && index < list.size() ? NumberOf(list[index], otherwise) : otherwise;
}

Vector3 VectorOf(const SceneJson& list) {
  return {NumberIn(list, 0, 0), NumberIn(list, 1, 0), NumberIn(list, 2, 0)};
}

Pose PoseOf(const SceneJson& list) {
  return {VectorOf(list), geometry::Normalized({NumberIn(list, 6, 1), NumberIn(list, 3, 0),
                                                NumberIn(list, 4, 0), NumberIn(list, 5, 0)})};
}

bool FlagOf(const SceneJson& object, const char* name, bool otherwise) {
  const SceneJson& flag = MemberOf(object, name);
  return flag.is_boolean() ? flag.get<bool>() : otherwise;
}

model::Colour ColourIn(const SceneJson& object, const char* name) {
  const SceneJson& list = MemberOf(object, name);
  return {NumberIn(list, 0, 1), NumberIn(list, 1, 1), NumberIn(list, 2, 1), 1};
}

model::Light LightOf(const SceneJson& json) {
  model::Light light;
  const std::string kind = TextOf(json, "kind");
  light.name = TextOf(json, "name");
  light.kind = kind == "directional" ? model::Light::Kind::kDirectional
               : kind == "spot"      ? model::Light::Kind::kSpot
                                     : model::Light::Kind::kPoint;
  // The direction is in the world's frame.
  light.world_from_light.position = VectorOf(MemberOf(json, "pose"));
  const Vector3 direction = VectorOf(MemberOf(json, "direction"));
  if (Norm(direction) > 0) light.direction = Normalized(direction);
  light.diffuse = ColourIn(json, "colour");
  light.intensity = NumberOf(MemberOf(json, "intensity"), 1);
  light.range = NumberOf(MemberOf(json, "range_m"), 10);
  const SceneJson& attenuation = MemberOf(json, "attenuation");
  light.constant_attenuation = NumberIn(attenuation, 0, 1);
  light.linear_attenuation = NumberIn(attenuation, 1, 0);
  light.quadratic_attenuation = NumberIn(attenuation, 2, 0);
  light.inner_angle = NumberOf(MemberOf(json, "inner_angle_rad"), 0);
  light.outer_angle = NumberOf(MemberOf(json, "outer_angle_rad"), 0);
  light.cast_shadows = FlagOf(json, "cast_shadows", true);
  return light;
}

std::shared_ptr<const model::WorldDescription> DescriptionOf(const SceneJson& scene) {
  auto description = std::make_shared<model::WorldDescription>();
  const SceneJson& look = MemberOf(scene, "look");
  description->name = TextOf(scene, "name");
  description->scene.ambient = ColourIn(look, "ambient");
  description->scene.background = ColourIn(look, "background");
  description->scene.shadows = FlagOf(look, "shadows", true);
  description->scene.sky = FlagOf(look, "sky", false);
  for (const SceneJson& light : ListOf(scene, "lights")) {
    description->lights.push_back(LightOf(light));
  }
  return description;
}

// Returns the name of the separate body for a moving link. The separator is a character that is not
// allowed in names of bodies. So no other body has the returned name.
std::string NameOfLink(const std::string& body, const std::string& link) {
  return body + '\x1f' + link;
}

int LinkNamed(const model::Model& model, const std::string& name) {
  const auto found = std::find_if(model.links.begin(), model.links.end(),
                                  [&](const model::Link& link) { return link.name == name; });
  return found == model.links.end() ? -1 : static_cast<int>(found - model.links.begin());
}

// A model without its moving links, and one model for each moving link.
struct SplitModel {
  std::shared_ptr<const model::Model> whole;
  std::shared_ptr<model::Model> rest;
  std::map<std::string, std::shared_ptr<model::Model>> links;
};

SplitModel Split(const std::shared_ptr<const model::Model>& whole,
                 const std::set<std::string>& moving) {
  SplitModel split{whole, std::make_shared<model::Model>(*whole), {}};
  split.rest->links.clear();
  for (const model::Link& link : whole->links) {
    if (!moving.contains(link.name)) {
      split.rest->links.push_back(link);
      continue;
    }
    auto alone = std::make_shared<model::Model>();
    alone->name = whole->name;
    alone->links.push_back(link);
    alone->links[0].model_from_link = {};
    split.links[link.name] = std::move(alone);
  }
  if (split.rest->links.empty()) split.rest->links.resize(1);
  return split;
}

}  // namespace

class DrawnScene::Reader {
 public:
  Reader(const SceneJson& json, const FindModel& find_model)
      : bodies_json_(ListOf(json, "bodies")), poses_json_(ListOf(json, "poses")) {
    ReadMovingLinks();
    for (std::size_t i = 0; i < bodies_json_.size(); ++i) AddBody(i, find_model);
    scene_.layout_ =
        world::MakeLayout(static_cast<std::uint32_t>(NumberOf(MemberOf(json, "layout_version"), 0)),
                          std::move(bodies_), DescriptionOf(json));
    scene_.state_ = world::InitialState(*scene_.layout_);
    for (const SceneJson& pose : poses_json_) scene_.bodies_of_poses_.push_back(BodyOf(pose));
  }

  DrawnScene Take() { return std::move(scene_); }

 private:
  // Returns the index of the pose's body in the JSON, or nullopt.
  std::optional<std::size_t> IndexIn(const SceneJson& pose) const {
    const SceneJson& body = MemberOf(pose, "body");
    if (!body.is_number_unsigned() || body.get<std::uint64_t>() >= bodies_json_.size()) {
      return std::nullopt;
    }
    return body.get<std::size_t>();
  }

  void ReadMovingLinks() {
    moving_.resize(bodies_json_.size());
    for (const SceneJson& pose : poses_json_) {
      const auto index = IndexIn(pose);
      if (index && MemberOf(pose, "link").is_string()) {
        moving_[*index].insert(TextOf(pose, "link"));
      }
    }
  }

  void AddBody(std::size_t index, const FindModel& find_model) {
    const SceneJson& json = bodies_json_[index];
    const std::string name = TextOf(json, "name");
    const auto model = find_model(TextOf(json, "model"));
    if (name.empty() || model == nullptr || !names_.insert(name).second) return;
    const SplitModel split = SplitOf(model, moving_[index]);
    const Pose world_from_body = PoseOf(MemberOf(json, "pose"));
    Add(name, split.rest, world_from_body,
        FlagOf(json, "is_static", false) ? world::BodyKind::kStatic : world::BodyKind::kUnmoved);
    for (const auto& [link, alone] : split.links) {
      const int at = LinkNamed(*model, link);
      Add(NameOfLink(name, link), alone,
          world_from_body * model->links[static_cast<std::size_t>(at)].model_from_link,
          world::BodyKind::kUnmoved);
    }
    for (const SceneJson& sensor : ListOf(json, "sensors")) AddSensor(name, *model, index, sensor);
  }

  void Add(const std::string& name, std::shared_ptr<const model::Model> model, const Pose& pose,
           world::BodyKind kind) {
    world::Body body;
    body.name = name;
    body.model = std::move(model);
    body.initial_pose = pose;
    body.kind = kind;
    bodies_.push_back(std::move(body));
  }

  const SplitModel& SplitOf(const std::shared_ptr<const model::Model>& model,
                            const std::set<std::string>& moving) {
    auto& split = splits_[{model.get(), moving}];
    if (split.whole == nullptr) split = Split(model, moving);
    return split;
  }

  void AddSensor(const std::string& robot, const model::Model& model, std::size_t index,
                 const SceneJson& json) {
    const std::string link = TextOf(json, "link");
    const int at = LinkNamed(model, link);
    if (at < 0 || !MemberOf(json, "pose").is_array()) return;
    DrawnScene::Camera camera;
    camera.horizontal_fov = NumberOf(MemberOf(json, "horizontal_fov_rad"), 0);
    const Pose link_from_sensor = PoseOf(MemberOf(json, "pose"));
    const bool is_moving = moving_[index].contains(link);
    camera.body = is_moving ? NameOfLink(robot, link) : robot;
    camera.body_from_sensor =
        is_moving ? link_from_sensor
                  : model.links[static_cast<std::size_t>(at)].model_from_link * link_from_sensor;
    scene_.sensors_[{robot, TextOf(json, "name")}] = camera;
  }

  int BodyOf(const SceneJson& pose) const {
    const auto index = IndexIn(pose);
    if (!index) return -1;
    const std::string body = TextOf(bodies_json_[*index], "name");
    const SceneJson& link = MemberOf(pose, "link");
    return scene_.layout_->Find(link.is_string() ? NameOfLink(body, link.get<std::string>())
                                                 : body);
  }

  const SceneJson& bodies_json_;
  const SceneJson& poses_json_;
  // Names of the moving links of each body, in the order of the scene's bodies.
  std::vector<std::set<std::string>> moving_;
  std::map<std::pair<const model::Model*, std::set<std::string>>, SplitModel> splits_;
  std::set<std::string> names_;
  std::vector<world::Body> bodies_;
  DrawnScene scene_;
};

base::Result<DrawnScene> DrawnScene::Make(std::string_view json, const FindModel& find_model) {
  const SceneJson scene = SceneJson::parse(json, nullptr, false);
  if (!scene.is_object()) {
    return base::Fail(base::ErrorCode::kCorrupt, "the scene cannot be read: it is not JSON",
                      "scene.json");
  }
  return Reader(scene, find_model).Take();
}

std::shared_ptr<const world::Snapshot> DrawnScene::At(
    const messages::gsv_msgs::Poses& poses) const {
  auto snapshot = std::make_shared<world::Snapshot>();
  snapshot->layout = layout_;
  snapshot->state = state_;
  snapshot->state.step = static_cast<std::int64_t>(poses.step);
  const std::size_t count = std::min(bodies_of_poses_.size(), poses.poses.size() / 7);
  for (std::size_t i = 0; i < count; ++i) {
    if (bodies_of_poses_[i] < 0) continue;
    const double* p = &poses.poses[7 * i];
    const Pose pose{{p[0], p[1], p[2]}, geometry::Normalized({p[6], p[3], p[4], p[5]})};
    if (!geometry::IsFinite(pose)) continue;
    snapshot->state.bodies[static_cast<std::size_t>(bodies_of_poses_[i])].world_from_model = pose;
  }
  return snapshot;
}

SceneLookup DrawnScene::LookupAt(const world::Snapshot& snapshot) const {
  const auto pose = [&snapshot](const std::string& body) -> std::optional<Pose> {
    const int index = snapshot.layout->Find(body);
    if (index < 0) return std::nullopt;
    return snapshot.state.bodies[static_cast<std::size_t>(index)].world_from_model;
  };
  const auto sensor = [this, pose](const std::string& robot,
                                   const std::string& name) -> base::Result<SensorView> {
    const auto found = sensors_.find({robot, name});
    const auto world_from_body = found == sensors_.end() ? std::nullopt : pose(found->second.body);
    if (!world_from_body || found->second.horizontal_fov <= 0) {
      return base::Fail(base::ErrorCode::kNotFound,
                        "the recording has no camera '" + robot + "/" + name +
                            "', or it was recorded before GSV recorded the poses of cameras");
    }
    return SensorView{*world_from_body * found->second.body_from_sensor,
                      found->second.horizontal_fov};
  };
  const auto corners = [this] {
    world::Snapshot first;
    first.layout = layout_;
    first.state = state_;
    return CornersToShow(first);
  };
  return {pose, sensor, corners};
}

}  // namespace gsv::view
