// Collision shapes in Bullet's form. Private to this folder: it includes Bullet.
//
// Exact      box, sphere, upright cylinder, capsule, cone, plane, and the triangles of a static
//            mesh.
// Not exact  a mesh that moves is replaced by the convex hulls of its connected pieces, or by one
//            hull if there are more than kMaxPieces. An ellipsoid is replaced by a hull of points
//            on its surface.
#pragma once

#include <map>
#include <memory>
#include <vector>

#include "gsv/dynamics/rigid/bullet_types.h"
#include "gsv/dynamics/rigid/triangle_surface.h"
#include "gsv/dynamics/shapes/footprint.h"
#include "gsv/geometry/shape.h"

namespace gsv::dynamics {

inline constexpr int kMaxPieces = 32;

// A mesh in the forms of TriangleSurface and Bullet, with the data that Bullet refers to. It takes
// long to make, so it is kept from one layout to the next.
struct StandingMesh {
  // the mesh before it is scaled; MeshKey refers to it
  std::shared_ptr<const geometry::TriangleMesh> source;
  std::vector<btScalar> positions;  // scaled coordinates of the vertices, for Bullet
  std::vector<int> indices;         // three vertices for each triangle, for Bullet
  std::unique_ptr<btTriangleIndexVertexArray> triangles;
  std::unique_ptr<TriangleSurface> surface;
  std::unique_ptr<btBvhTriangleMeshShape> shape;  // its user pointer points to `surface`
};

// Makes and owns Bullet's shapes of all bodies.
class RigidShapes {
 public:
  // Returns the shape of a static body; null if there is nothing to collide with. The shape is
  // valid until the next NextLayout(). A mesh is kept longer, until the second NextLayout(), so
  // that the next layout can use it again.
  btCollisionShape* Standing(const geometry::Shape& shape);

  // Returns the shapes of a moving body in the frame of `shape`: none for a plane, else one or
  // several.
  std::vector<btCollisionShape*> Moving(const geometry::Shape& shape);

  // A piece of a footprint from height `low` to its top, in the frame of its model.
  btCollisionShape* Prism(const Footprint::Piece& piece, double low,
                          geometry::Pose& model_from_shape);

  // Removes the meshes that were not used since the last call.
  void NextLayout();

 private:
  // Makes a shape of type T, which this object owns.
  template <typename T, typename... Arguments>
  T* Own(Arguments&&... arguments);
  // Returns the convex hull of the points.
  btCollisionShape* HullOf(const std::vector<geometry::Vector3>& points);
  // Returns the shape as a primitive of Bullet (an ellipsoid as a hull); null for a plane or a
  // mesh.
  btCollisionShape* Primitive(const geometry::Shape& shape);
  // Returns the shape of a mesh, and creates it on first use.
  btBvhTriangleMeshShape* MeshOf(const geometry::Mesh& mesh);

  // A mesh with its scale, for which one StandingMesh is made.
  struct MeshKey {
    const geometry::TriangleMesh* triangles;
    double x, y, z;  // scale
    // NOLINTNEXTLINE(modernize-use-nullptr)
    friend auto operator<=>(const MeshKey&, const MeshKey&) = default;
  };
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;  // all shapes of the layout except meshes
  // Meshes of this layout, and unused meshes of the previous layout. The order depends on pointers,
  // so no result may depend on it.
  std::map<MeshKey, std::unique_ptr<StandingMesh>> meshes_, used_before_;
};

}  // namespace gsv::dynamics
