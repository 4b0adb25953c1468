// A set of shapes with fixed relative poses, for ray casting.
//
// Exactness    BoxIndex finds only candidates, with padded boxes. The nearest hit and its distance
//              are computed here in double precision. At equal distances, the solid that was added
//              first counts. So results depend neither on the index nor on the instruction set.
// Threads      const members may run concurrently.
#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "gsv/geometry/shape.h"
#include "gsv/sensing/rays/box_index.h"
#include "gsv/sensing/rays/candidate_set.h"
#include "gsv/sensing/rays/ray_scene.h"
#include "gsv/sensing/rays/sphere_grid.h"

namespace gsv::sensing {

// The body that a set belongs to, if the set is one part of a moving body.
struct Bearer {
  int body = -1;  // body of all shapes; -1: each shape has its own body, which Add() sets
  int part = -1;  // index of the part in the scene
  // Added to the primitive index of each shape, so that the indices of one body's parts differ.
  std::uint32_t first_primitive = 0;
};

// The nearest surface found so far.
struct Nearest {
  double distance = 0;  // initially the length of the ray
  int body = -1;        // -1: nothing found yet
  // Primitive index of the hit shape or triangle. It decides between hits at equal distances.
  std::uint32_t primitive = 0;
  int part = -1;            // Bearer::part of the hit set
  std::uint32_t solid = 0;  // number of the solid in its set, for SolidSet::NormalAt()

  // Stores the hit if it is nearer than the stored hit. At equal distances, the hit with the lower
  // body index is kept, and then the hit with the lower primitive index.
  void Offer(double at, int whose, std::uint32_t which, int of_part, std::uint32_t in_set) {
    if (at > distance) return;
    if (at == distance && body >= 0 && (whose > body || (whose == body && which >= primitive))) {
      return;
    }
    *this = {at, whose, which, of_part, in_set};
  }
};

// A set of shapes at which rays are cast.
class SolidSet {
 public:
  // Adds a shape of a body, before Commit(). `reflectance` is the fraction of light that its
  // surface reflects.
  void Add(const geometry::Shape& shape, const geometry::Pose& set_from_shape, int body,
           float reflectance = 0.5f);

  // Builds the index. Call it before casting rays.
  void Commit();

  bool empty() const { return triangles_.empty() && shapes_.empty() && planes_.empty(); }
  // Whether the set contains a Plane, and so is unbounded.
  bool endless() const { return !planes_.empty(); }
  // The bounding box of everything except the planes.
  const geometry::Bounds& bounds() const { return bounds_; }
  // The bounding sphere.
  BoundingSphere ball() const;

  // Finds a hit on the ray that is nearer than `nearest`. Ignores the shapes of `ignored_body`.
  void Cast(const Ray& ray, int ignored_body, Nearest& nearest, const Bearer& bearer = {}) const;

  // These three functions cast the ray at a part of the set: at all shapes, at one shape, or at all
  // planes and triangles.
  void CastAtShapes(const Ray& ray, int ignored_body, Nearest& nearest,
                    const Bearer& bearer = {}) const;
  // Casts the ray at one shape.
  void CastAtShape(std::uint32_t shape, const Ray& ray, int ignored_body, Nearest& nearest,
                   const Bearer& bearer = {}) const;
  // Casts the ray at all planes and triangles.
  void CastAtOthers(const Ray& ray, int ignored_body, Nearest& nearest,
                    const Bearer& bearer = {}) const;

  // Returns the number of shapes if the set contains only shapes; otherwise 0.
  std::uint32_t ShapesAlone() const {
    if (!planes_.empty() || !triangles_.empty()) return 0;
    return static_cast<std::uint32_t>(shapes_.size());
  }
  // Whether CastAtOthers() may find a hit for a ray of the fan. The fan is in the set's frame.
  bool OthersReach(const Fan& fan) const;
  // Returns a box around a shape, in the set's frame, a little larger than necessary.
  const geometry::Bounds& PaddedBoundsOf(std::uint32_t shape) const { return shape_bounds_[shape]; }
  // Whether a shape may extend into a box. For long shapes, this test is stricter than the bounding
  // sphere.
  bool ShapeReaches(std::uint32_t shape, const geometry::Bounds& into) const {
    const geometry::Bounds& b = shape_bounds_[shape];
    return b.min.x <= into.max.x && into.min.x <= b.max.x && b.min.y <= into.max.y &&
           into.min.y <= b.max.y && b.min.z <= into.max.z && into.min.z <= b.max.z;
  }

  // Adds the shapes within `reach` (m) of `place` to `found`. May also add shapes further away.
  // Returns false if there is no space in `found`, or no fast method for these shapes.
  bool Near(const geometry::Vector3& place, double reach, FoundBoxes& found) const {
    return shape_index_.Near(place, reach, found);
  }
  int BodyOfShape(std::uint32_t shape) const { return shapes_[shape].body; }
  const BoundingSphere& SphereOfShape(std::uint32_t shape) const { return shape_spheres_[shape]; }
  const geometry::Pose& ShapeFromSet(std::uint32_t shape) const {
    return shapes_[shape].shape_from_set;
  }
  const geometry::Shape& ShapeAt(std::uint32_t shape) const { return shapes_[shape].shape; }
  // The bounding box of the shape in its own frame.
  const geometry::Bounds& OwnBoundsOfShape(std::uint32_t shape) const {
    return shape_own_bounds_[shape];
  }

  // Finds the shapes that a packet may touch; see SphereGrid.
  bool FindTouched(const PacketSearch& search, TouchedSpheres& found) const {
    return shape_grid_.FindTouched(search, found);
  }
  // Whether the set contains planes or triangles, which CastAtOthers() tests.
  bool HasOthers() const { return !planes_.empty() || !triangles_.empty(); }

  // Adds to `candidates` the shapes within the reach of `candidates`. The number of each shape is
  // combined with `mark` by a bitwise OR. Returns false, and adds nothing, if this set has no fast
  // search.
  bool Gather(CandidateSet& candidates, std::uint32_t mark) const;

  // Returns the surface normal, against the ray, at the point where the ray hits the solid with
  // this number (Nearest::solid).
  geometry::Vector3 NormalAt(std::uint32_t solid, const Ray& ray) const;
  // Returns the reflectance of the solid with this number (Nearest::solid).
  float ReflectanceOf(std::uint32_t solid) const;

 private:
  // A triangle of the set: a corner, and the edges from there to the other corners. All are in the
  // set's frame.
  struct SolidTriangle {
    geometry::Vector3 corner, edge1, edge2;
    std::uint32_t primitive;  // primitive index, see Nearest
    int body;                 // index in the layout; not used if the bearer has a body
  };
  // A shape of the set that is not a mesh.
  struct SolidShape {
    geometry::Shape shape;
    geometry::Pose shape_from_set;  // transforms rays to the shape's frame
    std::uint32_t primitive;        // primitive index, see Nearest
    int body;                       // index in the layout; not used if the bearer has a body
  };
  // A plane of the set.
  struct SolidPlane {
    SolidShape solid;
    geometry::Vector3 normal;  // normal in the set's frame
    double offset;             // distance of the plane from the origin along the normal, m
  };
  // Adds the triangles of a mesh.
  void AddMesh(const geometry::Mesh& mesh, const geometry::Pose& set_from_mesh, int body);
  // Extends bounds_ so that it contains these bounds.
  void Include(const geometry::Bounds& bounds);
  // Cast a ray at one shape, at all planes or at all triangles. The numbers of solids (`solid`)
  // begin with the shapes. The planes follow, and then the triangles.
  static void CastAt(const SolidShape& shape, std::uint32_t solid, const Ray& ray, int ignored_body,
                     Nearest& nearest, const Bearer& bearer);
  void CastAtPlanes(const Ray& ray, int ignored_body, Nearest& nearest, const Bearer& bearer) const;
  void CastAtTriangles(const Ray& ray, int ignored_body, Nearest& nearest,
                       const Bearer& bearer) const;

  std::vector<SolidTriangle> triangles_;
  std::unique_ptr<BoundingVolumeTree> triangle_tree_;  // null if there are few triangles
  std::vector<SolidShape> shapes_;
  std::vector<geometry::Bounds> shape_bounds_;      // padded, in the set's frame
  std::vector<BoundingSphere> shape_spheres_;       // padded, in the set's frame
  std::vector<geometry::Bounds> shape_own_bounds_;  // in the frame of each shape
  BoxIndex shape_index_;                            // finds the shapes near a ray, by shape_bounds_
  SphereGrid shape_grid_;  // finds the shapes near a packet of rays, by shape_spheres_
  std::vector<SolidPlane> planes_;
  // in the order of shapes_ and planes_
  std::vector<float> shape_reflectances_, plane_reflectances_;
  // The first triangle of each mesh with the reflectance of the mesh.
  std::vector<std::pair<std::uint32_t, float>> mesh_reflectances_;
  std::uint32_t primitives_ = 0;  // number of primitives that were added
  geometry::Bounds bounds_;       // see bounds()
  bool bounded_ = false;          // whether bounds_ is valid
};

}  // namespace gsv::sensing
