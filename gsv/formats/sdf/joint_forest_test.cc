#include "gsv/formats/sdf/joint_forest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gsv::formats {
namespace {

using model::Joint;
using testing::ElementsAre;
using testing::Field;
using testing::IsEmpty;

Joint Between(const char* name, int parent, int child) {
  Joint joint;
  joint.name = name;
  joint.parent = parent;
  joint.child = child;
  return joint;
}

TEST(JointForest, LeavesAForestUnchanged) {
  std::vector<Joint> joints = {Between("a", -1, 0), Between("b", 0, 1), Between("c", 0, 2)};
  EXPECT_THAT(MakeForest(3, joints), IsEmpty());
  EXPECT_EQ(joints[1].parent, 0);
  EXPECT_EQ(joints[2].child, 2);
  EXPECT_EQ(joints[1].axis, (geometry::Vector3{0, 0, 1}));
}

// The joints are 0 -> 1 <- 2. The second joint is reversed together with its axis, so that its
// position stays the same.
TEST(JointForest, ReversesAJointIfALinkHasTwoParents) {
  std::vector<Joint> joints = {Between("a", 0, 1), Between("b", 2, 1)};
  EXPECT_THAT(MakeForest(3, joints), IsEmpty());
  EXPECT_EQ(joints[1].parent, 1);
  EXPECT_EQ(joints[1].child, 2);
  EXPECT_EQ(joints[1].axis, (geometry::Vector3{0, 0, -1}));
}

// The joints are 0 -> 1 and 3 -> 2 -> 1. The whole chain above the second joint is reversed.
TEST(JointForest, ReversesAChain) {
  std::vector<Joint> joints = {Between("a", 0, 1), Between("b", 3, 2), Between("c", 2, 1)};
  EXPECT_THAT(MakeForest(4, joints), IsEmpty());
  EXPECT_EQ(joints[2].parent, 1);
  EXPECT_EQ(joints[2].child, 2);
  EXPECT_EQ(joints[1].parent, 2);
  EXPECT_EQ(joints[1].child, 3);
}

// The joints are 0 -> 1 and world -> 2 -> 1. A joint to the world cannot be reversed, so the other
// joint is reversed.
TEST(JointForest, KeepsTheWorldAsTheRoot) {
  std::vector<Joint> joints = {Between("a", 0, 1), Between("w", -1, 2), Between("b", 2, 1)};
  EXPECT_THAT(MakeForest(3, joints), IsEmpty());
  EXPECT_EQ(joints[2].parent, 2);
  EXPECT_EQ(joints[2].child, 1);
  EXPECT_EQ(joints[0].parent, 1);
  EXPECT_EQ(joints[0].child, 0);
}

TEST(JointForest, RemovesJointsThatCloseALoop) {
  std::vector<Joint> joints = {Between("a", 0, 1),    Between("b", 1, 2),  Between("c", 2, 0),
                               Between("self", 1, 1), Between("w", -1, 0), Between("w2", -1, 2)};
  EXPECT_THAT(MakeForest(3, joints),
              ElementsAre(Field(&Joint::name, "c"), Field(&Joint::name, "self"),
                          Field(&Joint::name, "w2")));
  EXPECT_EQ(joints.size(), 3u);
}

}  // namespace
}  // namespace gsv::formats
