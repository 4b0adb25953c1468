// A cache of a back end's triangle meshes.
//
// Threads  the render thread only.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "gsv/geometry/shape.h"
#include "gsv/rendering/scene/mesh_chunks.h"

namespace gsv::rendering {

inline constexpr int kVertexFloats = 9;  // number of floats of one vertex, see MeshArrays

// `vertices` has 9 floats for each vertex: 3 for the position, 3 for the normal, 2 for texture
// coordinates ((0, 0) at the image's upper left corner), and the number of its surface. `indices`
// has the triangles, chunk after chunk.
struct MeshArrays {
  std::vector<float> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<MeshChunk> chunks;
};

// Base class of a back end's mesh.
struct DrawMesh {
  virtual ~DrawMesh() = default;
  std::vector<MeshChunk> chunks;
};

// A shape as a mesh and a scale. For example, all boxes share one mesh.
struct DrawShape {
  std::shared_ptr<const DrawMesh> mesh;
  geometry::Vector3 scale{1, 1, 1};
};

// Keeps the mesh of a file during the lifetime of its TriangleMesh. Keeps other meshes during the
// lifetime of a DrawShape that uses them.
class MeshStore {
 public:
  // Makes the back end's mesh of these arrays.
  using Make = std::function<std::shared_ptr<const DrawMesh>(MeshArrays)>;
  explicit MeshStore(Make make) : make_(std::move(make)) {}

  // Returns the mesh of a shape, and makes it on first use.
  DrawShape Find(const geometry::Shape& shape);

  // Removes the meshes whose TriangleMesh, or whose last DrawShape, was destroyed.
  void Sweep();
  std::size_t size() const;

 private:
  // A cached mesh of a file.
  struct FileMesh {
    std::weak_ptr<const geometry::TriangleMesh> triangles;
    std::shared_ptr<const DrawMesh> mesh;
  };
  // The kind and the dimensions of a generated shape.
  using Key = std::tuple<int, double, double, double, double, double>;

  // FindFileMesh() returns the mesh of a file, and FindGenerated() the mesh of a shape such as a
  // box. The mesh is made on first use.
  std::shared_ptr<const DrawMesh> FindFileMesh(
      const std::shared_ptr<const geometry::TriangleMesh>& triangles);
  // Returns the mesh of a shape such as a box; makes it on first use.
  std::shared_ptr<const DrawMesh> FindGenerated(const Key& key, const geometry::Shape& shape);

  const Make make_;  // makes the back end's meshes
  // by the mesh that was read from a file
  std::map<const geometry::TriangleMesh*, FileMesh> file_meshes_;
  std::map<Key, std::weak_ptr<const DrawMesh>> generated_;  // meshes of shapes such as boxes
};

}  // namespace gsv::rendering
