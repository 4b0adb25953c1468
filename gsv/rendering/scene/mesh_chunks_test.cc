#include "gsv/rendering/scene/mesh_chunks.h"

#include <set>

#include <gtest/gtest.h>

#include "gsv/geometry/shape.h"

namespace gsv::rendering {
namespace {

geometry::TriangleMesh TwoBalls() {
  geometry::TriangleMesh mesh = geometry::Tessellate(geometry::Sphere{1}, 64);
  const auto half = static_cast<std::uint32_t>(mesh.triangles.size() / 2);
  mesh.parts = {{"south", 0, half, 0},
                {"north", half, static_cast<std::uint32_t>(mesh.triangles.size()) - half, 1}};
  return mesh;
}

TEST(CutIntoChunks, PutsEachTriangleIntoOneSmallChunkOfItsMaterial) {
  const geometry::TriangleMesh mesh = TwoBalls();
  const MeshChunks cut = CutIntoChunks(mesh, 100);
  std::set<std::uint32_t> seen;
  for (const MeshChunk& chunk : cut.chunks) {
    EXPECT_LE(chunk.triangle_count, 100u);
    for (std::uint32_t i = 0; i < chunk.triangle_count; ++i) {
      const std::uint32_t triangle = cut.order[chunk.first_triangle + i];
      EXPECT_TRUE(seen.insert(triangle).second);
      EXPECT_EQ(chunk.material, triangle < mesh.parts[1].first_triangle ? 0u : 1u);
    }
  }
  EXPECT_EQ(seen.size(), mesh.triangles.size());
}

TEST(CutIntoChunks, BoundsContainTheirTrianglesAndAreSmallerThanTheMesh) {
  const geometry::TriangleMesh mesh = TwoBalls();
  const MeshChunks cut = CutIntoChunks(mesh, 100);
  for (const MeshChunk& chunk : cut.chunks) {
    // the diagonal of the whole mesh is 2 sqrt(3)
    EXPECT_LT(Norm(chunk.bounds.max - chunk.bounds.min), 2.0);
    for (std::uint32_t i = 0; i < chunk.triangle_count; ++i) {
      for (const std::uint32_t v : mesh.triangles[cut.order[chunk.first_triangle + i]]) {
        const geometry::Vector3& p = mesh.positions[v];
        EXPECT_TRUE(p.x >= chunk.bounds.min.x && p.x <= chunk.bounds.max.x);
        EXPECT_TRUE(p.z >= chunk.bounds.min.z && p.z <= chunk.bounds.max.z);
      }
    }
  }
}

TEST(CutIntoChunks, ReturnsNoChunksForAnEmptyMesh) {
  EXPECT_TRUE(CutIntoChunks({}).chunks.empty());
}

}  // namespace
}  // namespace gsv::rendering
