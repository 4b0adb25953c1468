// Triangle meshes on the graphics card, shared by all who draw them.
//
// Threads  the render thread only.
#pragma once

#include <map>
#include <memory>
#include <tuple>
#include <vector>

#include "gsv/geometry/shape.h"
#include "gsv/rendering/gl_objects.h"
#include "gsv/rendering/mesh_chunks.h"

namespace gsv::rendering {

// `vertices` holds, for each vertex, position and normal (3 floats each) and texture coordinates
// (2 floats, (0, 0) at the picture's upper left corner) and the number of its surface (a float);
// `indices` holds 32-bit triangles.
struct GpuMesh {
  GlBuffer vertices;
  GlBuffer indices;
  std::vector<MeshChunk> chunks;
};

inline constexpr int kVertexBytes = 9 * sizeof(float);

// A shape as a mesh on the card and the stretch that makes it the shape's size: all boxes share
// one mesh.
struct ShapeOnGpu {
  std::shared_ptr<const GpuMesh> mesh;
  geometry::Vector3 scale{1, 1, 1};
};

// Keeps what it uploaded as long as somebody uses it: a file's mesh while its TriangleMesh lives,
// everything else while a ShapeOnGpu does.
class GpuMeshes {
 public:
  ShapeOnGpu Find(const geometry::Shape& shape);

  // Forgets the meshes whose TriangleMesh is gone.
  void Sweep();
  std::size_t size() const;

 private:
  struct FileMesh {
    std::weak_ptr<const geometry::TriangleMesh> triangles;
    std::shared_ptr<const GpuMesh> mesh;
  };
  using Key = std::tuple<int, double, double, double, double, double>;

  std::shared_ptr<const GpuMesh> FindFileMesh(
      const std::shared_ptr<const geometry::TriangleMesh>& triangles);
  std::shared_ptr<const GpuMesh> FindGenerated(const Key& key, const geometry::Shape& shape);

  std::map<const geometry::TriangleMesh*, FileMesh> file_meshes_;
  std::map<Key, std::weak_ptr<const GpuMesh>> generated_;
};

}  // namespace gsv::rendering
