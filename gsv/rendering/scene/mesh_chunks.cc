#include "gsv/rendering/scene/mesh_chunks.h"

#include <algorithm>
#include <map>

namespace gsv::rendering {
namespace {

using geometry::Bounds;
using geometry::Vector3;

class Cutter {
 public:
  Cutter(const geometry::TriangleMesh& mesh, std::uint32_t most) : mesh_(mesh), most_(most) {}

  void Cut(const std::vector<std::uint32_t>& triangles, std::uint32_t material) {
    const auto first = static_cast<std::uint32_t>(result_.order.size());
    result_.order.insert(result_.order.end(), triangles.begin(), triangles.end());
    CutRun(first, static_cast<std::uint32_t>(triangles.size()), material);
  }

  MeshChunks Take() { return std::move(result_); }

 private:
  // Divides a run of triangles into two halves: at the median of their centroids along the longest
  // side of their bounding box. Repeats this until each run has at most most_ triangles.
  void CutRun(std::uint32_t first, std::uint32_t count, std::uint32_t material) {
    if (count == 0) return;
    const Bounds bounds = BoundsOf(first, count);
    if (count <= most_) {
      result_.chunks.push_back({first, count, material, bounds});
      return;
    }
    const Vector3 size = bounds.max - bounds.min;
    const auto coordinate = [&](const Vector3& p) {
      return size.x >= size.y && size.x >= size.z ? p.x : size.y >= size.z ? p.y : p.z;
    };
    const auto begin = result_.order.begin() + first, middle = begin + count / 2;
    std::nth_element(begin, middle, begin + count, [&](std::uint32_t a, std::uint32_t b) {
      return coordinate(Centroid(a)) < coordinate(Centroid(b));
    });
    CutRun(first, count / 2, material);
    CutRun(first + count / 2, count - count / 2, material);
  }

  Vector3 Centroid(std::uint32_t triangle) const {
    const auto& t = mesh_.triangles[triangle];
    return mesh_.positions[t[0]] + mesh_.positions[t[1]] + mesh_.positions[t[2]];
  }

  Bounds BoundsOf(std::uint32_t first, std::uint32_t count) const {
    const Vector3 start = mesh_.positions[mesh_.triangles[result_.order[first]][0]];
    Bounds b{start, start};
    for (std::uint32_t i = first; i < first + count; ++i) {
      for (const std::uint32_t vertex : mesh_.triangles[result_.order[i]]) {
        const Vector3& p = mesh_.positions[vertex];
        b.min = {std::min(b.min.x, p.x), std::min(b.min.y, p.y), std::min(b.min.z, p.z)};
        b.max = {std::max(b.max.x, p.x), std::max(b.max.y, p.y), std::max(b.max.z, p.z)};
      }
    }
    return b;
  }

  const geometry::TriangleMesh& mesh_;
  std::uint32_t most_;
  MeshChunks result_;
};

}  // namespace

MeshChunks CutIntoChunks(const geometry::TriangleMesh& mesh, std::uint32_t max_triangles) {
  std::map<std::uint32_t, std::vector<std::uint32_t>> of_material;
  for (const geometry::MeshPart& part : mesh.parts) {
    auto& triangles = of_material[part.material];
    for (std::uint32_t i = 0; i < part.triangle_count; ++i) {
      triangles.push_back(part.first_triangle + i);
    }
  }
  Cutter cutter(mesh, max_triangles);
  for (const auto& [material, triangles] : of_material) cutter.Cut(triangles, material);
  return cutter.Take();
}

}  // namespace gsv::rendering
