// Tests that models stay the same when they are written as URDF and read again by urdfdom and
// libsdformat.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <gmock/gmock.h>

#include "gsv/base/test_folder.h"
#include "gsv/formats/sdf_reader.h"
#include "gsv/formats/testing/real_folder.h"
#include "gsv/formats/urdf/urdf_writer.h"
#include "gsv/geometry/box_corners.h"

namespace gsv::formats {
namespace {

namespace fs = std::filesystem;
using geometry::Vector3;
using model::JointKind;
using ModelPointer = std::shared_ptr<const model::Model>;
using testing::HasSubstr;

constexpr double kNear = 1e-9;  // tolerance of numbers that are written in decimal
// tolerance of meshes, whose coordinates are rounded to single precision
constexpr double kSingle = 2e-5;

double Between(const Vector3& a, const Vector3& b) { return Norm(a - b); }

void ExpectNear(const geometry::Pose& a, const geometry::Pose& b, const std::string& what) {
  EXPECT_LT(Between(a.position, b.position), kNear) << what;
  for (const Vector3& axis : {Vector3{1, 0, 0}, Vector3{0, 1, 0}}) {
    EXPECT_LT(Between(a.orientation * axis, b.orientation * axis), kNear) << what;
  }
}

// Returns the box around all visuals or collisions of a link, in the link's frame.
template <typename Parts, typename PoseOf>
geometry::Bounds BoxOf(const Parts& parts, PoseOf link_from_part) {
  geometry::Bounds box{{1e9, 1e9, 1e9}, {-1e9, -1e9, -1e9}};
  for (const auto& part : parts) {
    const geometry::TriangleMesh mesh = Tessellate(part.shape);
    for (const Vector3& position : mesh.positions) {
      const Vector3 p = link_from_part(part) * position;
      box.min = {std::min(box.min.x, p.x), std::min(box.min.y, p.y), std::min(box.min.z, p.z)};
      box.max = {std::max(box.max.x, p.x), std::max(box.max.y, p.y), std::max(box.max.z, p.z)};
    }
  }
  return box;
}

void ExpectSameLink(const model::Link& a, const model::Link& b) {
  ExpectNear(a.model_from_link, b.model_from_link, a.name);
  EXPECT_NEAR(a.inertial.mass, b.inertial.mass, kNear) << a.name;
  ExpectNear(a.inertial.link_from_com, b.inertial.link_from_com, a.name + "'s centre of mass");
  EXPECT_NEAR(a.inertial.ixx, b.inertial.ixx, kNear) << a.name;
  EXPECT_NEAR(a.inertial.iyz, b.inertial.iyz, kNear) << a.name;
  EXPECT_EQ(a.has_gravity, b.has_gravity) << a.name;
  EXPECT_EQ(a.collisions.size(), b.collisions.size()) << a.name;
  const auto of_visual = [](const model::Visual& visual) { return visual.link_from_visual; };
  const auto of_collision = [](const model::Collision& each) { return each.link_from_collision; };
  const geometry::Bounds seen[] = {BoxOf(a.visuals, of_visual), BoxOf(b.visuals, of_visual)};
  const geometry::Bounds hit[] = {BoxOf(a.collisions, of_collision),
                                  BoxOf(b.collisions, of_collision)};
  for (const auto* boxes : {seen, hit}) {
    EXPECT_LT(Between(boxes[0].min, boxes[1].min), kSingle) << a.name;
    EXPECT_LT(Between(boxes[0].max, boxes[1].max), kSingle) << a.name;
  }
  if (!a.collisions.empty() && !b.collisions.empty()) {
    EXPECT_NEAR(a.collisions[0].surface.friction, b.collisions[0].surface.friction, kNear)
        << a.name;
  }
  if (!a.visuals.empty() && !b.visuals.empty()) {
    // libsdformat multiplies the colours of URDF by 1.25, as Gazebo shows them.
    const double shown = std::min(1.0, a.visuals[0].materials[0].base_colour.r / 0.8);
    EXPECT_NEAR(shown, b.visuals[0].materials[0].base_colour.r, 1e-6) << a.name;
  }
}

void ExpectSameJoint(const model::Joint& a, const model::Joint& b) {
  EXPECT_EQ(NameOf(a.kind), std::string(NameOf(b.kind))) << a.name;
  EXPECT_EQ(a.parent < 0, b.parent < 0) << a.name;
  const Vector3 axes[] = {a.model_from_joint.orientation * a.axis,
                          b.model_from_joint.orientation * b.axis};
  if (a.kind != JointKind::kFixed) {
    EXPECT_LT(Between(axes[0], axes[1]), kNear) << a.name;
  }
  if (a.kind == JointKind::kRevolute || a.kind == JointKind::kContinuous) {
    const Vector3 offset = b.model_from_joint.position - a.model_from_joint.position;
    EXPECT_LT(Norm(offset - Dot(offset, axes[0]) * axes[0]), kNear) << a.name;
  }
  if (a.kind == JointKind::kRevolute || a.kind == JointKind::kPrismatic) {
    EXPECT_DOUBLE_EQ(a.position_limits.min, b.position_limits.min) << a.name;
    EXPECT_DOUBLE_EQ(a.position_limits.max, b.position_limits.max) << a.name;
  }
  EXPECT_DOUBLE_EQ(a.effort_limit, b.effort_limit) << a.name;
  EXPECT_DOUBLE_EQ(a.velocity_limit, b.velocity_limit) << a.name;
  EXPECT_NEAR(a.damping, b.damping, kNear) << a.name;
}

template <typename Part>
const Part* Named(const std::vector<Part>& parts, const std::string& name) {
  const auto found =
      std::find_if(parts.begin(), parts.end(), [&](const Part& part) { return part.name == name; });
  return found == parts.end() ? nullptr : &*found;
}

class UrdfRoundTripTest : public testing::Test {
 protected:
  ModelPointer Read(const std::string& file, base::Problems& problems) {
    auto model = ModelLibrary().ReadModel(file, problems);
    EXPECT_TRUE(model.has_value()) << (model ? "" : model.error().Sentence());
    return model.value_or(std::make_shared<const model::Model>());
  }
  ModelPointer ReadText(const std::string& sdf) {
    return Read(folder_.Write("model.sdf", sdf).string(), problems_);
  }
  ModelPointer WrittenAndRead(const model::Model& model) {
    const Urdf urdf = WriteUrdf(model, "meshes/", problems_);
    for (const UrdfMesh& mesh : urdf.meshes) folder_.Write("meshes/" + mesh.file, mesh.stl);
    return Read(folder_.Write("robot.urdf", urdf.text).string(), read_problems_);
  }
  void ExpectSame(const model::Model& model) {
    const ModelPointer read = WrittenAndRead(model);
    EXPECT_EQ(read->links.size(), model.links.size()) << model.name;
    for (const model::Link& link : model.links) {
      const model::Link* same = Named(read->links, link.name);
      ASSERT_NE(same, nullptr) << model.name << " lost " << link.name;
      ExpectSameLink(link, *same);
    }
    EXPECT_EQ(read->joints.size(), model.joints.size()) << model.name;
    for (const model::Joint& joint : model.joints) {
      const model::Joint* same = Named(read->joints, joint.name);
      ASSERT_NE(same, nullptr) << model.name << " lost " << joint.name;
      ExpectSameJoint(joint, *same);
      EXPECT_EQ(model.links[static_cast<std::size_t>(joint.child)].name,
                read->links[static_cast<std::size_t>(same->child)].name);
    }
    EXPECT_EQ(read->is_static, model.is_static);
  }

  base::testing::TestFolder folder_;
  base::Problems problems_, read_problems_;
};

constexpr const char* kRobot = R"(<sdf version='1.9'><model name='r'>
<link name='base'><inertial><pose>0.1 0 0.05 0.1 0.2 0.3</pose><mass>3</mass>
  <inertia><ixx>0.3</ixx><iyy>0.4</iyy><izz>0.5</izz><iyz>0.01</iyz></inertia></inertial>
  <visual name='v'><pose>0 0 0.1 0 0 0.5</pose><geometry><box><size>0.5 0.4 0.2</size></box></geometry>
    <material><diffuse>0.2 0.5 0.7 1</diffuse></material></visual>
  <visual name='top'><geometry><capsule><radius>0.1</radius><length>0.3</length></capsule></geometry></visual>
  <collision name='c'><geometry><sphere><radius>0.3</radius></sphere></geometry>
    <surface><friction><ode><mu>0.4</mu><mu2>0.6</mu2></ode></friction></surface></collision></link>
<link name='wheel'><pose>0.2 0.3 0 -1.5707963 0 0</pose><collision name='c'><geometry>
  <cylinder><radius>0.15</radius><length>0.05</length></cylinder></geometry></collision></link>
<joint name='axle' type='revolute'><parent>base</parent><child>wheel</child><axis><xyz>0 0 1</xyz>
  <dynamics><damping>0.2</damping></dynamics><limit><effort>5</effort></limit></axis></joint>
<link name='mast'><enable_wind>false</enable_wind><gravity>false</gravity><pose>0 0 1 0 0 0</pose></link>
<joint name='lift' type='prismatic'><pose>0.1 0.2 0.3 0.4 0 0</pose><parent>base</parent><child>mast</child>
  <axis><xyz>0 1 1</xyz><limit><lower>-0.1</lower><upper>0.7</upper><velocity>0.3</velocity></limit></axis></joint>
<link name='head'><pose>0 0 1.5 0 0.3 1</pose></link>
<joint name='neck' type='revolute'><pose>0 0 0.2 0 0 0</pose><parent>mast</parent><child>head</child>
  <axis><xyz>0 0 1</xyz><limit><lower>-1</lower><upper>2</upper></limit></axis></joint>
<link name='lens'><pose>0.2 0 1.5 0 0 0</pose></link>
<joint name='mount' type='fixed'><parent>head</parent><child>lens</child></joint>
</model></sdf>)";

TEST_F(UrdfRoundTripTest, KeepsLinksJointsInertiasAndShapes) { ExpectSame(*ReadText(kRobot)); }

TEST_F(UrdfRoundTripTest, KeepsMimicJoints) {
  const std::string link = "<inertial><mass>1</mass></inertial></link>";
  const std::string finger =
      "<parent>base</parent><child>$</child><axis><xyz>0 1 0</xyz><limit><lower>-1</lower>"
      "<upper>1</upper></limit>";
  const auto joint = [&](const std::string& name, const std::string& child) {
    std::string text = "<joint name='" + name + "' type='prismatic'>" + finger;
    return text.replace(text.find('$'), 1, child);
  };
  const ModelPointer model = ReadText(
      "<sdf version='1.11'><model name='r'><link name='base'>" + link + "<link name='a'>" + link +
      "<link name='b'>" + link + joint("left", "a") + "</axis></joint>" + joint("right", "b") +
      "<mimic joint='left'><multiplier>-2</multiplier><offset>0.3</offset><reference>0.1"
      "</reference></mimic></axis></joint></model></sdf>");
  ASSERT_TRUE(Named(model->joints, "right")->mimic);
  const ModelPointer read = WrittenAndRead(*model);
  const model::Joint* const right = Named(read->joints, "right");
  ASSERT_TRUE(right != nullptr && right->mimic);
  EXPECT_EQ(read->joints[static_cast<std::size_t>(right->mimic->leader)].name, "left");
  EXPECT_EQ(right->mimic->multiplier, -2);
  EXPECT_DOUBLE_EQ(right->mimic->offset - right->mimic->multiplier * right->mimic->reference, 0.5);
}

TEST_F(UrdfRoundTripTest, KeepsAStaticModelAndOneThatIsFixedToTheWorld) {
  ExpectSame(
      *ReadText("<sdf version='1.9'><model name='m'><static>true</static><link name='l'>"
                "<collision name='c'><geometry><box><size>1 2 3</size></box></geometry></collision>"
                "</link></model></sdf>"));
  const ModelPointer held = ReadText(
      "<sdf version='1.9'><model name='m'><link name='door'><pose>0 0 1 0 0 0</pose></link>"
      "<joint name='hinge' type='revolute'><parent>world</parent><child>door</child>"
      "<axis><xyz>0 0 "
      "1</xyz><limit><lower>0</lower><upper>1.5</upper></limit></axis></joint></model></sdf>");
  ExpectSame(*held);
}

// The frame of a door leaf is in its middle, but it rotates about its edge. So URDF needs a link at
// the edge.
TEST_F(UrdfRoundTripTest, AddsALinkIfTheJointIsOutsideItsChildsFrame) {
  const ModelPointer door = ReadText(
      "<sdf version='1.9'><model name='m'><link name='frame'/><link name='leaf'><pose>0.4 0 1 0 0 "
      "0</pose></link>"
      "<joint name='hinge' type='revolute'><pose>-0.4 0 0 0 0 "
      "0</pose><parent>frame</parent><child>leaf</child>"
      "<axis><xyz>0 0 "
      "1</xyz><limit><lower>0</lower><upper>1.5</upper></limit></axis></joint></model></sdf>");
  const Urdf urdf = WriteUrdf(*door, "", problems_);
  EXPECT_THAT(urdf.text, HasSubstr("<link name=\"hinge_frame\"/>"));
  EXPECT_THAT(urdf.text, HasSubstr("<joint name=\"hinge_offset\" type=\"fixed\">"));
  const ModelPointer read = WrittenAndRead(*door);
  const model::Joint* hinge = Named(read->joints, "hinge");
  ASSERT_NE(hinge, nullptr);
  EXPECT_LT(Between(hinge->model_from_joint.position, {0, 0, 1}), kNear);
  EXPECT_NEAR(hinge->position_limits.max, 1.5, kNear);
}

TEST_F(UrdfRoundTripTest, ReportsOmittedElements) {
  const ModelPointer loose = ReadText(
      "<sdf version='1.9'><model name='m'><link name='a'><sensor name='s' type='imu'/></link>"
      "<link name='b'><pose>1 0 0 0 0 0</pose></link></model></sdf>");
  problems_.clear();
  WriteUrdf(*loose, "", problems_);
  std::string all;
  for (const base::Problem& problem : problems_) all += problem.Sentence() + "\n";
  EXPECT_THAT(
      all,
      HasSubstr("m: the URDF leaves out the model's sensors (1): URDF has no elements for them"));
  EXPECT_THAT(all, HasSubstr("link b, which nothing connects"));
}

TEST_F(UrdfRoundTripTest, EscapesNamesAndWritesEqualTextsForEqualModels) {
  model::Model model;
  model.name = "a \"quoted\" <robot>";
  model.links.resize(1);
  model.links[0].name = "left & right";
  const Urdf first = WriteUrdf(model, "", problems_), second = WriteUrdf(model, "", problems_);
  EXPECT_EQ(first.text, second.text);
  EXPECT_THAT(first.text, HasSubstr("name=\"a &quot;quoted&quot; &lt;robot&gt;\""));
  EXPECT_THAT(first.text, HasSubstr("name=\"left &amp; right\""));
}

TEST_F(UrdfRoundTripTest, KeepsTheBuiltInRobots) {
  const fs::path models = fs::path(std::getenv("GSV_SOURCE_DIR")) / "assets/models";
  for (const char* name : {"pebble", "courier", "rover4", "b21r", "porter"}) {
    ExpectSame(*Read((models / name).string(), problems_));
  }
}

double MassOf(const model::Model& model) {
  double mass = 0;
  for (const model::Link& link : model.links) mass += link.inertial.mass;
  return mass;
}

// libsdformat merges a link that was added for URDF's tree with the link that is fixed to it. The
// merged link has the name of the added link.
TEST_F(UrdfRoundTripTest, KeepsMassAndJointsOfRealRobots) {
  if (RealFolder().empty()) GTEST_SKIP() << "GSV_REAL_DIR names no folder of real worlds";
  for (const char* name :
       {"turtlebot3/models/turtlebot3_burger", "turtlebot3/models/turtlebot3_waffle",
        "gazebo_models/pioneer2dx", "gazebo_models/pioneer3at"}) {
    const ModelPointer model = Read((RealFolder() / name).string(), problems_);
    const ModelPointer read = WrittenAndRead(*model);
    // The reader of SDFormat replaces a ball joint with three joints. The two links between them
    // have no mass, but they get one when the robot is read again from URDF.
    const bool has_balls =
        std::any_of(model->joints.begin(), model->joints.end(),
                    [](const model::Joint& joint) { return joint.kind == JointKind::kBall; });
    if (!has_balls) {
      EXPECT_NEAR(MassOf(*model), MassOf(*read), 1e-6) << name;
    }
    for (const model::Joint& joint : model->joints) {
      if (joint.kind == JointKind::kFixed || joint.kind == JointKind::kBall) continue;
      const model::Joint* same = Named(read->joints, joint.name);
      ASSERT_NE(same, nullptr) << name << " lost " << joint.name;
      ExpectSameJoint(joint, *same);
    }
  }
}

}  // namespace
}  // namespace gsv::formats
