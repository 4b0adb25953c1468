// The social force model: computes the acceleration of a pedestrian towards its goal and away from
// others.
//
// Source     D. Helbing, P. Molnár, "Social force model for pedestrian dynamics", Physical Review
//            E 51, 4282 (1995), with that paper's parameters. A pedestrian is at x, has the
//            velocity v, and wants to walk at v0 in the direction e. It accelerates by
//              dv/dt = (v0 e - v) / tau + sum of w(e, f) f over the others + sum of f over walls,
//            and is never faster than 1.3 v0.
// Others     f = -grad V0 exp(-b / sigma). Here 2 b = sqrt((|r| + |r - s|)² - |s|²) is the smaller
//            diameter of an ellipse through the pedestrian, with r = x - x_other. s is the other's
//            velocity times dt, which is the distance that it is expected to walk.
//              V0 = 2.1 m²/s², sigma = 0.3 m, dt = 2 s
// Sight      w is 1 for others within 100 degrees of e, and 0.5 for others behind the pedestrian.
// Walls      f = (U0 / R) exp(-d / R) away from the nearest point of the wall, which is at the
//              distance d. U0 = 10 m²/s², R = 0.2 m
// Driving    tau = 0.5 s. The driving term is integrated exactly, and the forces by Euler's method.
//            So a single pedestrian has the speed v0 (1 - exp(-t / tau)) at time t for any step
//            size.
// Changes    This implementation differs from the paper in two ways. It has no random fluctuations.
//            Instead, each force of another pedestrian is rotated by kAside to the right, so that
//            two pedestrians who meet head on pass each other. The radii of both pedestrians reduce
//            the distance between them, see Apart().
// Units      metres, seconds. Vectors in the plane of the world.
#pragma once

#include "gsv/dynamics/people/social_force_constants.h"
#include "gsv/geometry/vector3.h"

namespace gsv::dynamics {

inline constexpr double kRelaxationTime = 0.5;  // s
inline constexpr double kMaxSpeedFactor = 1.3;  // maximum speed as a multiple of the desired speed
// Maximum distances, in m, at which a pedestrian (from centre to centre) and a wall exert a force.
inline constexpr double kOthersReach = 3, kWallsReach = 1.2;

// The vector r = x - x_other for the model, from another pedestrian to this pedestrian. `between`
// is the vector from centre to centre. The result is shorter by the sum of the radii minus
// 2 kPaperRadius, but its length is at least kClosest.
//
// The paper's pedestrians are points. Two of them stop at a distance of 0.29 m, where the driving
// force balances the repulsion. So they behave like discs with a radius of about 0.14 m.
// kPaperRadius is smaller than 0.14 m, so that people of any size keep about 10 cm between them.
geometry::Vector2 Apart(geometry::Vector2 between, double radius, double other_radius);

// The acceleration due to one other pedestrian, without the weight w. `apart` is not zero.
geometry::Vector2 RepulsionByOther(geometry::Vector2 apart, geometry::Vector2 other_velocity);

// The force with the weight w, for a pedestrian that wants to walk in the direction `wanted` (unit
// length, or zero).
geometry::Vector2 AsSeen(geometry::Vector2 force, geometry::Vector2 wanted);

// The acceleration due to a wall at `distance`. `away` is the unit vector that points away from the
// wall.
geometry::Vector2 RepulsionByWall(geometry::Vector2 away, double distance);

// The fraction of the difference between the velocity and the desired velocity v0 e that remains
// after `seconds`.
double Relaxation(double seconds);

// The velocity after a time under a constant force. `wanted` is v0 e, `left` is
// Relaxation(seconds).
geometry::Vector2 NextVelocity(geometry::Vector2 velocity, geometry::Vector2 wanted,
                               geometry::Vector2 force, double speed, double seconds, double left);

}  // namespace gsv::dynamics
