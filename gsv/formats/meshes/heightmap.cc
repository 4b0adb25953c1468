#include "gsv/formats/meshes/heightmap.h"

#include <algorithm>

namespace gsv::formats {
namespace {

using geometry::Vector3;

// Returns the height at (x, y) in grid units, by bilinear interpolation.
double HeightAt(const HeightGrid& grid, double x, double y) {
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, grid.width - 1), y1 = std::min(y0 + 1, grid.height - 1);
  const auto point = [&](int column, int row) {
    return grid.heights[static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.width) +
                        static_cast<std::size_t>(column)];
  };
  const double u = x - x0, v = y - y0;
  return (1 - v) * ((1 - u) * point(x0, y0) + u * point(x1, y0)) +
         v * ((1 - u) * point(x0, y1) + u * point(x1, y1));
}

// Returns the image's first channel as values in [0, 1].
HeightGrid GreysOf(const model::Image& image) {
  HeightGrid grid{image.width, image.height, {}, {}};
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.pixels.size(); i += channels) {
    grid.heights.push_back(image.pixels[i] / 255.0);
  }
  return grid;
}

// Makes a mesh in which the height of a vertex is `scale` times the grid's height above `lowest`.
geometry::TriangleMesh MeshOf(const HeightGrid& grid, const Vector3& size, double lowest,
                              double scale, int max_vertices) {
  const int columns = std::clamp(grid.width, 2, max_vertices);
  const int rows = std::clamp(grid.height, 2, max_vertices);
  geometry::TriangleMesh mesh;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double u = static_cast<double>(column) / (columns - 1);
      const double v = static_cast<double>(row) / (rows - 1);
      const double height = HeightAt(grid, u * (grid.width - 1), v * (grid.height - 1));
      mesh.positions.push_back({(u - 0.5) * size.x, (0.5 - v) * size.y, (height - lowest) * scale});
      mesh.texture_coordinates.push_back({u, 1 - v});
    }
  }
  mesh.normals.assign(mesh.positions.size(), Vector3{});
  const auto at = [&](int column, int row) {
    return static_cast<std::uint32_t>(row * columns + column);
  };
  for (int row = 0; row + 1 < rows; ++row) {
    for (int column = 0; column + 1 < columns; ++column) {
      // Rows go towards -y, so this order of the corners is counter-clockwise from above.
      mesh.triangles.push_back({at(column, row), at(column, row + 1), at(column + 1, row)});
      mesh.triangles.push_back({at(column + 1, row), at(column, row + 1), at(column + 1, row + 1)});
    }
  }
  for (const auto& t : mesh.triangles) {
    const Vector3& a = mesh.positions[t[0]];
    const Vector3 normal = geometry::Cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
    for (const std::uint32_t corner : t) mesh.normals[corner] += normal;
  }
  for (Vector3& normal : mesh.normals) normal = geometry::Normalized(normal);
  mesh.parts.push_back({"", 0, static_cast<std::uint32_t>(mesh.triangles.size()), 0});
  return mesh;
}

}  // namespace

geometry::TriangleMesh HeightmapMesh(const model::Image& image, const Vector3& size,
                                     int max_vertices) {
  return MeshOf(GreysOf(image), size, 0, size.z, max_vertices);
}

geometry::TriangleMesh HeightmapMesh(const HeightGrid& grid, const Vector3& size,
                                     int max_vertices) {
  const auto [lowest, highest] = std::minmax_element(grid.heights.begin(), grid.heights.end());
  const double range = *highest - *lowest;
  return MeshOf(grid, size, *lowest, range > 0 ? size.z / range : 0, max_vertices);
}

Vector3 TrueSize(const HeightGrid& grid) {
  const auto [lowest, highest] = std::minmax_element(grid.heights.begin(), grid.heights.end());
  const geometry::Vector2 spacing = grid.spacing.value_or(geometry::Vector2{1, 1});
  return {std::max(grid.width - 1, 1) * spacing.x, std::max(grid.height - 1, 1) * spacing.y,
          *highest - *lowest};
}

}  // namespace gsv::formats
