#include "tests/structure/coulomb_motion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace gsv {
namespace {

using geometry::Pose;
using geometry::Vector3;
using Three = std::array<double, 3>;

// Solves the equations by Cramer's rule.
Three Solve(const std::array<Three, 3>& rows, const Three& right) {
  const auto determinant = [](const std::array<Three, 3>& m) {
    return m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
           m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
           m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
  };
  Three solution{};
  for (std::size_t i = 0; i < 3; ++i) {
    auto replaced = rows;
    for (std::size_t row = 0; row < 3; ++row) replaced[row][i] = right[row];
    solution[i] = determinant(replaced) / determinant(rows);
  }
  return solution;
}

struct Support {
  Vector3 point;  // in frame H
  // The velocity of the wheel's surface at the point because of its rotation, m/s; in frame H.
  Vector3 surface;
  double friction = 1, load = 0;
  int link = 0;
};

class Robot {
 public:
  Robot(const dynamics::testing::TestWorld& world, int body)
      : model_(*world.layout().bodies[static_cast<std::size_t>(body)].model),
        first_joint_(world.layout().bodies[static_cast<std::size_t>(body)].first_joint),
        state_(world.state()),
        world_from_model_(state_.bodies[static_cast<std::size_t>(body)].world_from_model),
        world_from_heading_{
            world_from_model_.position,
            geometry::FromAxisAngle({0, 0, 1}, geometry::Yaw(world_from_model_.orientation))} {}

  Vector3 CentreOfMass() const {
    Vector3 moment;
    double mass = 0;
    for (const model::Link& link : model_.links) {
      moment = moment +
               link.inertial.mass * (link.model_from_link * link.inertial.link_from_com.position);
      mass += link.inertial.mass;
    }
    return InHeading(world_from_model_ * (moment * (1 / mass)));
  }

  Support SupportAt(const Vector3& point_in_world) const {
    Support support{InHeading(point_in_world), {}};
    const Vector3 point = Inverse(world_from_model_) * point_in_world;
    const auto [link, collision] = Nearest(point);
    support.friction = std::min(1.0, collision->surface.friction);
    support.link = link;
    for (std::size_t j = 0; j < model_.joints.size(); ++j) {
      const model::Joint& joint = model_.joints[j];
      if (joint.child != link || joint.kind == model::JointKind::kFixed) continue;
      if (joint.kind == model::JointKind::kBall) support.friction = 0;
      const double speed = state_.joint_velocities[static_cast<std::size_t>(first_joint_) + j];
      const Vector3 axis =
          Steering(joint.parent) * (joint.model_from_joint.orientation * joint.axis);
      const Vector3 in_model = speed * Cross(axis, point - joint.model_from_joint.position);
      support.surface =
          Inverse(world_from_heading_).orientation * (world_from_model_.orientation * in_model);
    }
    return support;
  }

 private:
  Vector3 InHeading(const Vector3& in_world) const {
    return Inverse(world_from_heading_) * in_world;
  }

  // Returns the rotation of a link by the joint above it.
  geometry::Quaternion Steering(int link) const {
    for (std::size_t j = 0; j < model_.joints.size(); ++j) {
      const model::Joint& joint = model_.joints[j];
      if (joint.child != link || joint.kind == model::JointKind::kFixed) continue;
      const double angle = state_.joint_positions[static_cast<std::size_t>(first_joint_) + j];
      return geometry::FromAxisAngle(joint.model_from_joint.orientation * joint.axis, angle);
    }
    return {};
  }

  // Returns the collision whose surface is nearest to a point on the ground. Uses the radius of
  // balls and wheels, and the lowest corner of other shapes.
  std::pair<int, const model::Collision*> Nearest(const Vector3& point) const {
    std::pair<int, const model::Collision*> nearest{0, nullptr};
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t l = 0; l < model_.links.size(); ++l) {
      for (const model::Collision& collision : model_.links[l].collisions) {
        const Pose pose = model_.links[l].model_from_link * collision.link_from_collision;
        const double distance = DistanceTo(collision.shape, Inverse(pose) * point);
        if (distance >= least) continue;
        least = distance;
        nearest = {static_cast<int>(l), &collision};
      }
    }
    return nearest;
  }

  static double DistanceTo(const geometry::Shape& shape, const Vector3& p) {
    if (const auto* sphere = std::get_if<geometry::Sphere>(&shape)) {
      return std::abs(Norm(p) - sphere->radius);
    }
    if (const auto* cylinder = std::get_if<geometry::Cylinder>(&shape)) {
      return std::hypot(std::max(0.0, std::hypot(p.x, p.y) - cylinder->radius),
                        std::max(0.0, std::abs(p.z) - cylinder->length / 2));
    }
    double least = std::numeric_limits<double>::infinity();
    for (const Vector3& corner : geometry::Tessellate(shape, 32).positions) {
      least = std::min(least, Norm(p - corner));
    }
    return least;
  }

  const model::Model& model_;
  int first_joint_;
  const world::State& state_;
  Pose world_from_model_, world_from_heading_;
};

// The mean square distances of the points from their mean along x and y, and the mean product of
// both distances.
struct Spread {
  double x = 0, y = 0, xx = 0, yy = 0, xy = 0;
  double narrowest() const { return (xx + yy) / 2 - std::hypot((xx - yy) / 2, xy); }
  // The direction of the largest spread, as an angle from x.
  double direction() const { return std::atan2(2 * xy, xx - yy) / 2; }
};

Spread SpreadOf(const std::vector<Support>& supports) {
  Spread spread;
  const double share = 1.0 / static_cast<double>(supports.size());
  for (const Support& s : supports) {
    spread.x += share * s.point.x;
    spread.y += share * s.point.y;
  }
  for (const Support& s : supports) {
    const double x = s.point.x - spread.x, y = s.point.y - spread.y;
    spread.xx += share * x * x;
    spread.yy += share * y * y;
    spread.xy += share * x * y;
  }
  return spread;
}

void ShareAlongLine(std::vector<Support>& supports, const Spread& spread, const Vector3& centre) {
  const double x = std::cos(spread.direction()), y = std::sin(spread.direction());
  const double share = 1.0 / static_cast<double>(supports.size());
  const double to_centre = (centre.x - spread.x) * x + (centre.y - spread.y) * y;
  for (Support& s : supports) {
    const double along = (s.point.x - spread.x) * x + (s.point.y - spread.y) * y;
    s.load = std::max(0.0, share * (1 + along * to_centre / (spread.xx + spread.yy)));
  }
}

// Sets the load of each support, as a fraction of the weight.
void ShareWeight(std::vector<Support>& supports, const Vector3& centre) {
  constexpr double kLine = 1e-3;  // minimum spread across a line, m
  const Spread spread = SpreadOf(supports);
  if (spread.narrowest() < kLine * kLine) return ShareAlongLine(supports, spread, centre);
  std::array<Three, 3> rows{};
  for (const Support& s : supports) {
    const Three of{1, s.point.x - centre.x, s.point.y - centre.y};
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) rows[i][j] += of[i] * of[j];
    }
  }
  const Three share = Solve(rows, {1, 0, 0});
  for (Support& s : supports) {
    s.load = std::max(
        0.0, share[0] + share[1] * (s.point.x - centre.x) + share[2] * (s.point.y - centre.y));
  }
}

// Returns the links whose contact points differ in y, such as wide wheels, which touch the ground
// along a line across the robot.
std::vector<int> WideLinks(const std::vector<Support>& supports) {
  constexpr double kSame = 1e-4;  // maximum difference in y that counts as equal, m
  std::vector<int> wide;
  for (const Support& a : supports) {
    for (const Support& b : supports) {
      if (a.link == b.link && a.point.y > b.point.y + kSame &&
          std::find(wide.begin(), wide.end(), a.link) == wide.end()) {
        wide.push_back(a.link);
      }
    }
  }
  return wide;
}

// Returns the supports without those of one side of a link: the left ones or the right ones.
std::vector<Support> WithoutEdge(const std::vector<Support>& supports, int link, bool left) {
  double sum = 0, points = 0;
  for (const Support& s : supports) {
    if (s.link != link) continue;
    sum += s.point.y;
    ++points;
  }
  std::vector<Support> kept;
  for (const Support& s : supports) {
    if (s.link != link || (s.point.y > sum / points) != left) kept.push_back(s);
  }
  return kept;
}

// Minimizes the power by iterated least squares, with one over the slip as the weight (Weiszfeld's
// method).
GroundMotion LeastPower(const std::vector<Support>& supports) {
  constexpr int kIterations = 100;
  constexpr double kSticks = 1e-7;  // slip below which a support sticks, m/s
  Three motion{};
  for (int iteration = 0; iteration < kIterations; ++iteration) {
    std::array<Three, 3> rows{};
    Three right{};
    for (const Support& s : supports) {
      const std::array<Three, 2> slip_of{{{1, 0, -s.point.y}, {0, 1, s.point.x}}};
      const std::array<double, 2> surface{s.surface.x, s.surface.y};
      std::array<double, 2> slip{};
      for (std::size_t k = 0; k < 2; ++k) {
        slip[k] = surface[k];
        for (std::size_t i = 0; i < 3; ++i) slip[k] += slip_of[k][i] * motion[i];
      }
      const double weight = s.friction * s.load / (std::hypot(slip[0], slip[1]) + kSticks);
      for (std::size_t k = 0; k < 2; ++k) {
        for (std::size_t i = 0; i < 3; ++i) {
          right[i] -= weight * slip_of[k][i] * surface[k];
          for (std::size_t j = 0; j < 3; ++j) rows[i][j] += weight * slip_of[k][i] * slip_of[k][j];
        }
      }
    }
    motion = Solve(rows, right);
  }
  return {motion[0], motion[1], motion[2]};
}

void Extend(CoulombRange& range, const GroundMotion& motion) {
  for (const auto part : {&GroundMotion::x, &GroundMotion::y, &GroundMotion::turn}) {
    range.min.*part = std::min(range.min.*part, motion.*part);
    range.max.*part = std::max(range.max.*part, motion.*part);
  }
}

}  // namespace

GroundMotion MotionOf(const world::BodyState& body) {
  const Vector3 v =
      geometry::FromAxisAngle({0, 0, 1}, -geometry::Yaw(body.world_from_model.orientation)) *
      body.linear_velocity;
  return {v.x, v.y, body.angular_velocity.z};
}

std::optional<CoulombRange> CoulombMotion(const dynamics::testing::TestWorld& world, int body,
                                          const std::vector<world::Contact>& contacts) {
  const Robot robot(world, body);
  std::vector<Support> supports;
  for (const world::Contact& contact : contacts) {
    if (contact.first != body) continue;
    for (const world::ContactPoint& at : contact.points) {
      supports.push_back(robot.SupportAt(at.point));
    }
  }
  if (supports.size() < 2) return std::nullopt;
  ShareWeight(supports, robot.CentreOfMass());
  const GroundMotion both = LeastPower(supports);
  CoulombRange range{both, both, both};
  const std::vector<int> wide = WideLinks(supports);
  for (unsigned lefts = 0; lefts < 1u << wide.size(); ++lefts) {
    std::vector<Support> edges = supports;
    for (std::size_t i = 0; i < wide.size(); ++i) {
      edges = WithoutEdge(edges, wide[i], (lefts >> i & 1) == 0);
    }
    ShareWeight(edges, robot.CentreOfMass());
    Extend(range, LeastPower(edges));
  }
  if (!std::isfinite(both.x + both.y + both.turn)) return std::nullopt;
  return range;
}

}  // namespace gsv
