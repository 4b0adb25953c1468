// Tests force-torque sensors with the equations of mechanics. The tests set the motion of the
// links. The test gsv/simulation/gazebo_values_test.cc uses motions that engines compute.
#include <gtest/gtest.h>

#include "gsv/base/test_within.h"
#include "gsv/geometry/constants.h"
#include "gsv/messages/geometry_msgs.h"
#include "gsv/sensing/sensor_type.h"
#include "gsv/sensing/testing/test_sensor.h"
#include "gsv/sensing/testing/test_snapshot.h"

namespace gsv::sensing {
namespace {

using geometry::kPi;
using geometry::Vector3;
using testing::BuiltInSensors;

constexpr double kMass = 3, kLength = 0.7, kG = 9.8;

// An arm of links in a row along x at zero joint positions. Each link begins with a joint about -y,
// so that positive angles lift it, and has a point mass at its end.
std::shared_ptr<model::Model> Arm(const std::vector<double>& masses,
                                  const std::vector<double>& lengths) {
  auto model = std::make_shared<model::Model>();
  model->links.resize(1);
  double x = 0;
  for (std::size_t i = 0; i < masses.size(); ++i) {
    model::Link link;
    link.name = "link";
    link.model_from_link = {{x, 0, 0}, {}};
    link.inertial = {masses[i], {{lengths[i], 0, 0}, {}}, 0, 0, 0, 0, 0, 0};
    model::Joint joint;
    joint.kind = model::JointKind::kRevolute;
    joint.parent = static_cast<int>(i);
    joint.child = static_cast<int>(i) + 1;
    joint.axis = {0, -1, 0};
    joint.model_from_joint = link.model_from_link;
    model->joints.push_back(joint);
    model->links.push_back(link);
    x += lengths[i];
  }
  return model;
}

class ForceTorqueTest : public ::testing::Test {
 protected:
  void Place(const std::shared_ptr<model::Model>& model, const geometry::Pose& pose = {}) {
    snapshot_ = testing::MakeSnapshot(
        {{"arm", model, pose, false}, {"ground", testing::ModelOf(geometry::Plane{}), {}, true}});
    body_ = snapshot_->layout->Find("arm");
    snapshot_->accelerations.resize(2);
    snapshot_->joint_accelerations.assign(snapshot_->state.joint_positions.size(), 0);
    snapshot_->step_length = std::chrono::milliseconds(1);
    description_.name = "wrist", description_.type = "force_torque", description_.link = 1;
  }

  // Reads the sensor. By default, the reading is the wrench that the parent exerts on the child, in
  // the child's axes.
  readings::ForceTorque Read(model::Parameters parameters = {
                                 {"measure_direction", std::string("parent_to_child")}}) {
    description_.parameters = std::move(parameters);
    const auto sensor = BuiltInSensors().Find("force_torque")->create(description_);
    EXPECT_TRUE(sensor) << sensor.error().Sentence();
    reading_ = *(*sensor)->Sample(Sampling(snapshot_, body_, 1, rays_));
    return *ValuesOf<readings::ForceTorque>(reading_, "wrist");
  }

  void Expect(const readings::Vector& measured, const Vector3& expected, const char* unit) {
    EXPECT_WITHIN(measured.x, expected.x, 1e-12, unit);
    EXPECT_WITHIN(measured.y, expected.y, 1e-12, unit);
    EXPECT_WITHIN(measured.z, expected.z, 1e-12, unit);
  }

  model::SensorDescription description_;
  std::shared_ptr<world::Snapshot> snapshot_;
  int body_ = 0;
  Reading reading_;
  RaySceneCache rays_;
};

TEST_F(ForceTorqueTest, HorizontalArmIsHeldByItsWeightTimesItsLength) {
  Place(Arm({kMass}, {kLength}));
  const readings::ForceTorque held = Read();
  Expect(held.force, {0, 0, kMass * kG}, "N");
  Expect(held.torque, {0, -kMass * kG * kLength, 0}, "N m");
}

TEST_F(ForceTorqueTest, DirectionAndFrameAreThoseOfTheDescription) {
  // The parent lies on its side, and the arm points downwards.
  Place(Arm({kMass}, {kLength}), {{0, 0, 2}, geometry::FromAxisAngle({1, 0, 0}, kPi / 2)});
  snapshot_->state.joint_positions[0] = 0.4;
  const double weight = kMass * kG;
  // With the sensor's default parameters, the reading is the wrench that the child exerts on the
  // parent, in the child's frame.
  Expect(Read({}).force, {0, -weight, 0}, "N");
  Expect(Read({{"frame", std::string("parent")}}).force, {0, -weight, 0}, "N");
  const Vector3 torque{std::sin(0.4) * kLength * weight, 0, -std::cos(0.4) * kLength * weight};
  Expect(Read({{"frame", std::string("parent")}}).torque, {torque.x, 0, torque.z}, "N m");
  // In the child's frame the arm is along x.
  Expect(Read({}).torque, {0, 0, -kLength * weight}, "N m");
  description_.link_from_sensor = {{0.1, 0.2, 0.3}, geometry::FromAxisAngle({0, 0, 1}, kPi / 2)};
  Expect(Read({{"frame", std::string("sensor")}}).force, {-weight, 0, 0}, "N");
}

TEST_F(ForceTorqueTest, HangingWeightPullsByItsWeight) {
  Place(Arm({kMass}, {kLength}));
  snapshot_->state.joint_positions[0] = -kPi / 2;
  const readings::ForceTorque held = Read();
  Expect(held.force, {-kMass * kG, 0, 0}, "N");
  Expect(held.torque, {0, 0, 0}, "N m");
}

TEST_F(ForceTorqueTest, SpinningArmIsPulledInwards) {
  Place(Arm({kMass}, {kLength}), {{}, geometry::FromAxisAngle({1, 0, 0}, kPi / 2)});
  const double rate = 4;
  snapshot_->state.joint_velocities[0] = rate;  // the arm turns about the vertical
  const readings::ForceTorque held = Read();
  Expect(held.force, {-kMass * rate * rate * kLength, kMass * kG, 0}, "N");
  // The arm accelerates.
  snapshot_->joint_accelerations[0] = 2;
  Expect(Read().torque, {0, -2 * kMass * kLength * kLength, kMass * kG * kLength}, "N m");
}

// Craig, Introduction to Robotics, 3rd edition, equation 6.58.
TEST_F(ForceTorqueTest, TwoLinksFollowTheEquationsOfLagrange) {
  const double m1 = 2, m2 = 3, l1 = 0.6, l2 = 0.4;
  Place(Arm({m1, m2}, {l1, l2}));
  const double q1 = 0.3, q2 = 0.9, v1 = 1.2, v2 = -2.5, a1 = 3, a2 = 5;
  snapshot_->state.joint_positions = {q1, q2};
  snapshot_->state.joint_velocities = {v1, v2};
  snapshot_->joint_accelerations = {a1, a2};
  const double c2 = std::cos(q2), s2 = std::sin(q2), c12 = std::cos(q1 + q2);
  const double second =
      m2 * l2 * l2 * (a1 + a2) + m2 * l1 * l2 * (c2 * a1 + s2 * v1 * v1) + m2 * l2 * kG * c12;
  const double first = m2 * l2 * l2 * (a1 + a2) + m2 * l1 * l2 * c2 * (2 * a1 + a2) +
                       (m1 + m2) * l1 * l1 * a1 - m2 * l1 * l2 * s2 * v2 * (v2 + 2 * v1) +
                       m2 * l2 * kG * c12 + (m1 + m2) * l1 * kG * std::cos(q1);
  EXPECT_WITHIN(Read().torque.y, -first, 1e-12, "N m");
  description_.link = 2;
  EXPECT_WITHIN(Read().torque.y, -second, 1e-12, "N m");
}

// A bar of length l has the moment of inertia m l² / 12 about its middle, and m l² / 3 about its
// end.
TEST_F(ForceTorqueTest, InertiaOfALinkResistsItsAcceleration) {
  auto arm = Arm({kMass}, {kLength / 2});
  arm->links[1].inertial.iyy = kMass * kLength * kLength / 12;
  Place(arm);
  snapshot_->joint_accelerations[0] = 7;
  EXPECT_WITHIN(Read().torque.y, -7 * kMass * kLength * kLength / 3 - kMass * kG * kLength / 2,
                1e-12, "N m");
}

TEST_F(ForceTorqueTest, BaseInFreeFallLoadsNoJoint) {
  Place(Arm({kMass}, {kLength}));
  snapshot_->accelerations[static_cast<std::size_t>(body_)].linear = {0, 0, -kG};
  Expect(Read().force, {0, 0, 0}, "N");
  Expect(Read().torque, {0, 0, 0}, "N m");
}

TEST_F(ForceTorqueTest, ContactBelowTheJointCarriesAPartOfTheWeight) {
  auto arm = Arm({kMass}, {kLength});
  model::Collision foot;
  foot.shape = geometry::Sphere{0.1};
  foot.link_from_collision = {{kLength, 0, 0}, {}};
  arm->links[1].collisions.push_back(foot);
  foot.link_from_collision = {};
  arm->links[0].collisions.push_back(foot);
  Place(arm);
  // A force of 20 N acts under the end of the arm, with 5 N of friction towards the base, and 8 N
  // act under the base.
  world::Contact contact;
  contact.first = body_, contact.second = snapshot_->layout->Find("ground");
  contact.points = {{{kLength, 0, -0.1}, {0, 0, -1}, 0, {0.005, 0, -0.020}},
                    {{0, 0, -0.1}, {0, 0, -1}, 0, {0, 0, -0.008}}};
  snapshot_->contacts = {contact};
  const readings::ForceTorque held = Read();
  Expect(held.force, {5, 0, kMass * kG - 20}, "N");
  Expect(held.torque, {0, -(kMass * kG - 20) * kLength - 5 * 0.1, 0}, "N m");
}

TEST_F(ForceTorqueTest, LinkWithoutAJointAndWrongParametersAreRefused) {
  Place(Arm({kMass}, {kLength}));
  description_.link = 0;
  const auto sensor = BuiltInSensors().Find("force_torque")->create(description_);
  const auto reading = (*sensor)->Sample(Sampling(snapshot_, body_, 1, rays_));
  ASSERT_FALSE(reading);
  EXPECT_NE(reading.error().Sentence().find("has no parent joint"), std::string::npos);
  for (const char* name : {"frame", "measure_direction"}) {
    description_.parameters = {{name, std::string("sideways")}};
    EXPECT_FALSE(BuiltInSensors().Find("force_torque")->create(description_)) << name;
  }
}

TEST_F(ForceTorqueTest, MessageIsAWrench) {
  Place(Arm({kMass}, {kLength}));
  (void)Read();
  const auto sensor = BuiltInSensors().Find("force_torque")->create(description_);
  const auto bytes = (*sensor)->Encode(reading_, "arm/wrist");
  const auto message =
      messages::Decode<messages::geometry_msgs::WrenchStamped>(std::as_bytes(std::span(*bytes)));
  ASSERT_TRUE(message);
  EXPECT_EQ(message->header.frame_id, "arm/wrist");
  EXPECT_EQ(message->wrench.force.z, kMass * kG);
  EXPECT_EQ(message->wrench.torque.y, -kMass * kG * kLength);
}

}  // namespace
}  // namespace gsv::sensing
