#include "gsv/formats/urdf/urdf_tree.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace gsv::formats {
namespace {

using geometry::Pose;
using model::JointKind;

// Frames are equal if they differ by less than this number, both in position (m) and in orientation
// (the vector part of the quaternion: the sine of half the angle, times the axis).
constexpr double kSameFrame = 1e-9;
constexpr const char* kWorldLink = "world";

bool IsIdentity(const Pose& pose) {
  const auto& [w, x, y, z] = pose.orientation;
  return Norm(pose.position) < kSameFrame &&
         std::max({std::abs(x), std::abs(y), std::abs(z)}) < kSameFrame;
}

bool Turns(JointKind kind) { return kind != JointKind::kFixed && kind != JointKind::kPrismatic; }

const char* UrdfType(const model::Joint& joint) {
  switch (joint.kind) {
    case JointKind::kFixed:
      return "fixed";
    case JointKind::kPrismatic:
      return "prismatic";
    case JointKind::kRevolute:
      return "revolute";
    case JointKind::kContinuous:
    case JointKind::kBall:
    case JointKind::kScrew:
      break;
  }
  return "continuous";
}

class TreeMaker {
 public:
  TreeMaker(const model::Model& model, base::Problems& problems)
      : model_(model), problems_(problems) {}

  UrdfTree Make() {
    std::vector<bool> has_parent(model_.links.size(), false);
    for (const model::Joint& joint : model_.joints) {
      has_parent[static_cast<std::size_t>(joint.child)] = true;
      if (joint.parent < 0) has_world_ = true;
    }
    if (has_world_) tree_.empty_links.emplace_back(kWorldLink);
    AddRoots(has_parent);
    for (const model::Joint& joint : model_.joints) Add(joint);
    return std::move(tree_);
  }

 private:
  const std::string& NameOfLink(int link) const {
    return model_.links[static_cast<std::size_t>(link)].name;
  }
  Pose FrameOf(int link) const {
    return link < 0 ? Pose{} : model_.links[static_cast<std::size_t>(link)].model_from_link;
  }
  bool HasLink(std::string_view name) const {
    return std::any_of(model_.links.begin(), model_.links.end(),
                       [&](const model::Link& link) { return link.name == name; });
  }
  void Warn(const std::string& message) {
    problems_.push_back({base::Problem::Severity::kWarning, message, model_.name});
  }

  // Selects the root. This is the link "world" if a joint connects a link to the world, else the
  // first link without a parent. If this first link's frame differs from the model's frame, adds a
  // root link at the model's frame, and fixes the first link to it. Every other link without a
  // parent gets a floating joint to the root.
  void AddRoots(const std::vector<bool>& has_parent) {
    std::string root = has_world_ ? kWorldLink : "";
    Pose model_from_root;
    for (std::size_t i = 0; i < model_.links.size(); ++i) {
      if (has_parent[i]) continue;
      const model::Link& link = model_.links[i];
      if (root.empty() && IsIdentity(link.model_from_link)) {
        root = link.name;
        continue;
      }
      const bool is_first = root.empty();
      if (is_first) {
        root = HasLink("base_link") ? "base_footprint" : "base_link";
        tree_.empty_links.push_back(root);
      } else if (!has_world_) {
        Warn("a URDF file has one tree: link " + link.name +
             ", which nothing connects, is attached by a floating joint");
      }
      tree_.joints.push_back({link.name + "_base",
                              is_first ? "fixed" : "floating",
                              root,
                              link.name,
                              Inverse(model_from_root) * link.model_from_link,
                              {1, 0, 0},
                              nullptr});
    }
  }

  void Add(const model::Joint& joint) {
    if (joint.kind == JointKind::kScrew)
      Warn("URDF has no screw joints: " + joint.name +
           " is written as a continuous joint, which does not slide");
    if (joint.kind == JointKind::kBall && joint.name.find("::axis") == std::string::npos) {
      Warn("URDF has no ball joints: " + joint.name + " is written as three continuous joints");
    }
    const Pose model_from_parent = FrameOf(joint.parent), model_from_child = FrameOf(joint.child);
    const std::string& parent = joint.parent < 0 ? kWorld : NameOfLink(joint.parent);
    const geometry::Vector3 axis_in_model = joint.model_from_joint.orientation * joint.axis;
    const geometry::Vector3 offset = model_from_child.position - joint.model_from_joint.position;
    const geometry::Vector3 beside = offset - Dot(offset, axis_in_model) * axis_in_model;
    const bool is_beside = Turns(joint.kind) && Norm(beside) > kSameFrame;
    const Pose model_from_joint = is_beside ? joint.model_from_joint : model_from_child;
    const std::string child = is_beside ? joint.name + "_frame" : NameOfLink(joint.child);
    tree_.joints.push_back({joint.name, UrdfType(joint), parent, child,
                            Inverse(model_from_parent) * model_from_joint,
                            Inverse(model_from_joint.orientation) * axis_in_model, &joint});
    if (!is_beside) return;
    tree_.empty_links.push_back(child);
    tree_.joints.push_back({joint.name + "_offset",
                            "fixed",
                            child,
                            NameOfLink(joint.child),
                            Inverse(model_from_joint) * model_from_child,
                            {1, 0, 0},
                            nullptr});
  }

  const model::Model& model_;
  base::Problems& problems_;
  const std::string kWorld = kWorldLink;
  bool has_world_ = false;
  UrdfTree tree_;
};

}  // namespace

UrdfTree MakeUrdfTree(const model::Model& model, base::Problems& problems) {
  return TreeMaker(model, problems).Make();
}

}  // namespace gsv::formats
