#include "gsv/dynamics/motion/medium_forces.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "gsv/geometry/solid_moments.h"

namespace gsv::dynamics {
namespace {

using geometry::Pose;
using geometry::Vector3;

constexpr int kSegmentsAround = 24;

// The fluid that a body displaces: its mass (kg), and its first moment (the integral of the
// position over the mass, kg m).
struct Displaced {
  double mass = 0;
  Vector3 moment;
};

bool IsLifted(const model::Fluid& fluid, const std::string& body, const std::string& link) {
  if (fluid.lifted.empty()) return true;
  return std::any_of(fluid.lifted.begin(), fluid.lifted.end(), [&](const std::string& name) {
    return name == body || name == body + "::" + link;
  });
}

Displacer DisplacerOf(const geometry::Shape& shape, const Pose& part_from_shape, bool has_layers) {
  const geometry::SolidMoments moments = geometry::MomentsOf(shape);
  Displacer displacer;
  displacer.volume = moments.volume;
  displacer.centre = part_from_shape * moments.centroid;
  if (!has_layers) return displacer;
  if (const auto* sphere = std::get_if<geometry::Sphere>(&shape)) {
    displacer.radius = displacer.reach = sphere->radius;
    return displacer;
  }
  displacer.surface = geometry::Tessellate(shape, kSegmentsAround);
  displacer.volume_of_surface =
      geometry::MomentsOf(
          geometry::Mesh{std::make_shared<const geometry::TriangleMesh>(displacer.surface)})
          .volume;
  for (Vector3& position : displacer.surface.positions) {
    position = part_from_shape * position;
    displacer.reach = std::max(displacer.reach, Norm(position - displacer.centre));
  }
  return displacer;
}

// The volume of a displacer (a collision shape that displaces fluid) below a height, and the first
// moment of this volume.
geometry::VolumeBelow DisplacedBelow(const Displacer& displacer, const Pose& world_from_part,
                                     double height) {
  const Vector3 centre = world_from_part * displacer.centre;
  if (centre.z - displacer.reach >= height) return {};
  if (centre.z + displacer.reach <= height) return {displacer.volume, displacer.volume * centre};
  if (displacer.radius > 0) {
    return geometry::SphereBelowHeight(displacer.radius, centre, height);
  }
  if (!(displacer.volume_of_surface > 0)) return {};
  geometry::VolumeBelow below = geometry::BelowHeight(displacer.surface, world_from_part, height);
  const double scale = displacer.volume / displacer.volume_of_surface;
  below.volume *= scale;
  below.first_moment *= scale;
  return below;
}

// Begins as if the top layer's fluid were everywhere. Then adds, for each boundary between two
// layers, the difference of their densities times the volume below the boundary.
Displaced DisplacedBy(const Displacer& displacer, const Pose& world_from_part,
                      const model::Fluid& fluid) {
  const Vector3 centre = world_from_part * displacer.centre;
  const double above_all = fluid.layers.empty() ? fluid.density : fluid.layers.back().density;
  Displaced displaced{above_all * displacer.volume, above_all * displacer.volume * centre};
  for (std::size_t i = 0; i < fluid.layers.size(); ++i) {
    const double under = i == 0 ? fluid.density : fluid.layers[i - 1].density;
    const double denser = under - fluid.layers[i].density;
    const auto below = DisplacedBelow(displacer, world_from_part, fluid.layers[i].above);
    displaced.mass += denser * below.volume;
    displaced.moment += denser * below.first_moment;
  }
  return displaced;
}

// The fraction of the velocity that is lost after `seconds`.
double ShareLost(double decay, double seconds, double world_step) {
  return decay > 0 ? 1 - std::pow(1 - decay, seconds / world_step) : 0;
}

void AddDecay(const PartMedium& medium, const Part& part, const PartMotion& motion,
              double world_step, double seconds, Wrench& wrench) {
  const double linear = ShareLost(medium.linear_decay, seconds, world_step) / seconds;
  const double angular = ShareLost(medium.angular_decay, seconds, world_step) / seconds;
  wrench.force -= linear * part.mass * motion.velocity;
  if (angular == 0) return;
  const auto& world_from_part = motion.world_from_part.orientation;
  const Vector3 turning = Inverse(world_from_part) * motion.angular_velocity;
  wrench.torque -= angular * (world_from_part * Scaled(turning, part.inertia));
}

}  // namespace

std::vector<PartMedium> MakeMedium(const world::Layout& layout, const world::Body& body,
                                   const Articulation& articulation) {
  const model::WorldDescription& world = *layout.description;
  std::vector<PartMedium> media(articulation.parts.size());
  bool any = false;
  for (std::size_t p = 0; p < media.size(); ++p) {
    const Part& part = articulation.parts[p];
    const Pose part_from_model = Inverse(part.model_from_part);
    PartMedium& medium = media[p];
    for (const int l : part.links) {
      const model::Link& link = body.model->links[static_cast<std::size_t>(l)];
      const double share = part.mass > 0 ? link.inertial.mass / part.mass : 0;
      medium.linear_decay += share * link.linear_decay;
      medium.angular_decay += share * link.angular_decay;
      if (world.wind && link.has_wind) medium.mass_in_wind += link.inertial.mass;
      if (!world.fluid || !IsLifted(*world.fluid, body.name, link.name)) continue;
      for (const model::Collision& collision : link.collisions) {
        if (std::holds_alternative<geometry::Plane>(collision.shape)) continue;
        medium.displacers.push_back(DisplacerOf(
            collision.shape, part_from_model * link.model_from_link * collision.link_from_collision,
            !world.fluid->layers.empty()));
      }
    }
    any = any || medium.linear_decay > 0 || medium.angular_decay > 0 || medium.mass_in_wind > 0 ||
          !medium.displacers.empty();
  }
  if (!any) media.clear();
  return media;
}

Wrench WrenchOf(const PartMedium& medium, const Part& part, const PartMotion& motion,
                const model::WorldDescription& world, double seconds) {
  Wrench wrench;
  AddDecay(medium, part, motion, base::ToSeconds(world.max_step_size), seconds, wrench);
  if (world.wind) {
    wrench.force +=
        world.wind->drag * medium.mass_in_wind * (world.wind->velocity - motion.velocity);
  }
  if (!world.fluid) return wrench;
  for (const Displacer& displacer : medium.displacers) {
    const Displaced displaced = DisplacedBy(displacer, motion.world_from_part, *world.fluid);
    wrench.force -= displaced.mass * world.gravity;
    // The torque is about the part's centre of mass.
    wrench.torque -=
        Cross(displaced.moment - displaced.mass * motion.world_from_part.position, world.gravity);
  }
  return wrench;
}

}  // namespace gsv::dynamics
