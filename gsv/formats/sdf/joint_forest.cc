#include "gsv/formats/sdf/joint_forest.h"

#include <algorithm>
#include <utility>

namespace gsv::formats {
namespace {

using model::Joint;

void Reverse(Joint& joint) {
  std::swap(joint.parent, joint.child);
  joint.axis = -joint.axis;
}

class Forest {
 public:
  Forest(std::size_t links, std::vector<Joint>& joints)
      : joints_(joints), joint_above_(links, kNone) {}

  // Adds a joint. Returns false if it closes a loop.
  bool Add(std::size_t index) {
    Joint& joint = joints_[index];
    if (joint.parent >= 0 && RootOf(joint.parent) == RootOf(joint.child)) return false;
    if (joint_above_[Link(joint.child)] != kNone) {
      const bool parent_can_hang = joint.parent >= 0 && !HangsFromWorld(joint.parent);
      const bool child_can_hang = !HangsFromWorld(joint.child);
      if (parent_can_hang) {
        MakeRoot(joint.parent);
        Reverse(joint);
      } else if (child_can_hang) {
        MakeRoot(joint.child);
      } else {
        return false;
      }
    }
    joint_above_[Link(joint.child)] = index;
    return true;
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  static std::size_t Link(int link) { return static_cast<std::size_t>(link); }

  int ParentOf(int link) const {
    const std::size_t joint = joint_above_[Link(link)];
    return joint == kNone ? -2 : joints_[joint].parent;
  }

  int RootOf(int link) const {
    while (ParentOf(link) >= 0) link = ParentOf(link);
    return link;
  }

  bool HangsFromWorld(int link) const { return ParentOf(RootOf(link)) == -1; }

  // Reverses every joint between the link and its root.
  void MakeRoot(int link) {
    std::size_t joint = std::exchange(joint_above_[Link(link)], kNone);
    while (joint != kNone) {
      const int above = joints_[joint].parent;
      const std::size_t next = std::exchange(joint_above_[Link(above)], joint);
      Reverse(joints_[joint]);
      joint = next;
    }
  }

  std::vector<Joint>& joints_;
  std::vector<std::size_t> joint_above_;
};

}  // namespace

std::vector<Joint> MakeForest(std::size_t links, std::vector<Joint>& joints) {
  Forest forest(links, joints);
  std::vector<Joint> loops;
  for (std::size_t i = 0; i < joints.size(); ++i) {
    if (forest.Add(i)) continue;
    loops.push_back(joints[i]);
    joints[i].child = -1;
  }
  std::erase_if(joints, [](const Joint& joint) { return joint.child < 0; });
  return loops;
}

}  // namespace gsv::formats
