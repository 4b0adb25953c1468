#include "gsv/formats/sdf/sdf_model.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include <sdf/Element.hh>
#include <sdf/Frame.hh>
#include <sdf/Joint.hh>
#include <sdf/Link.hh>
#include <sdf/SemanticPose.hh>

#include "gsv/formats/sdf/joint_forest.h"
#include "gsv/formats/sdf/sdf_classic_control.h"
#include "gsv/formats/sdf/sdf_document.h"
#include "gsv/formats/sdf/sdf_drive.h"
#include "gsv/formats/sdf/sdf_gearbox.h"
#include "gsv/formats/sdf/sdf_joint.h"
#include "gsv/formats/sdf/sdf_joint_target.h"
#include "gsv/formats/sdf/sdf_link.h"
#include "gsv/formats/sdf/sdf_sensor.h"
#include "gsv/formats/sdf/sdf_slip.h"
#include "gsv/model/collision_names.h"

namespace gsv::formats {
namespace {

using base::ErrorCode;
using geometry::Pose;
using model::Joint;
using model::Model;

constexpr int kMaxNestingDepth = 32;

class ModelReader {
 public:
  explicit ModelReader(const ReadingContext& context) : context_(context) {}

  base::Result<FramedModel> Read(const sdf::Model& source) {
    model_.name = source.Name();
    model_.source = context_.source.string();
    model_.is_static = source.Static();
    AddParts(source, "", Pose{}, kMaxNestingDepth, false);
    if (model_.links.empty()) {
      return Fail(ErrorCode::kBadModel, "the model \"" + source.Name() + "\" has no links",
                  context_.source.string());
    }
    PutFirst(source.CanonicalLinkAndRelativeName().second);
    for (const auto& [joint, scope, place] : pending_joints_) AddJoint(*joint, scope, place);
    FixStaticLinks();
    KeepLoops(MakeForest(model_.links.size(), model_.joints));
    for (const Gearbox& each : gearboxes_) {
      CoupleGearbox(*each.source, each.joint, each.reference, each.place, context_, model_);
    }
    for (const auto& [sensor, scope] : pending_sensors_) AddSensor(sensor, scope);
    for (const auto& [plugin, scope] : pending_plugins_) {
      AddDrive(plugin, scope);
      ReadJointTargets(plugin, scope, context_, model_);
      ReadClassicControl(plugin, scope, context_, model_);
      ReadWheelSlip(plugin, scope, context_, model_);
    }
    ReadMovement(source.Element());
    ReadSlipOfDrive(source.Element());
    SetDefaultPose(source);
    model_.has_placement_frame = !source.PlacementFrameName().empty();
    FramedModel result;
    result.placement_frame = source.PlacementFrameName();
    result.model = std::make_shared<const Model>(std::move(model_));
    result.model_from_frame = std::move(frames_);
    return result;
  }

 private:
  std::string PlaceOfElement(const sdf::ElementPtr& element) const {
    return element == nullptr ? context_.source.string() : PlaceOf(*element, context_.source);
  }

  // Adds links, frames and nested models. Elements that refer to links are added later, when all
  // links exist.
  void AddParts(const sdf::Model& source, const std::string& scope, const Pose& root_from_model,
                int levels_left, bool is_in_static) {
    if (levels_left == 0) {
      context_.Warn("models are nested deeper than 32 levels; this model is ignored",
                    PlaceOfElement(source.Element()));
      return;
    }
    const bool is_static = is_in_static || source.Static();
    for (std::uint64_t i = 0; i < source.LinkCount(); ++i) {
      AddLink(*source.LinkByIndex(i), scope, root_from_model, is_static);
    }
    for (std::uint64_t i = 0; i < source.FrameCount(); ++i) {
      const sdf::Frame& frame = *source.FrameByIndex(i);
      frames_[scope + frame.Name()] =
          root_from_model *
          Resolve(frame.SemanticPose(), "__model__", PlaceOfElement(frame.Element()), context_);
    }
    for (std::uint64_t i = 0; i < source.JointCount(); ++i) {
      const sdf::Joint& joint = *source.JointByIndex(i);
      const std::string place = PlaceOfElement(joint.Element());
      const Pose root_from_joint =
          root_from_model * Resolve(joint.SemanticPose(), "__model__", place, context_);
      frames_[scope + joint.Name()] = root_from_joint;
      pending_joints_.push_back({&joint, scope, place});
      CollectSensors(joint.Element(), scope + joint.Name());
    }
    for (std::uint64_t i = 0; i < source.ModelCount(); ++i) {
      const sdf::Model& inner = *source.ModelByIndex(i);
      const Pose root_from_inner =
          root_from_model *
          Resolve(inner.SemanticPose(), "__model__", PlaceOfElement(inner.Element()), context_);
      frames_[scope + inner.Name()] = root_from_inner;
      if (inner.LinkCount() == 0 && inner.ModelCount() == 0) {
        context_.Warn("the model \"" + inner.Name() + "\" has no links; it is ignored",
                      PlaceOfElement(inner.Element()));
      }
      AddParts(inner, scope + inner.Name() + "::", root_from_inner, levels_left - 1, is_static);
    }
    if (source.Element() == nullptr || !source.Element()->HasElement("plugin")) return;
    for (auto plugin = source.Element()->GetElement("plugin"); plugin != nullptr;
         plugin = plugin->GetNextElement("plugin")) {
      pending_plugins_.emplace_back(plugin, scope);
    }
  }

  void AddLink(const sdf::Link& source, const std::string& scope, const Pose& root_from_model,
               bool is_static) {
    model::Link link = ReadLink(source, is_static, context_);
    link.name = scope + source.Name();
    if (is_static) static_links_.insert(link.name);
    link.model_from_link = root_from_model * Resolve(source.SemanticPose(), "__model__",
                                                     PlaceOfElement(source.Element()), context_);
    frames_[link.name] = link.model_from_link;
    CollectSensors(source.Element(), link.name);
    model_.links.push_back(std::move(link));
  }

  void CollectSensors(const sdf::ElementPtr& owner, const std::string& frame) {
    if (owner == nullptr || !owner->HasElement("sensor")) return;
    for (auto sensor = owner->GetElement("sensor"); sensor != nullptr;
         sensor = sensor->GetNextElement("sensor")) {
      pending_sensors_.emplace_back(sensor, frame);
    }
  }

  void PutFirst(const std::string& name) {
    const auto it = std::find_if(model_.links.begin(), model_.links.end(),
                                 [&](const model::Link& link) { return link.name == name; });
    if (it != model_.links.end()) std::rotate(model_.links.begin(), it, it + 1);
  }

  int LinkIndex(const std::string& name) const {
    const auto it = std::find_if(model_.links.begin(), model_.links.end(),
                                 [&](const model::Link& link) { return link.name == name; });
    return it == model_.links.end() ? -1 : static_cast<int>(it - model_.links.begin());
  }

  // Adds a joint. Each of its ends is a link, or a frame that is attached to a link.
  void AddJoint(const sdf::Joint& source, const std::string& scope, const std::string& place) {
    std::string parent, child;
    if (!source.ResolveParentLink(parent).empty()) parent = source.ParentLinkName();
    if (!source.ResolveChildLink(child).empty()) child = source.ChildLinkName();
    Joint joint;
    joint.name = scope + source.Name();
    joint.parent = parent == "world" ? -1 : LinkIndex(scope + parent);
    joint.child = LinkIndex(scope + child);
    if (joint.child < 0 || (joint.parent < 0 && parent != "world")) {
      context_.Warn(
          "the joint \"" + joint.name + "\" names a link that does not exist; it is ignored",
          place);
      return;
    }
    joint.model_from_joint = frames_[joint.name];
    joint_children_[joint.name] = joint.child;
    joint_places_[joint.name] = place;
    if (source.Type() == sdf::JointType::GEARBOX) {
      const auto reference = source.Element()->Get<std::string>("gearbox_reference_body", "").first;
      gearboxes_.push_back({&source, std::move(joint), LinkIndex(scope + reference), place});
      return;
    }
    formats::AddJoint(source, std::move(joint), place, context_, model_);
  }

  // Fixes the links of static nested models in the world, at their pose in this model.
  void FixStaticLinks() {
    if (model_.is_static || static_links_.empty()) return;
    if (static_links_.size() == model_.links.size()) {
      model_.is_static = true;
      return;
    }
    const auto is_static = [&](int link) {
      return link < 0 ||
             static_links_.count(model_.links[static_cast<std::size_t>(link)].name) != 0;
    };
    std::erase_if(model_.joints, [&](const Joint& joint) {
      return is_static(joint.parent) && is_static(joint.child);
    });
    std::vector<Joint> to_world;
    for (std::size_t i = 0; i < model_.links.size(); ++i) {
      if (!is_static(static_cast<int>(i))) continue;
      Joint joint;
      joint.name = model_.links[i].name + "::static";
      joint.kind = model::JointKind::kFixed;
      joint.parent = -1;
      joint.child = static_cast<int>(i);
      joint.model_from_joint = model_.links[i].model_from_link;
      to_world.push_back(std::move(joint));
    }
    model_.joints.insert(model_.joints.begin(), to_world.begin(), to_world.end());
  }

  // Stores the joints that close loops separately (Model::loop_joints), because the forest of
  // joints cannot contain them.
  void KeepLoops(std::vector<Joint> loops) {
    for (Joint& joint : loops) {
      // The name in the file. AddJoint() has split a joint with several axes into joints whose
      // names are NAME, NAME::axis2 and so on.
      const std::string written = joint.name.substr(0, joint.name.rfind("::axis"));
      const std::string name = "the joint \"" + written + "\" closes a loop";
      const auto& place = joint_places_[written];
      const bool has_limits =
          joint.kind != model::JointKind::kContinuous &&
          (std::isfinite(joint.position_limits.min) || std::isfinite(joint.position_limits.max));
      if (joint.kind == model::JointKind::kScrew || IsPartOfAChain(joint)) {
        context_.Warn(name + ", which only fixed, revolute and prismatic joints can; it is ignored",
                      place);
        continue;
      }
      if (has_limits || joint.damping > 0 || joint.friction > 0) {
        context_.Warn(name + "; its limits, damping and friction are left out", place);
      }
      model_.loop_joints.push_back(std::move(joint));
    }
  }

  // Whether this joint is a part of a ball or universal joint that was split (AddJoint()).
  bool IsPartOfAChain(const Joint& joint) const {
    const auto is_cross = [&](int link) {
      return link >= 0 &&
             model_.links[static_cast<std::size_t>(link)].name.find("::cross") != std::string::npos;
    };
    return joint.kind == model::JointKind::kBall || is_cross(joint.parent) || is_cross(joint.child);
  }

  // Whether the link hangs from the link `above`, or is `above` itself.
  bool IsBelow(int link, int above) const {
    while (link >= 0 && link != above) {
      const auto joint = std::find_if(model_.joints.begin(), model_.joints.end(),
                                      [&](const Joint& each) { return each.child == link; });
      link = joint == model_.joints.end() ? -1 : joint->parent;
    }
    return link == above;
  }

  // Warns about two kinds of sensors in a closed loop of joints. A sensor of the joint that closes
  // the loop cannot measure this joint. A force_torque sensor on another joint of the loop leaves
  // out the force of the closing joint (sensing/joint_wrench.h).
  void CheckLoop(const model::SensorDescription& sensor, const std::string& frame,
                 const std::string& place) const {
    const auto is_it = [&](const Joint& joint) { return joint.name == frame; };
    if (std::none_of(model_.loop_joints.begin(), model_.loop_joints.end(), is_it)) {
      if (sensor.type != "force_torque" && sensor.type != "forcetorque") return;
      for (const Joint& loop : model_.loop_joints) {
        if (IsBelow(loop.parent, sensor.link) == IsBelow(loop.child, sensor.link)) continue;
        context_.Warn(
            "the sensor \"" + sensor.name +
                "\" is on a joint of a closed loop; its readings leave out the force of \"" +
                loop.name + "\", the joint that closes the loop",
            place);
        return;
      }
      return;
    }
    context_.Warn("the sensor \"" + sensor.name +
                      "\" belongs to a joint that closes a loop; its readings are "
                      "those of the other joint of the child link",
                  place);
  }

  void Check(const model::SensorDescription& sensor, const std::string& place) const {
    if (!context_.check_sensor) return;
    const auto checked = context_.check_sensor(sensor);
    if (checked) return;
    const std::string sentence =
        "the " + sensor.type + " " + sensor.name + " gives no readings: " + checked.error().message;
    context_.Warn(sentence, place);
  }

  // Reports names of collisions that do not exist. A contact sensor with such a name would detect
  // nothing.
  void CheckCollisionNames(const model::SensorDescription& sensor, const std::string& place) const {
    if (sensor.type != "contact" && sensor.type != "bumper") return;
    for (const std::string& name : model::CollisionNamesOf(sensor)) {
      if (model::FindCollision(model_, sensor.link, name)) continue;
      context_.Warn("the contact sensor " + sensor.name + " names the collision \"" + name +
                        "\", which the model does not have; it detects no contacts there",
                    place);
    }
  }

  // Adds a sensor. `frame` is the link or joint that has the sensor; the sensor of a joint is on
  // its child link.
  void AddSensor(const sdf::ElementPtr& element, const std::string& frame) {
    model::SensorDescription sensor = ReadSensor(element);
    const std::string place = PlaceOfElement(element);
    Pose model_from_owner = frames_[frame];
    sensor.link = LinkIndex(frame);
    if (sensor.link < 0) {
      const auto joint = joint_children_.find(frame);
      if (joint == joint_children_.end()) return;
      sensor.link = joint->second;
    }
    const Pose owner_from_sensor = PoseOfSensor(element, frame, place, model_from_owner);
    const auto link = static_cast<std::size_t>(sensor.link);
    sensor.link_from_sensor = geometry::Inverse(model_.links[link].model_from_link) *
                              model_from_owner * owner_from_sensor;
    const bool is_rate = sensor.update_rate >= 1e-6 && sensor.update_rate <= 1e6;
    if (sensor.update_rate != 0 && !is_rate) {
      context_.Warn("a sensor's update rate must be 0 or lie between 1e-6 and 1e6 Hz; 0 is used",
                    place);
      sensor.update_rate = 0;
    }
    if (sensor.type.empty() || sensor.type == "__default__") {
      context_.Warn("the sensor has no type and is ignored", place);
      return;
    }
    sensor.name = UniqueSensorName(sensor.name, frame);
    CheckLoop(sensor, frame, place);
    Check(sensor, place);
    CheckCollisionNames(sensor, place);
    model_.sensors.push_back(std::move(sensor));
  }

  Pose PoseOfSensor(const sdf::ElementPtr& element, const std::string& frame,
                    const std::string& place, const Pose& model_from_owner) {
    if (!element->HasElement("pose")) return {};
    const sdf::ElementPtr pose = element->GetElement("pose");
    const Pose raw = FromIgnition(pose->Get<ignition::math::Pose3d>());
    if (!geometry::IsFinite(raw)) {
      context_.Warn("the sensor's pose is not finite; the link's pose is used", place);
      return {};
    }
    const auto relative_to = pose->Get<std::string>("relative_to", "").first;
    if (relative_to.empty()) return raw;
    const std::size_t scope_end = frame.rfind("::");
    const std::string scope = scope_end == std::string::npos ? "" : frame.substr(0, scope_end + 2);
    if (relative_to == "__model__") {
      const Pose model_from_scope =
          scope.empty() ? Pose{} : frames_[scope.substr(0, scope.size() - 2)];
      return geometry::Inverse(model_from_owner) * model_from_scope * raw;
    }
    const auto it = frames_.find(scope + relative_to);
    if (it == frames_.end()) {
      context_.Warn("the sensor's pose is relative to \"" + relative_to +
                        "\", which does not exist; it is treated as relative to its link",
                    place);
      return raw;
    }
    return geometry::Inverse(model_from_owner) * it->second * raw;
  }

  // Returns a unique name. If two links each have a "camera", the name of the second link becomes a
  // prefix of the second camera's name.
  std::string UniqueSensorName(const std::string& name, const std::string& owner) {
    if (sensor_names_.insert(name).second) return name;
    std::string unique = owner + "::" + name;
    for (int i = 2; !sensor_names_.insert(unique).second; ++i) {
      unique = owner + "::" + name + "_" + std::to_string(i);
    }
    return unique;
  }

  void AddDrive(const sdf::ElementPtr& plugin, const std::string& scope) {
    auto drive = ReadDrive(plugin, model_, scope, context_);
    if (!drive) return;
    if (model_.drive) {
      context_.Warn("the model has a second drive, which is ignored", PlaceOfElement(plugin));
      return;
    }
    model_.drive = std::move(drive);
  }

  // Reads an element of GSV: <gsv:movement>planar or rigid</gsv:movement>.
  void ReadMovement(const sdf::ElementPtr& element) {
    if (element == nullptr || !element->HasElement("gsv:movement")) return;
    const auto text = element->GetElement("gsv:movement")->Get<std::string>();
    if (text == "rigid") {
      model_.movement = model::Movement::kRigid;
    } else if (text != "planar") {
      context_.Warn("<gsv:movement> must be planar or rigid, not \"" + text + "\"",
                    PlaceOfElement(element));
    }
  }

  // Reads an element of GSV: <gsv:slip>, the slip of the drive's wheels.
  void ReadSlipOfDrive(const sdf::ElementPtr& element) {
    const model::Slip slip = ReadSlip(element, context_);
    if (slip.is_none()) return;
    if (model_.drive) {
      model_.drive->slip = slip;
    } else {
      context_.Warn("<gsv:slip> is ignored: the model has no drive whose wheels could slip",
                    PlaceOfElement(element));
    }
  }

  void SetDefaultPose(const sdf::Model& source) {
    model_.default_pose = FromIgnition(source.RawPose());
    const std::string& placement = source.PlacementFrameName();
    if (!placement.empty()) {
      const auto it = frames_.find(placement);
      if (it != frames_.end()) {
        model_.default_pose = model_.default_pose * geometry::Inverse(it->second);
      }
    }
    if (!geometry::IsFinite(model_.default_pose)) {
      context_.Warn("the model's pose is not finite; the origin is used",
                    PlaceOfElement(source.Element()));
      model_.default_pose = {};
    }
  }

  struct PendingJoint {
    const sdf::Joint* joint;
    std::string scope, place;
  };

  struct Gearbox {
    const sdf::Joint* source;
    Joint joint;
    int reference;  // index of <gearbox_reference_body>, or -1
    std::string place;
  };

  const ReadingContext& context_;
  Model model_;
  std::map<std::string, Pose> frames_;
  std::vector<PendingJoint> pending_joints_;
  std::vector<Gearbox> gearboxes_;
  std::map<std::string, int> joint_children_;  // link indices
  std::map<std::string, std::string> joint_places_;
  std::vector<std::pair<sdf::ElementPtr, std::string>> pending_sensors_;
  std::vector<std::pair<sdf::ElementPtr, std::string>> pending_plugins_;
  std::set<std::string> sensor_names_;
  // all links of this model if it is static, and of static models nested in it
  std::set<std::string> static_links_;
};

}  // namespace

base::Result<FramedModel> ReadModel(const sdf::Model& source, const ReadingContext& context) {
  return ModelReader(context).Read(source);
}

}  // namespace gsv::formats
