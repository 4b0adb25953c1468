#include "gsv/formats/sdf/auto_inertia.h"

#include <cmath>

#include "gsv/geometry/solid_moments.h"

namespace gsv::formats {
namespace {

using geometry::Vector3;

// The mass and the first and second moments of mass of a body, about the link's origin and along
// its axes.
struct MassMoments {
  double mass = 0;
  Vector3 first;
  Vector3 x, y, z;  // rows of the matrix of second moments
};

void AddMassOf(const model::Collision& collision, double density, MassMoments& sum) {
  const geometry::SolidMoments solid = geometry::MomentsOf(collision.shape);
  const double mass = density * solid.volume;
  const geometry::Quaternion& turn = collision.link_from_collision.orientation;
  const Vector3 centre = collision.link_from_collision * solid.centroid;
  sum.mass += mass;
  sum.first += mass * centre;
  // R S R^T: the rows of R are the link's axes in the collision's frame.
  const auto turned = [&](const Vector3& axis) {
    const Vector3 v = Inverse(turn) * axis;
    return turn * Vector3{solid.xx * v.x + solid.xy * v.y + solid.xz * v.z,
                          solid.xy * v.x + solid.yy * v.y + solid.yz * v.z,
                          solid.xz * v.x + solid.yz * v.y + solid.zz * v.z};
  };
  sum.x += density * turned({1, 0, 0}) + mass * centre.x * centre;
  sum.y += density * turned({0, 1, 0}) + mass * centre.y * centre;
  sum.z += density * turned({0, 0, 1}) + mass * centre.z * centre;
}

}  // namespace

std::optional<model::Inertial> InertialOf(const std::vector<model::Collision>& collisions,
                                          const std::vector<double>& densities) {
  MassMoments sum;
  for (std::size_t i = 0; i < collisions.size(); ++i) AddMassOf(collisions[i], densities[i], sum);
  if (!(sum.mass > 0) || !std::isfinite(sum.mass)) return std::nullopt;
  const Vector3 centre = 1 / sum.mass * sum.first;
  const Vector3 x = sum.x - sum.mass * centre.x * centre;
  const Vector3 y = sum.y - sum.mass * centre.y * centre;
  const Vector3 z = sum.z - sum.mass * centre.z * centre;
  model::Inertial inertial;
  inertial.mass = sum.mass;
  inertial.link_from_com = {centre, {}};
  inertial.ixx = y.y + z.z, inertial.iyy = x.x + z.z, inertial.izz = x.x + y.y;
  inertial.ixy = -x.y, inertial.ixz = -x.z, inertial.iyz = -y.z;
  return inertial;
}

}  // namespace gsv::formats
