// For tests: random shapes, and brute-force ray casting.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "gsv/base/random.h"
#include "gsv/sensing/rays/ray_shape.h"
#include "gsv/world/snapshot.h"

namespace gsv::sensing::testing {

// Pseudorandom numbers, points and poses.
class Random {
 public:
  explicit Random(std::uint64_t seed) : noise_(seed, 0, 0) {}
  double Uniform(double low, double high) { return low + (high - low) * noise_.Uniform(); }
  geometry::Vector3 Point(double extent) {
    return {Uniform(-extent, extent), Uniform(-extent, extent), Uniform(-extent, extent)};
  }
  geometry::Pose AnyPose(double extent) {
    return {Point(extent),
            geometry::FromRollPitchYaw({Uniform(-3, 3), Uniform(-1.5, 1.5), Uniform(-3, 3)})};
  }

 private:
  base::Noise noise_;
};

// Returns triangles at random places, with sides of about `size`.
inline geometry::Mesh RandomMesh(Random& random, int triangles, double size) {
  auto mesh = std::make_shared<geometry::TriangleMesh>();
  for (int i = 0; i < triangles; ++i) {
    const geometry::Vector3 middle = random.Point(1);
    for (int k = 0; k < 3; ++k) mesh->positions.push_back(middle + random.Point(size));
    const auto first = static_cast<std::uint32_t>(3 * i);
    mesh->triangles.push_back({first, first + 1, first + 2});
  }
  return {mesh, {1.5, 1, 0.5}};
}

// Returns the distance to a triangle; -1 without a hit. Unlike the code that is tested, it compares
// areas: the point is in the triangle if the three parts around it are together no larger.
inline double ByAreas(const Ray& ray, const geometry::Vector3& a, const geometry::Vector3& b,
                      const geometry::Vector3& c) {
  const geometry::Vector3 normal = Cross(b - a, c - a);
  const double approach = Dot(normal, ray.direction);
  if (approach == 0) return -1;
  const double distance = Dot(normal, a - ray.origin) / approach;
  if (distance < 0 || distance > ray.max_distance) return -1;
  const geometry::Vector3 p = ray.origin + distance * ray.direction;
  const double whole = Norm(normal);
  const double parts =
      Norm(Cross(b - p, c - p)) + Norm(Cross(c - p, a - p)) + Norm(Cross(a - p, b - p));
  return parts <= whole * (1 + 1e-9) ? distance : -1;
}

// Tests every collision of every body.
inline std::optional<Hit> BruteForce(const world::Snapshot& snapshot, const Ray& ray,
                                     int ignored_body) {
  std::optional<Hit> best;
  const auto offer = [&](double distance, int body) {
    if (distance >= 0 && (!best || distance < best->distance)) best = Hit{distance, {}, body};
  };
  for (int body = 0; body < static_cast<int>(snapshot.layout->bodies.size()); ++body) {
    if (body == ignored_body) continue;
    const std::vector<geometry::Pose> world_from_link = world::LinkPoses(snapshot, body);
    const model::Model& model = *snapshot.layout->bodies[body].model;
    for (std::size_t link = 0; link < model.links.size(); ++link) {
      for (const model::Collision& collision : model.links[link].collisions) {
        const geometry::Pose world_from_shape =
            world_from_link[link] * collision.link_from_collision;
        if (const auto* mesh = std::get_if<geometry::Mesh>(&collision.shape)) {
          for (const auto& t : mesh->triangles->triangles) {
            const auto corner = [&](int i) {
              return world_from_shape * Scaled(mesh->triangles->positions[t[i]], mesh->scale);
            };
            offer(ByAreas(ray, corner(0), corner(1), corner(2)), body);
          }
          continue;
        }
        const geometry::Pose shape_from_world = Inverse(world_from_shape);
        const auto hit =
            DistanceToShape({shape_from_world * ray.origin,
                             shape_from_world.orientation * ray.direction, ray.max_distance},
                            collision.shape);
        if (hit) offer(*hit, body);
      }
    }
  }
  return best;
}

}  // namespace gsv::sensing::testing
