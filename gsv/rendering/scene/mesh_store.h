// Triangle meshes as a back end draws them, shared by all who draw them.
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

inline constexpr int kVertexFloats = 9;

// `vertices` holds, for each vertex, position and normal (3 floats each) and texture coordinates
// (2 floats, (0, 0) at the picture's upper left corner) and the number of its surface (a float);
// `indices` holds triangles, chunk after chunk.
struct MeshArrays {
  std::vector<float> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<MeshChunk> chunks;
};

// A mesh as a back end keeps it; each has its own kind.
struct DrawMesh {
  virtual ~DrawMesh() = default;
  std::vector<MeshChunk> chunks;
};

// A shape as a mesh and the stretch that makes it the shape's size: all boxes share one mesh.
struct DrawShape {
  std::shared_ptr<const DrawMesh> mesh;
  geometry::Vector3 scale{1, 1, 1};
};

// Keeps what was made as long as somebody uses it: a file's mesh while its TriangleMesh lives,
// everything else while a DrawShape does.
class MeshStore {
 public:
  using Make = std::function<std::shared_ptr<const DrawMesh>(MeshArrays)>;
  explicit MeshStore(Make make) : make_(std::move(make)) {}

  DrawShape Find(const geometry::Shape& shape);

  // Forgets the meshes whose TriangleMesh is gone.
  void Sweep();
  std::size_t size() const;

 private:
  struct FileMesh {
    std::weak_ptr<const geometry::TriangleMesh> triangles;
    std::shared_ptr<const DrawMesh> mesh;
  };
  using Key = std::tuple<int, double, double, double, double, double>;

  std::shared_ptr<const DrawMesh> FindFileMesh(
      const std::shared_ptr<const geometry::TriangleMesh>& triangles);
  std::shared_ptr<const DrawMesh> FindGenerated(const Key& key, const geometry::Shape& shape);

  const Make make_;
  std::map<const geometry::TriangleMesh*, FileMesh> file_meshes_;
  std::map<Key, std::weak_ptr<const DrawMesh>> generated_;
};

}  // namespace gsv::rendering
