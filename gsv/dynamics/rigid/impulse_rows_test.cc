#include "gsv/dynamics/rigid/impulse_rows.h"

#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "gsv/dynamics/rigid/linear_solve.h"

namespace gsv::dynamics {
namespace {

constexpr double kNoBound = std::numeric_limits<double>::infinity();

TEST(SolveLinear, SolvesEquationsThatNeedPivots) {
  std::array<double, 9> a{0, 2, 1, 1, 1, 0, 3, 0, -1};
  std::array<double, 3> b{7, 3, 0};  // the right side for x = (1, 2, 3)
  ASSERT_TRUE(SolveLinear(a, b));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(b[i], 1.0 + static_cast<double>(i), 1e-14);
}

TEST(SolveLinear, RejectsASingularMatrix) {
  std::array<double, 4> a{1, 2, 2, 4};
  std::array<double, 2> b{1, 2};
  EXPECT_FALSE(SolveLinear(a, b));
}

// A column of bodies of these masses on the ground. Each has a downward velocity of 1 m/s, and
// there is one row between each body and the one below it.
class Column {
 public:
  explicit Column(const std::vector<double>& masses) {
    const std::array<double, 1> pulled{-1}, up{1}, down{-1};
    for (std::size_t i = 0; i < masses.size(); ++i) {
      first_.push_back(rows_.AddBody(pulled));
      const std::array<double, 1> lifts{1 / masses[i]};
      const std::array<double, 1> presses{i == 0 ? 0 : -1 / masses[i - 1]};
      const ImpulseRows::Side above{first_[i], up, lifts};
      const ImpulseRows::Side below{i == 0 ? 0 : first_[i - 1], down, presses};
      rows_.AddRow(above, i == 0 ? ImpulseRows::Side{} : below, {0, 0, 0, kNoBound}, 0);
    }
  }
  ImpulseRows& rows() { return rows_; }

 private:
  ImpulseRows rows_;
  std::vector<int> first_;
};

TEST(ImpulseRows, BoxesOfAStackCarryTheWeightAbove) {
  for (const double heaviest : {1.0, 1e3, 1e6}) {
    Column column({1, 1, 1, heaviest});
    EXPECT_LT(column.rows().Solve(200, 1e-10), 40) << heaviest;
    for (int i = 0; i < 4; ++i) {
      EXPECT_NEAR(column.rows().impulse(i) / (3 - i + heaviest), 1, 1e-9) << heaviest;
    }
  }
}

TEST(ImpulseRows, SoftRowYields) {
  ImpulseRows rows;
  const std::array<double, 1> velocity{2}, unit{1}, response{0.5};
  rows.AddRow({rows.AddBody(velocity), unit, response}, {}, {0, 1.5, -kNoBound, kNoBound}, 0);
  rows.Solve(50, 1e-12);
  // v + 1.5 x = 0 with v = 2 + 0.5 x.
  EXPECT_NEAR(rows.impulse(0), -1, 1e-12);
  EXPECT_NEAR(rows.velocities(0, 1)[0], 1.5, 1e-12);
}

// Returns the velocity (x, y) of a body after friction has acted on it. It slides in a plane, on a
// contact with a normal impulse of 1 N s. The inverse of its mass is 4 / kg along x and 0.5 / kg
// along y: a wheel, too, has different inertia along its two axes.
std::array<double, 2> SlipAfter(double angle, double speed, const ImpulseRows::Axes& axes) {
  ImpulseRows rows;
  const std::array<double, 3> velocity{speed * std::cos(angle), speed * std::sin(angle), -1};
  const int body = rows.AddBody(velocity);
  const std::array<double, 3> x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  const std::array<double, 3> along_x{4, 0, 0}, along_y{0, 0.5, 0};
  rows.AddRow({body, z, z}, {}, {0, 0, 0, kNoBound}, 0);
  rows.AddRow({body, x, along_x}, {}, {}, 0);
  rows.AddRow({body, y, along_y}, {}, {}, 0);
  rows.AddCone(0, 1, 0.5, axes);
  rows.Solve(100, 1e-13);
  return {rows.velocities(body, 3)[0], rows.velocities(body, 3)[1]};
}

TEST(ImpulseRows, FrictionOpposesTheSlipForAnyMasses) {
  for (const double angle : {0.0, 0.4, 0.8, 1.2, 1.5}) {
    const auto [x, y] = SlipAfter(angle, 5, {{{1, 0}, {0, 1}}});
    const double speed = std::sqrt(x * x + y * y);
    // Friction gives an impulse of 0.5 N s against the remaining slip. The change of velocity is
    // this impulse times the inverse mass: 4 / kg along x, and 0.5 / kg along y.
    EXPECT_NEAR(x - 5 * std::cos(angle), -4 * 0.5 * x / speed, 1e-9) << angle;
    EXPECT_NEAR(y - 5 * std::sin(angle), -0.5 * 0.5 * y / speed, 1e-9) << angle;
  }
}

TEST(ImpulseRows, FrictionDoesNotDependOnItsAxes) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  const auto [x, y] = SlipAfter(0.9, 5, {{{1, 0}, {0, 1}}});
  const auto [turned_x, turned_y] = SlipAfter(0.9, 5, {{{c, s}, {-s, c}}});
  EXPECT_NEAR(x, turned_x, 1e-9);
  EXPECT_NEAR(y, turned_y, 1e-9);
}

TEST(ImpulseRows, FrictionHoldsUpToItsLimit) {
  const auto [x, y] = SlipAfter(0.9, 0.2, {{{1, 0}, {0, 1}}});
  EXPECT_NEAR(x, 0, 1e-12);
  EXPECT_NEAR(y, 0, 1e-12);
}

// A sliding body on two feet, whose centre of mass is above them: friction presses the front foot
// to the ground and lifts the rear foot. Its degrees of freedom are x, y, z and the pitch.
TEST(ImpulseRows, SolvesASlidingBodyOnTwoFeetFromItsSlip) {
  constexpr double kMass = 3, kInertia = 0.2, kHeight = 0.1, kHalf = 0.25, kFriction = 0.5;
  ImpulseRows rows;
  const std::array<double, 4> moved{2, 0, -1, 0};
  const int body = rows.AddBody(moved);
  const auto add = [&](const std::array<double, 4>& jacobian, double lower, double upper) {
    const std::array<double, 4> response{jacobian[0] / kMass, jacobian[1] / kMass,
                                         jacobian[2] / kMass, jacobian[3] / kInertia};
    return rows.AddRow({body, jacobian, response}, {}, {0, 0, lower, upper}, 0);
  };
  std::array<int, 2> normals, cones;
  for (int i = 0; i < 2; ++i) normals[i] = add({0, 0, 1, i == 0 ? -kHalf : kHalf}, 0, kNoBound);
  for (int i = 0; i < 2; ++i) {
    const int along = add({1, 0, 0, -kHeight}, -1, 1);
    add({0, 1, 0, 0}, -1, 1);
    cones[i] = rows.AddCone(normals[i], along, kFriction, {{{1, 0}, {0, 1}}});
  }
  EXPECT_LE(rows.Solve(80, 1e-8), 2);
  // The moments about the centre of mass: half * (front - rear) = height * friction * (front +
  // rear).
  const double shift = kFriction * kHeight / kHalf;
  EXPECT_NEAR(rows.impulse(normals[0]), kMass / 2 * (1 + shift), 1e-7);
  EXPECT_NEAR(rows.impulse(normals[1]), kMass / 2 * (1 - shift), 1e-7);
  for (int i = 0; i < 2; ++i) {
    const auto [along, across] = rows.ConeImpulse(cones[i]);
    EXPECT_NEAR(along, -kFriction * rows.impulse(normals[i]), 1e-7);
    EXPECT_NEAR(across, 0, 1e-7);
  }
}

}  // namespace
}  // namespace gsv::dynamics
