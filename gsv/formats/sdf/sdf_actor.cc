#include "gsv/formats/sdf/sdf_actor.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "gsv/base/sorting.h"
#include "gsv/formats/sdf/sdf_xml.h"
#include "gsv/formats/sdf/world_frames.h"

namespace gsv::formats {
namespace {

using base::SimTime;
using geometry::Pose;
using geometry::Vector3;
using tinyxml2::XMLElement;

constexpr double kMaxScriptTime = 1e8;  // maximum time in a script, s
constexpr int kFreedoms = 6;  // number of joints of a bone, one for each degree of freedom

std::string TextOf(const XMLElement* element) {
  return element == nullptr || element->GetText() == nullptr ? "" : element->GetText();
}

std::string TextOf(const XMLElement& parent, const char* child) {
  return TextOf(parent.FirstChildElement(child));
}

// Reads the elements of one actor.
class ActorReader {
 public:
  ActorReader(XMLElement& actor, const ReadingContext& context)
      : actor_(actor), context_(context) {}

  ActorParts Read() {
    ReadAnimations();
    auto script = std::make_shared<model::Script>(ReadScript());
    AddSkin(model::StartPose(*script));
    for (const char* part : {"skin", "animation", "script"}) {
      while (XMLElement* element = actor_.FirstChildElement(part)) actor_.DeleteChild(element);
    }
    actor_.SetName("model");
    return {std::move(script), std::move(skin_)};
  }

 private:
  std::string Place(const XMLElement& element) const { return PlaceOf(context_.source, element); }

  // Returns a number between 0 and the maximum length of a script. For any other value, adds a
  // problem and returns `otherwise`.
  double NumberOf(const XMLElement& parent, const char* name, double otherwise) const {
    const XMLElement* element = parent.FirstChildElement(name);
    if (element == nullptr) return otherwise;
    double value = 0;
    if (element->QueryDoubleText(&value) == tinyxml2::XML_SUCCESS && value >= 0 &&
        value <= kMaxScriptTime) {
      return value;
    }
    context_.Warn("<" + std::string(name) + "> must be a number from 0 to 1e8, found \"" +
                      TextOf(element) + "\"; " + std::to_string(otherwise) + " is used",
                  Place(*element));
    return otherwise;
  }

  static bool FlagOf(const XMLElement& parent, const char* name, bool otherwise) {
    const XMLElement* element = parent.FirstChildElement(name);
    return element == nullptr ? otherwise : element->BoolText(otherwise);
  }

  void ReadAnimations() {
    for (auto* animation = actor_.FirstChildElement("animation"); animation != nullptr;
         animation = animation->NextSiblingElement("animation")) {
      const char* name = animation->Attribute("name");
      follows_way_[name == nullptr ? "" : name] = FlagOf(*animation, "interpolate_x", false);
    }
  }

  model::Script ReadScript() const {
    model::Script script;
    const XMLElement* element = actor_.FirstChildElement("script");
    if (element == nullptr) {
      script.starts_by_itself = false;
      return script;
    }
    script.loops = FlagOf(*element, "loop", true);
    script.delay = base::FromSeconds(NumberOf(*element, "delay_start", 0));
    script.starts_by_itself = FlagOf(*element, "auto_start", true);
    if (!script.starts_by_itself) {
      context_.Warn(
          "<auto_start> is false, and nothing else starts the script: the actor stands still",
          Place(*element));
    }
    std::vector<std::pair<int, model::Trajectory>> trajectories;
    for (auto* child = element->FirstChildElement("trajectory"); child != nullptr;
         child = child->NextSiblingElement("trajectory")) {
      model::Trajectory trajectory = ReadTrajectory(*child);
      if (trajectory.waypoints.empty()) continue;
      trajectories.emplace_back(child->IntAttribute("id"), std::move(trajectory));
    }
    base::Sort(trajectories, [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& each : trajectories) script.trajectories.push_back(std::move(each.second));
    return script;
  }

  model::Trajectory ReadTrajectory(const XMLElement& element) const {
    model::Trajectory trajectory;
    trajectory.tension = element.DoubleAttribute("tension", 0);
    if (!(trajectory.tension >= 0 && trajectory.tension <= 1)) {
      context_.Warn("the tension must lie between 0 and 1; 0 is used", Place(element));
      trajectory.tension = 0;
    }
    const char* type = element.Attribute("type");
    const auto animation = follows_way_.find(type == nullptr ? "" : type);
    trajectory.animated_by_distance = animation != follows_way_.end() && animation->second;
    if (animation == follows_way_.end() && !follows_way_.empty()) {
      context_.Warn("the type \"" + std::string(type == nullptr ? "" : type) +
                        "\" of the trajectory names no <animation> of the actor",
                    Place(element));
    }
    // If two waypoints have the same time, the later one in the file is used, as in Gazebo.
    std::map<SimTime, Pose> waypoints;
    for (auto* child = element.FirstChildElement("waypoint"); child != nullptr;
         child = child->NextSiblingElement("waypoint")) {
      for (const char* part : {"time", "pose"}) {
        if (child->FirstChildElement(part) == nullptr) {
          context_.Warn("a <waypoint> has no <" + std::string(part) + ">; 0 is used",
                        Place(*child));
        }
      }
      auto pose = ReadPose(*child);
      if (!pose) {
        context_.Warn("the waypoint is ignored: " + pose.error().message, Place(*child));
        continue;
      }
      waypoints[base::FromSeconds(NumberOf(*child, "time", 0))] = pose->pose;
    }
    if (!waypoints.empty()) waypoints.emplace(SimTime{0}, waypoints.begin()->second);
    for (const auto& [time, pose] : waypoints) trajectory.waypoints.push_back({time, pose});
    return trajectory;
  }

  XMLElement& FirstLink() {
    if (XMLElement* link = actor_.FirstChildElement("link")) return *link;
    XMLElement* link = actor_.InsertNewChildElement("link");
    link->SetAttribute("name", "link");
    return *link;
  }

  void AddSkin(const Pose& start) {
    const XMLElement* skin = actor_.FirstChildElement("skin");
    const std::string file = skin == nullptr ? "" : TextOf(*skin, "filename");
    if (file.empty()) {
      const bool has_parts = actor_.FirstChildElement("link") != nullptr ||
                             actor_.FirstChildElement("include") != nullptr;
      if (!has_parts) AddFigure(start);
      return;
    }
    const auto found = context_.finder.Find(file, context_.source);
    if (!found) {
      context_.Warn("the skin " + file +
                        " is not found: the actor is shown as a simple figure. Use --model-path",
                    Place(*skin));
      AddFigure(start);
      return;
    }
    const double scale = std::max(1e-6, NumberOf(*skin, "scale", 1));
    if (const XMLElement* animation = AnimationToShow()) {
      if (ReadSkin(*animation, *found, scale)) return;
    }
    XMLElement* visual = FirstLink().InsertNewChildElement("visual");
    visual->SetAttribute("name", "skin");
    XMLElement* mesh = visual->InsertNewChildElement("geometry")->InsertNewChildElement("mesh");
    mesh->InsertNewChildElement("uri")->SetText(file.c_str());
    const std::string number = std::to_string(scale);
    mesh->InsertNewChildElement("scale")->SetText((number + " " + number + " " + number).c_str());
  }

  // Returns the animation whose name is the type of the first trajectory, or else the first
  // animation. Returns null if the actor has no animation.
  const XMLElement* AnimationToShow() const {
    const XMLElement* script = actor_.FirstChildElement("script");
    const XMLElement* trajectory =
        script == nullptr ? nullptr : script->FirstChildElement("trajectory");
    const char* type = trajectory == nullptr ? nullptr : trajectory->Attribute("type");
    const XMLElement* chosen = actor_.FirstChildElement("animation");
    for (auto* each = chosen; each != nullptr; each = each->NextSiblingElement("animation")) {
      const char* name = each->Attribute("name");
      if (type != nullptr && name != nullptr && std::string(type) == name) {
        chosen = each;
        break;
      }
    }
    for (auto* each = actor_.FirstChildElement("animation"); each != nullptr;
         each = each->NextSiblingElement("animation")) {
      if (each == chosen) continue;
      context_.Warn("GSV plays one animation per actor; this one is ignored", Place(*each));
    }
    return chosen;
  }

  // Returns false, with a warning, if the skin is not animated.
  bool ReadSkin(const XMLElement& animation, const std::filesystem::path& skin, double scale) {
    const auto refuse = [&](const std::string& why) {
      context_.Warn("the animation is not supported, and the skin keeps its shape: " + why,
                    Place(animation));
      return false;
    };
    std::filesystem::path motion = skin;
    const std::string file = TextOf(animation, "filename");
    if (!file.empty()) {
      const auto found = context_.finder.Find(file, context_.source);
      if (!found) return refuse(found.error().message);
      motion = *found;
    }
    auto mesh =
        ReadSkinnedMesh(skin, motion, scale, context_.limits, context_.textures, context_.problems);
    if (!mesh) return refuse(mesh.error().message);
    skin_ = std::make_shared<const SkinnedMesh>(*std::move(mesh));
    (void)FirstLink();
    return true;
  }

  // Adds a simple figure: a cylinder with a head, 1.75 m tall. Skins such as Gazebo's have their
  // origin in the hip, and their waypoints are at the hip's height. If the first waypoint is at
  // such a height (0.5 m to 1.5 m), the figure's feet are this height below its origin.
  void AddFigure(const Pose& start) {
    const double height = start.position.z;
    const double feet = height > 0.5 && height < 1.5 ? -height : 0;
    XMLElement& link = FirstLink();
    AddShape(link, "body", "<cylinder><radius>0.22</radius><length>1.45</length></cylinder>",
             feet + 0.725, "0.16 0.4 0.6 1");
    AddShape(link, "head", "<sphere><radius>0.15</radius></sphere>", feet + 1.6, "0.87 0.7 0.57 1");
  }

  static void AddShape(XMLElement& link, const char* name, const char* shape, double z,
                       const char* colour) {
    char text[512];
    std::snprintf(text, sizeof text,
                  "<visual name='%s'><pose>0 0 %.6f 0 0 0</pose><geometry>%s</geometry>"
                  "<material><ambient>%s</ambient><diffuse>%s</diffuse></material></visual>",
                  name, z, shape, colour, colour);
    tinyxml2::XMLDocument document;
    document.Parse(text);
    link.InsertEndChild(document.RootElement()->DeepClone(link.GetDocument()));
  }

  XMLElement& actor_;
  const ReadingContext& context_;
  std::map<std::string, bool> follows_way_;  // value of interpolate_x, by the name of the animation
  std::shared_ptr<const SkinnedMesh> skin_;
};

// Attaches a bone's triangles to the first link, with prismatic joints along x, y and z and
// revolute joints about z, y and x.
void AddBone(const SkinnedMesh& skin, const SkinnedMesh::Bone& bone, model::Model& actor) {
  struct Freedom {
    const char* name;
    model::JointKind kind;
    Vector3 axis;
  };
  static constexpr std::array<Freedom, kFreedoms> kJoints{
      {{"x", model::JointKind::kPrismatic, {1, 0, 0}},
       {"y", model::JointKind::kPrismatic, {0, 1, 0}},
       {"z", model::JointKind::kPrismatic, {0, 0, 1}},
       {"yaw", model::JointKind::kContinuous, {0, 0, 1}},
       {"pitch", model::JointKind::kContinuous, {0, 1, 0}},
       {"roll", model::JointKind::kContinuous, {1, 0, 0}}}};
  int parent = 0;
  for (const Freedom& freedom : kJoints) {
    model::Joint joint;
    joint.name = bone.name + "_" + freedom.name;
    joint.kind = freedom.kind;
    joint.axis = freedom.axis;
    joint.parent = parent;
    joint.child = parent = static_cast<int>(actor.links.size());
    actor.joints.push_back(std::move(joint));
    model::Link link;
    link.name = bone.name + "_" + freedom.name;
    actor.links.push_back(std::move(link));
  }
  model::Visual visual;
  visual.name = "skin";
  visual.shape = geometry::Mesh{bone.triangles, {1, 1, 1}};
  if (!skin.materials.empty()) visual.materials = skin.materials;
  actor.links.back().name = bone.name;
  actor.links.back().visuals.push_back(std::move(visual));
}

// Returns the z coordinate of the lowest vertex of all bones, in the skin's frame, at the first
// frame.
double LowestOf(const SkinnedMesh& skin) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const SkinnedMesh::Bone& bone : skin.bones) {
    for (const Vector3& position : bone.triangles->positions) {
      lowest = std::min(lowest, (bone.skin_from_bone[0] * position).z);
    }
  }
  return lowest;
}

// Returns the animation of the joints. If the actor has a trajectory, the motion of the root bone
// is subtracted from all bones, so that the root bone stays at the actor's origin. But for skins
// with their origin at the feet, z must not be subtracted. So z is kept if the feet are then nearer
// to the ground (the world's z = 0) than without it.
std::shared_ptr<const model::Animation> AnimationOf(const SkinnedMesh& skin,
                                                    const model::Script& script, int first_joint) {
  const bool follows = !script.trajectories.empty();
  const double feet = model::StartPose(script).position.z + LowestOf(skin);
  const bool keeps_height = std::abs(feet) <= std::abs(feet - skin.root[0].z);
  auto animation = std::make_shared<model::Animation>();
  animation->length = base::FromSeconds(skin.length);
  const Vector3 covered = skin.root.back() - skin.root.front();
  const auto frames = static_cast<double>(skin.root.size());
  animation->distance = std::hypot(covered.x, covered.y) * frames / (frames - 1);
  animation->joint_count = first_joint + kFreedoms * static_cast<int>(skin.bones.size());
  for (std::size_t f = 0; f < skin.root.size(); ++f) {
    animation->positions.insert(animation->positions.end(), static_cast<std::size_t>(first_joint),
                                0.0);
    Vector3 shift = follows ? skin.root[f] : Vector3{};
    if (keeps_height) shift.z = 0;
    for (const SkinnedMesh::Bone& bone : skin.bones) {
      const Vector3 p = bone.skin_from_bone[f].position - shift;
      const auto angles = geometry::ToRollPitchYaw(bone.skin_from_bone[f].orientation);
      animation->positions.insert(animation->positions.end(),
                                  {p.x, p.y, p.z, angles.yaw, angles.pitch, angles.roll});
    }
  }
  return animation;
}

// Sets `bounds` to the box around all visuals, in the model's frame. Returns false if there are no
// visuals.
bool BoundsOfVisuals(const model::Model& model, geometry::Bounds& bounds) {
  bool any = false;
  for (const model::Link& link : model.links) {
    for (const model::Visual& visual : link.visuals) {
      if (std::holds_alternative<geometry::Plane>(visual.shape)) continue;
      const geometry::Bounds own = geometry::BoundsOf(visual.shape);
      const Pose pose = link.model_from_link * visual.link_from_visual;
      for (int corner = 0; corner < 8; ++corner) {
        const Vector3 p = pose * Vector3{(corner & 1) != 0 ? own.max.x : own.min.x,
                                         (corner & 2) != 0 ? own.max.y : own.min.y,
                                         (corner & 4) != 0 ? own.max.z : own.min.z};
        if (!any) bounds = {p, p};
        any = true;
        bounds.min = {std::min(bounds.min.x, p.x), std::min(bounds.min.y, p.y),
                      std::min(bounds.min.z, p.z)};
        bounds.max = {std::max(bounds.max.x, p.x), std::max(bounds.max.y, p.y),
                      std::max(bounds.max.z, p.z)};
      }
    }
  }
  return any;
}

// Extends `bounds` by the skin at its first frame.
void Include(const SkinnedMesh& skin, const model::Animation& animation, int first_joint, bool& any,
             geometry::Bounds& bounds) {
  for (std::size_t b = 0; b < skin.bones.size(); ++b) {
    const double* q = animation.positions.data() + first_joint + kFreedoms * static_cast<int>(b);
    const Pose pose{{q[0], q[1], q[2]}, geometry::FromRollPitchYaw({q[5], q[4], q[3]})};
    for (const Vector3& position : skin.bones[b].triangles->positions) {
      const Vector3 p = pose * position;
      if (!any) bounds = {p, p};
      any = true;
      bounds.min = {std::min(bounds.min.x, p.x), std::min(bounds.min.y, p.y),
                    std::min(bounds.min.z, p.z)};
      bounds.max = {std::max(bounds.max.x, p.x), std::max(bounds.max.y, p.y),
                    std::max(bounds.max.z, p.z)};
    }
  }
}

}  // namespace

ActorParts MakeModelOfActor(XMLElement& actor, const ReadingContext& context) {
  return ActorReader(actor, context).Read();
}

std::shared_ptr<const model::Model> ActorOf(const model::Model& model, const ActorParts& parts) {
  auto actor = std::make_shared<model::Model>(model);
  geometry::Bounds bounds;
  bool is_seen = BoundsOfVisuals(model, bounds);
  if (parts.skin != nullptr) {
    auto script = std::make_shared<model::Script>(*parts.script);
    const auto first_joint = static_cast<int>(actor->joints.size());
    script->animation = AnimationOf(*parts.skin, *script, first_joint);
    for (const SkinnedMesh::Bone& bone : parts.skin->bones) AddBone(*parts.skin, bone, *actor);
    Include(*parts.skin, *script->animation, first_joint, is_seen, bounds);
    actor->script = std::move(script);
  } else {
    actor->script = parts.script;
  }
  const bool collides =
      std::any_of(model.links.begin(), model.links.end(),
                  [](const model::Link& link) { return !link.collisions.empty(); });
  if (collides || !is_seen) return actor;
  const Vector3 size = bounds.max - bounds.min;
  const double radius = std::min(size.x, size.y) / 2;
  if (!(radius > 1e-3) || !(size.z > 1e-3)) return actor;
  model::Link& link = actor->links[0];
  model::Collision collision;
  collision.name = "around";
  collision.shape = geometry::Cylinder{radius, size.z};
  collision.link_from_collision =
      Inverse(link.model_from_link) * Pose{(bounds.min + bounds.max) * 0.5, {}};
  link.collisions.push_back(std::move(collision));
  return actor;
}

}  // namespace gsv::formats
