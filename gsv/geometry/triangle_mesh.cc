#include "gsv/geometry/triangle_mesh.h"

#include <algorithm>

namespace gsv::geometry {

Bounds BoundsOf(const TriangleMesh& mesh) {
  if (mesh.positions.empty()) return {};
  Bounds bounds{mesh.positions.front(), mesh.positions.front()};
  for (const Vector3& p : mesh.positions) {
    bounds.min = {std::min(bounds.min.x, p.x), std::min(bounds.min.y, p.y),
                  std::min(bounds.min.z, p.z)};
    bounds.max = {std::max(bounds.max.x, p.x), std::max(bounds.max.y, p.y),
                  std::max(bounds.max.z, p.z)};
  }
  return bounds;
}

}  // namespace gsv::geometry
