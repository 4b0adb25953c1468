// The triangles of a static mesh. Finds the contacts of wheels and spheres with them.
//
// Sides        bodies can touch a triangle on both sides. A body is on the side on which its centre
//              is.
// Inner edges  a body that rolls over the edge between two triangles does not get stuck at the
//              edge. An edge or vertex has contacts only in directions in which no adjacent
//              triangle is nearer (Ericson, "Real-Time Collision Detection", 2005, 3.6: Voronoi
//              regions).
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "gsv/dynamics/rigid/placed_piece.h"
#include "gsv/dynamics/shapes/box_bvh.h"
#include "gsv/geometry/triangle_mesh.h"

namespace gsv::dynamics {

// The triangles of a static mesh, which wheels and spheres can touch.
class TriangleSurface {
 public:
  // Two triangles are neighbours if they share two vertices of equal positions. Triangles without
  // area are left out, as are triangles whose vertices equal those of an earlier triangle.
  TriangleSurface(const geometry::TriangleMesh& mesh, const geometry::Vector3& scale);

  // Adds the points at which a cylinder or sphere is closer than `margin` to the triangles, as
  // AddTouchPoints() of placed_piece.h does. For pieces of other kinds, it adds nothing, and
  // returns false if they may touch.
  //
  // Sphere    the nearest point of each face, edge or vertex.
  // Cylinder  for a face, the points of the cylinder's rims that are nearest to the face; for an
  //           edge, its point nearest to the cylinder's axis, and its points at the rims; all
  //           vertices.
  bool AddPoints(const PlacedPiece& piece, const PlacedPiece& mesh, double margin,
                 std::vector<TouchPoint>& points) const;

 private:
  enum class Edge : std::uint8_t {
    kOpen,   // no neighbour, or several neighbours
    kFlat,   // the neighbour is in the same plane
    kOwn,    // shared with one neighbour, and assigned to this triangle
    kOther,  // shared with one neighbour, and assigned to the neighbour
  };
  // Edges run from each corner to the next.
  struct Triangle {
    std::array<int, 3> vertices{};  // indices in vertices_
    std::array<int, 3> beside{};    // index of the same edge in the neighbour: 3 * triangle + edge,
                                    // or -1
    std::array<Edge, 3> edges{};
    geometry::Vector3 normal;  // unit length, in the mesh's frame
    // unit vectors in the plane, perpendicular to each edge
    std::array<geometry::Vector3, 3> inwards;
  };
  // Each finds the contacts of one sphere or one cylinder with the triangles.
  class SphereContacts;
  class CylinderContacts;

  // Adds a triangle without neighbours.
  void AddTriangle(const std::array<int, 3>& vertices);
  // Finds the neighbour of each edge, and whether the two triangles are in one plane.
  void JoinNeighbours();
  // Lists for each vertex the vertices with which it shares an edge.
  void ListVerticesBeside();
  const geometry::Vector3& CornerOf(const Triangle& triangle, std::size_t corner) const {
    return vertices_[static_cast<std::size_t>(triangle.vertices[corner])];
  }
  // Whether the edge or vertex is the nearest part of the surface to points in the direction
  // `normal` from it. Only then can it have a contact in this direction.
  bool MayTouchEdge(const Triangle& triangle, std::size_t edge,
                    const geometry::Vector3& normal) const;
  // Like MayTouchEdge(), for a vertex.
  bool MayTouchVertex(int vertex, const geometry::Vector3& normal) const;

  std::vector<Triangle> triangles_;
  std::vector<geometry::Vector3> vertices_;
  // for each vertex, the vertices with which it shares an edge
  std::vector<int> first_beside_, beside_;
  BoxBvh bvh_;
};

}  // namespace gsv::dynamics
