// Many shapes that keep their places to each other, to cast rays against.
//
// Exactness    BoxIndex only finds candidates, with padded boxes; which of them is nearest, and how
//              far, is decided here in double precision, and ties by order of addition. So results
//              depend neither on how the boxes are arranged nor on the instruction set.
// Threads      const members may run concurrently.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "gsv/geometry/shape.h"
#include "gsv/sensing/rays/box_index.h"
#include "gsv/sensing/rays/candidate_set.h"
#include "gsv/sensing/rays/ray_scene.h"

namespace gsv::sensing {

// Whose solids a set holds, when it stands for one part of a moving body.
struct Bearer {
  int body = -1;  // -1: those given to Add()
  int part = -1;  // in the scene
  std::uint32_t first_primitive = 0;
};

// The nearest surface found so far.
struct Nearest {
  double distance = 0;  // at first the ray's length
  int body = -1;        // -1: none yet
  std::uint32_t primitive = 0;
  int part = -1;            // the bearer's
  std::uint32_t solid = 0;  // in its set, see SolidSet::NormalAt()

  // Takes the hit if it is nearer; at one distance the lower body, then the lower primitive stays.
  void Offer(double at, int whose, std::uint32_t which, int of_part, std::uint32_t in_set) {
    if (at > distance) return;
    if (at == distance && body >= 0 && (whose > body || (whose == body && which >= primitive))) {
      return;
    }
    *this = {at, whose, which, of_part, in_set};
  }
};

// Rays from one place, their directions in a set's frame, and what each has found.
struct RayBatch {
  static constexpr std::size_t kMax = 32;
  std::size_t count = 0;
  std::array<geometry::Vector3, kMax> directions;
  std::array<Nearest*, kMax> nearest;
  // Room for those who cast them.
  std::array<Ray, kMax> in_shape;
  std::array<double, kMax> distances;
};

class SolidSet {
 public:
  // Adds a shape of a body, before Commit().
  void Add(const geometry::Shape& shape, const geometry::Pose& set_from_shape, int body);

  // Makes the set ready for rays.
  void Commit();

  bool empty() const { return triangles_.empty() && shapes_.empty() && planes_.empty(); }
  // Holds a Plane: has no bounds.
  bool endless() const { return !planes_.empty(); }
  // Around all but the planes.
  const geometry::Bounds& bounds() const { return bounds_; }
  // The same.
  BoundingSphere ball() const;

  // Looks for what lies nearer than `nearest` along the ray, and is not of `ignored_body`.
  void Cast(const Ray& ray, int ignored_body, Nearest& nearest, const Bearer& bearer = {}) const;

  // The same in pieces: the shapes, at once or one by one, and the rest.
  void CastAtShapes(const Ray& ray, int ignored_body, Nearest& nearest,
                    const Bearer& bearer = {}) const;
  void CastAtShape(std::uint32_t shape, const Ray& ray, int ignored_body, Nearest& nearest,
                   const Bearer& bearer = {}) const;
  void CastAtOthers(const Ray& ray, int ignored_body, Nearest& nearest,
                    const Bearer& bearer = {}) const;

  // How many shapes make up the set; 0 if there is something else.
  std::uint32_t ShapesAlone() const {
    if (!planes_.empty() || !triangles_.empty()) return 0;
    return static_cast<std::uint32_t>(shapes_.size());
  }
  // CastAtShape() for rays from one place, in the shape's frame. Nobody's body is ignored.
  void CastAtShapeFrom(const geometry::Vector3& origin_in_shape, RayBatch& rays,
                       std::uint32_t shape, const Bearer& bearer = {}) const;
  // False if CastAtOthers() finds nothing for any ray of a fan in the set's frame.
  bool OthersReach(const Fan& fan) const;
  // Whether a shape may reach into a box: of one that is long and thin its ball says little.
  bool ShapeReaches(std::uint32_t shape, const geometry::Bounds& into) const {
    const geometry::Bounds& b = shape_bounds_[shape];
    return b.min.x <= into.max.x && into.min.x <= b.max.x && b.min.y <= into.max.y &&
           into.min.y <= b.max.y && b.min.z <= into.max.z && into.min.z <= b.max.z;
  }

  // Adds to `found` the shapes that come within `reach` of the place, and some others; false if
  // that cannot be done quickly.
  bool Near(const geometry::Vector3& place, double reach, FoundBoxes& found) const {
    return shape_index_.Near(place, reach, found);
  }
  int BodyOfShape(std::uint32_t shape) const { return shapes_[shape].body; }
  const BoundingSphere& SphereOfShape(std::uint32_t shape) const { return shape_spheres_[shape]; }
  const geometry::Pose& ShapeFromSet(std::uint32_t shape) const {
    return shapes_[shape].shape_from_set;
  }
  // Around the shape, in its own frame.
  const geometry::Bounds& OwnBoundsOfShape(std::uint32_t shape) const {
    return shape_own_bounds_[shape];
  }

  // Adds the shapes within `surroundings`, their numbers marked by `mark`; false if that cannot be
  // done quickly.
  bool Gather(CandidateSet& candidates, std::uint32_t mark) const;

  // The normal, against the ray, where the ray meets the solid that Nearest names.
  geometry::Vector3 NormalAt(std::uint32_t solid, const Ray& ray) const;

 private:
  struct SolidTriangle {
    geometry::Vector3 corner, edge1, edge2;
    std::uint32_t primitive;
    int body;
  };
  struct SolidShape {
    geometry::Shape shape;
    geometry::Pose shape_from_set;
    std::uint32_t primitive;
    int body;
  };
  struct SolidPlane {
    SolidShape solid;
    geometry::Vector3 normal;  // in the set's frame
    double offset;             // along it
  };
  void AddMesh(const geometry::Mesh& mesh, const geometry::Pose& set_from_mesh, int body);
  void Include(const geometry::Bounds& bounds);
  // Of the solid of that number: the shapes, then the planes, then the triangles.
  static void CastAt(const SolidShape& shape, std::uint32_t solid, const Ray& ray, int ignored_body,
                     Nearest& nearest, const Bearer& bearer);
  void CastAtPlanes(const Ray& ray, int ignored_body, Nearest& nearest, const Bearer& bearer) const;
  void CastAtTriangles(const Ray& ray, int ignored_body, Nearest& nearest,
                       const Bearer& bearer) const;

  std::vector<SolidTriangle> triangles_;
  std::unique_ptr<BoundingVolumeTree> triangle_tree_;  // null for a handful
  std::vector<SolidShape> shapes_;
  std::vector<geometry::Bounds> shape_bounds_;      // padded, in the set's frame
  std::vector<BoundingSphere> shape_spheres_;       // padded, in the set's frame
  std::vector<geometry::Bounds> shape_own_bounds_;  // in the shape's frame
  BoxIndex shape_index_;
  std::vector<SolidPlane> planes_;
  std::uint32_t primitives_ = 0;
  geometry::Bounds bounds_;
  bool bounded_ = false;  // bounds_ holds something
};

}  // namespace gsv::sensing
