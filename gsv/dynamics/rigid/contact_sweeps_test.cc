// Tests ContactSweeps, which solves the contacts of heaps of bodies, against closed forms.
#include "gsv/dynamics/rigid/contact_sweeps.h"

#include <gtest/gtest.h>

namespace gsv::dynamics {
namespace {

using geometry::Vector3;

constexpr std::array<Vector3, 3> kUpright{{{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}};

ContactSweeps::Body Cube(double mass, const Vector3& velocity) {
  const double inverse = 6 / mass;  // inverse inertia of a cube of 1 m
  return {velocity, {}, 1 / mass, {{inverse, 0, 0}, {0, inverse, 0}, {0, 0, inverse}}};
}

TEST(ContactSweeps, TowerRestsWhicheverBodyComesFirst) {
  // Ten stacked cubes of 1 kg fall at 1 m/s, so the impulse of the ground is 10 N s.
  for (const bool upwards : {true, false}) {
    ContactSweeps sweeps;
    for (int i = 0; i < 10; ++i) sweeps.AddBody(Cube(1, {0, 0, -1}));
    for (int i = 0; i < 10; ++i) {
      const int body = upwards ? i : 9 - i;
      sweeps.AddContact({body, {0, 0, -0.5}}, {body - 1, {0, 0, 0.5}}, kUpright, {0, 0, 0}, 0.5,
                        {0, 0}, {0, 0, 0});
    }
    sweeps.Solve(1000, 1e-9);
    const int lowest = upwards ? 0 : 9;
    EXPECT_NEAR(sweeps.impulse(lowest)[0], 10, 1e-6);
    for (int i = 0; i < 10; ++i) EXPECT_NEAR(sweeps.body(i).velocity.z, 0, 1e-6) << i;
  }
}

TEST(ContactSweeps, StartFromTheSolutionTakesOneSweep) {
  ContactSweeps sweeps;
  sweeps.AddBody(Cube(2, {0, 0, -1}));
  sweeps.AddContact({0, {0, 0, -0.5}}, {}, kUpright, {0, 0, 0}, 0.5, {0, 0}, {2, 0, 0});
  EXPECT_EQ(sweeps.Solve(100, 1e-9), 1);
  EXPECT_NEAR(sweeps.body(0).velocity.z, 0, 1e-12);
}

TEST(ContactSweeps, FrictionIsOppositeToTheSlipAndBounded) {
  // The body is a point mass, so the contact has no lever arm. It slides at 5 m/s. Friction slows
  // it by the coefficient times the impulse, 0.5 m/s.
  ContactSweeps sweeps;
  sweeps.AddBody(Cube(1, {3, 4, -1}));
  sweeps.AddContact({0, {}}, {}, kUpright, {0, 0, 0}, 0.5, {0, 0}, {0, 0, 0});
  sweeps.Solve(100, 1e-12);
  EXPECT_NEAR(sweeps.body(0).velocity.x, 3 * 0.9, 1e-9);
  EXPECT_NEAR(sweeps.body(0).velocity.y, 4 * 0.9, 1e-9);
}

}  // namespace
}  // namespace gsv::dynamics
