// Many shapes that keep their places to each other, to cast rays against.
//
// Exactness    BoxTree only finds candidates, with padded boxes; which of them is nearest, and how
//              far, is decided here in double precision, and ties by order of addition. So results
//              depend neither on how the tree is built nor on its instruction set.
// Threads      const members may run concurrently.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "gsv/geometry/shape.h"
#include "gsv/sensing/ray_scene.h"

namespace gsv::sensing {

class BoxTree;

// The nearest surface found so far.
struct Nearest {
  double distance = 0;  // at first the ray's length
  int body = -1;        // -1: none yet
  std::uint32_t primitive = 0;
  geometry::Vector3 normal;  // in the frame of whoever found it, see `part`
  int part = -1;             // for callers that search several sets

  // Takes the hit if it is nearer; at one distance the lower body, then the lower primitive stays.
  bool Offer(double at, int whose, std::uint32_t which, const geometry::Vector3& n) {
    if (at > distance) return false;
    if (at == distance && body >= 0 && (whose > body || (whose == body && which >= primitive))) {
      return false;
    }
    distance = at, body = whose, primitive = which, normal = n;
    return true;
  }
};

class SolidSet {
 public:
  SolidSet();
  ~SolidSet();
  SolidSet(SolidSet&&) noexcept;
  SolidSet& operator=(SolidSet&&) noexcept;

  // Adds a shape of a body, before Commit().
  void Add(const geometry::Shape& shape, const geometry::Pose& set_from_shape, int body);

  // Makes the set ready for rays.
  void Commit();

  bool empty() const { return triangles_.empty() && shapes_.empty() && planes_.empty(); }
  // Holds a Plane: has no bounds.
  bool endless() const { return !planes_.empty(); }
  // Around all but the planes.
  const geometry::Bounds& bounds() const { return bounds_; }

  // Looks for what lies nearer than `nearest` along the ray, and is not of `ignored_body`. With
  // `body` at least 0 it stands for the bodies given to Add().
  void Cast(const Ray& ray, int ignored_body, Nearest& nearest, int body = -1) const;

 private:
  struct SolidTriangle {
    geometry::Vector3 corner, edge1, edge2;
    std::uint32_t primitive;
    int body;
  };
  struct SolidShape {
    geometry::Shape shape;
    geometry::Pose shape_from_set;
    geometry::Bounds bounds;  // in the set's frame
    std::uint32_t primitive;
    int body;
  };
  void AddMesh(const geometry::Mesh& mesh, const geometry::Pose& set_from_mesh, int body);
  void Include(const geometry::Bounds& bounds);
  // The candidate numbered as in the tree: shapes, then triangles.
  void CastAt(std::uint32_t candidate, const Ray& ray, int ignored_body, int body,
              Nearest& nearest) const;
  geometry::Bounds BoundsOf(std::uint32_t candidate) const;

  std::vector<SolidTriangle> triangles_;
  std::vector<SolidShape> shapes_;
  std::vector<SolidShape> planes_;
  std::uint32_t primitives_ = 0;
  geometry::Bounds bounds_;
  bool bounded_ = false;           // bounds_ holds something
  std::unique_ptr<BoxTree> tree_;  // null for a handful of candidates
};

}  // namespace gsv::sensing
