#include "gsv/formats/meshes/polyline.h"

#include <algorithm>
#include <cmath>

#include "gsv/formats/meshes/polygon_triangulation.h"

namespace gsv::formats {
namespace {

using base::ErrorCode;
using geometry::TriangleMesh;
using geometry::Vector2;
using geometry::Vector3;

constexpr std::size_t kMaxPoints = 4096;

bool Contains(const Outline& outline, const Vector2& p) {
  bool inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    if ((a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)) {
      inside = !inside;
    }
  }
  return inside;
}

Outline WithoutRepeatedPoints(const Outline& outline) {
  Outline points;
  for (const Vector2& point : outline) {
    if (points.empty() || !(points.back() == point)) points.push_back(point);
  }
  while (points.size() > 1 && points.front() == points.back()) points.pop_back();
  return points;
}

// An outline, and the holes directly inside it.
struct Region {
  Outline outer;
  std::vector<Outline> holes;
};

std::vector<Region> ToRegions(const std::vector<Outline>& outlines) {
  const std::size_t n = outlines.size();
  std::vector<std::vector<std::size_t>> around(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      if (k != i && Contains(outlines[k], outlines[i].front())) around[i].push_back(k);
    }
  }
  std::vector<Region> regions;
  for (std::size_t i = 0; i < n; ++i) {
    if (around[i].size() % 2 != 0) continue;
    Region region{outlines[i], {}};
    if (TwiceSignedArea(region.outer) < 0) std::reverse(region.outer.begin(), region.outer.end());
    for (std::size_t k = 0; k < n; ++k) {
      const bool directly_inside =
          around[k].size() == around[i].size() + 1 &&
          std::find(around[k].begin(), around[k].end(), i) != around[k].end();
      if (!directly_inside) continue;
      Outline hole = outlines[k];
      if (TwiceSignedArea(hole) > 0) std::reverse(hole.begin(), hole.end());
      region.holes.push_back(std::move(hole));
    }
    regions.push_back(std::move(region));
  }
  return regions;
}

// Walls have separate vertices, so that edges have sharp normals.
void AddWalls(const Outline& outline, double height, TriangleMesh& mesh) {
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    const Vector3 outward = geometry::Normalized(Vector3{b.y - a.y, a.x - b.x, 0});
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Vector3& p : {Vector3{a.x, a.y, 0}, Vector3{b.x, b.y, 0}, Vector3{b.x, b.y, height},
                             Vector3{a.x, a.y, height}}) {
      mesh.positions.push_back(p);
      mesh.normals.push_back(outward);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    mesh.triangles.push_back({first, first + 2, first + 3});
  }
}

void AddCap(const std::vector<Vector2>& points,
            const std::vector<std::array<std::uint32_t, 3>>& triangles, double z, bool upwards,
            TriangleMesh& mesh) {
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  for (const Vector2& p : points) {
    mesh.positions.push_back({p.x, p.y, z});
    mesh.normals.push_back({0, 0, upwards ? 1.0 : -1.0});
  }
  for (const auto& t : triangles) {
    mesh.triangles.push_back(upwards ? std::array{first + t[0], first + t[1], first + t[2]}
                                     : std::array{first + t[0], first + t[2], first + t[1]});
  }
}

base::Status AddRegion(const Region& region, double height, TriangleMesh& mesh) {
  const auto triangles = Triangulate(region.outer, region.holes);
  if (!triangles) return Fail(triangles.error());
  std::vector<Vector2> points = region.outer;
  AddWalls(region.outer, height, mesh);
  for (const Outline& hole : region.holes) {
    points.insert(points.end(), hole.begin(), hole.end());
    AddWalls(hole, height, mesh);
  }
  AddCap(points, *triangles, height, true, mesh);
  AddCap(points, *triangles, 0, false, mesh);
  return {};
}

}  // namespace

base::Result<TriangleMesh> ExtrudeOutlines(const std::vector<Outline>& outlines, double height) {
  if (!(height > 0) || !std::isfinite(height)) {
    return Fail(ErrorCode::kBadModel, "a polyline needs a height above zero");
  }
  std::vector<Outline> cleaned;
  std::size_t points = 0;
  for (const Outline& outline : outlines) {
    cleaned.push_back(WithoutRepeatedPoints(outline));
    points += cleaned.back().size();
    if (cleaned.back().size() < 3 || !(std::abs(TwiceSignedArea(cleaned.back())) > 0) ||
        !std::isfinite(TwiceSignedArea(cleaned.back()))) {
      return Fail(ErrorCode::kBadModel, "a polyline needs three points that bound an area");
    }
  }
  if (cleaned.empty()) return Fail(ErrorCode::kBadModel, "a polyline needs points");
  if (points > kMaxPoints) {
    return Fail(ErrorCode::kBadModel, "a polyline has " + std::to_string(points) +
                                          " points; the limit is " + std::to_string(kMaxPoints));
  }
  TriangleMesh mesh;
  for (const Region& region : ToRegions(cleaned)) {
    if (auto status = AddRegion(region, height, mesh); !status) return Fail(status.error());
  }
  mesh.parts.push_back({"", 0, static_cast<std::uint32_t>(mesh.triangles.size()), 0});
  return mesh;
}

}  // namespace gsv::formats
