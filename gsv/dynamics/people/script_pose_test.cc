#include "gsv/dynamics/people/script_pose.h"

#include <gtest/gtest.h>

namespace gsv::dynamics {
namespace {

using base::FromSeconds;
using base::SimTime;
using geometry::PlanarPose;
using geometry::Pose;
using geometry::Vector3;

model::Trajectory TrajectoryOf(std::initializer_list<std::pair<double, Pose>> waypoints,
                               double tension = 0) {
  model::Trajectory trajectory;
  trajectory.tension = tension;
  for (const auto& [time, pose] : waypoints) {
    trajectory.waypoints.push_back({FromSeconds(time), pose});
  }
  return trajectory;
}

model::Script ScriptOf(model::Trajectory trajectory) {
  model::Script script;
  script.trajectories.push_back(std::move(trajectory));
  return script;
}

double XAt(const model::Trajectory& trajectory, double time) {
  return PoseOn(trajectory, FromSeconds(time)).position.x;
}

TEST(PoseOnTrajectory, PassesThroughItsWaypoints) {
  const auto trajectory = TrajectoryOf(
      {{0, PlanarPose(1, 2, 3, 0.5)}, {2, PlanarPose(4, 0, 1, 1)}, {5, PlanarPose(-3, 7, 0, -2)}});
  for (const model::Waypoint& waypoint : trajectory.waypoints) {
    EXPECT_NEAR(Norm(PoseOn(trajectory, waypoint.time).position - waypoint.pose.position), 0,
                1e-12);
  }
  EXPECT_EQ(PoseOn(trajectory, FromSeconds(9)), trajectory.waypoints[2].pose);
}

TEST(PoseOnTrajectory, FollowsTheHermitePolynomialWithinASegment) {
  // The middle segment goes from x = 1 to x = 3. Its tangents are (3 - 0) / 2 = 1.5 and (7 - 1) / 2
  // = 3.
  const auto trajectory = TrajectoryOf({{0, PlanarPose(0, 0, 0, 0)},
                                        {1, PlanarPose(1, 0, 0, 0)},
                                        {3, PlanarPose(3, 0, 0, 0)},
                                        {4, PlanarPose(7, 0, 0, 0)}});
  // At a quarter of the segment, the Hermite weights are 0.84375 and 0.15625 for the end points,
  // and 0.140625 and -0.046875 for the tangents: 0.84375 · 1 + 0.15625 · 3 + 0.140625 · 1.5 -
  // 0.046875 · 3 = 1.3828125.
  EXPECT_NEAR(XAt(trajectory, 1.5), 1.3828125, 1e-12);
  // The first segment goes from x = 0 to x = 1. Its tangents are (1 - 0) / 2 = 0.5 and 1.5. At half
  // of the segment, the Hermite weights are 0.5 for each end point, and 0.125 and -0.125 for the
  // tangents: 0.5 · 0 + 0.5 · 1 + 0.125 · 0.5 - 0.125 · 1.5 = 0.375.
  EXPECT_NEAR(XAt(trajectory, 0.5), 0.375, 1e-12);
}

TEST(PoseOnTrajectory, IsLinearAndStopsAtWaypointsAtFullTension) {
  const auto trajectory = TrajectoryOf(
      {{0, PlanarPose(0, 0, 0, 0)}, {2, PlanarPose(4, 2, 0, 0)}, {4, PlanarPose(0, 9, 0, 0)}}, 1);
  for (const double u : {0.1, 0.25, 0.5, 0.9}) {
    const Vector3 p = PoseOn(trajectory, FromSeconds(2 * u)).position;
    EXPECT_NEAR(p.x, 4 * (3 * u * u - 2 * u * u * u), 1e-9);
    EXPECT_NEAR(p.y, p.x / 2, 1e-12);
  }
}

TEST(PoseOnTrajectory, IsSmoothAtTheEndOfAClosedTrajectory) {
  // The path is a square. Its first waypoint is also its last one. There, the tangent is half of
  // the second waypoint minus the fourth: (1, -1).
  const auto square = TrajectoryOf({{0, PlanarPose(0, 0, 0, 0)},
                                    {1, PlanarPose(2, 0, 0, 0)},
                                    {2, PlanarPose(2, 2, 0, 0)},
                                    {3, PlanarPose(0, 2, 0, 0)},
                                    {4, PlanarPose(0, 0, 0, 0)}});
  const Vector3 just_after = PoseOn(square, FromSeconds(1e-4)).position;
  EXPECT_NEAR(just_after.x / 1e-4, 1, 1e-3);
  EXPECT_NEAR(just_after.y / 1e-4, -1, 1e-3);
  const Vector3 just_before = PoseOn(square, FromSeconds(4 - 1e-4)).position;
  EXPECT_NEAR(just_before.x / 1e-4, -1, 1e-3);
  EXPECT_NEAR(just_before.y / 1e-4, 1, 1e-3);
}

TEST(PoseOnTrajectory, RotatesUniformlyAlongTheShorterArc) {
  const auto trajectory = TrajectoryOf({{0, PlanarPose(0, 0, 0, 3)}, {1, PlanarPose(0, 0, 0, -3)}});
  const double turn = 2 * 3.14159265358979323846 - 6;
  EXPECT_NEAR(geometry::WrapAngle(geometry::Yaw(PoseOn(trajectory, FromSeconds(0.25)).orientation) -
                                  (3 + turn / 4)),
              0, 1e-12);
}

TEST(ScriptInstant, WaitsForTheDelayBeforeEachCycle) {
  model::Script script =
      ScriptOf(TrajectoryOf({{0, PlanarPose(1, 0, 0, 0)}, {4, PlanarPose(5, 0, 0, 0)}}));
  script.delay = FromSeconds(2);
  const auto x = [&](double time) { return InstantOf(script, FromSeconds(time)).pose.position.x; };
  EXPECT_EQ(x(0), 1);
  EXPECT_EQ(x(1.9), 1);
  EXPECT_NEAR(x(4), 3, 1e-12);    // halfway
  EXPECT_NEAR(x(6.5), 5, 1e-12);  // the actor waits at the end of the trajectory
  EXPECT_NEAR(x(10), 3, 1e-12);   // and again
  EXPECT_EQ(InstantOf(script, FromSeconds(10)).cycle, 1);
}

TEST(ScriptInstant, StaysAtTheEndWithoutALoop) {
  model::Script script =
      ScriptOf(TrajectoryOf({{0, PlanarPose(1, 0, 0, 0)}, {4, PlanarPose(5, 0, 0, 0)}}));
  script.loops = false;
  EXPECT_EQ(InstantOf(script, FromSeconds(1e6)).pose.position.x, 5);
}

TEST(ScriptInstant, RunsTrajectoriesOneAfterTheOther) {
  model::Script script =
      ScriptOf(TrajectoryOf({{0, PlanarPose(0, 0, 0, 0)}, {1, PlanarPose(1, 0, 0, 0)}}));
  script.trajectories.push_back(
      TrajectoryOf({{0, PlanarPose(1, 0, 0, 0)}, {2, PlanarPose(1, 4, 0, 0)}}));
  const ScriptInstant instant = InstantOf(script, FromSeconds(2));
  EXPECT_EQ(instant.trajectory, 1u);
  EXPECT_EQ(instant.since, FromSeconds(1));
  EXPECT_NEAR(instant.pose.position.y, 2, 1e-12);
  EXPECT_NEAR(InstantOf(script, FromSeconds(3.5)).pose.position.x, 0.5, 1e-12);
}

TEST(ScriptInstant, StaysAtTheStartUntilItIsStarted) {
  model::Script script =
      ScriptOf(TrajectoryOf({{0, PlanarPose(1, 0, 0, 0)}, {4, PlanarPose(5, 0, 0, 0)}}));
  script.starts_by_itself = false;
  EXPECT_EQ(InstantOf(script, FromSeconds(3)).pose.position.x, 1);
  EXPECT_EQ(InstantOf(model::Script{}, FromSeconds(3)).pose, Pose{});
}

}  // namespace
}  // namespace gsv::dynamics
