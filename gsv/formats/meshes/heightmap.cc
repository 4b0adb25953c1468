#include "gsv/formats/meshes/heightmap.h"

#include <algorithm>

namespace gsv::formats {
namespace {

using geometry::Vector3;

// The first channel in [0, 1], between pixels by bilinear interpolation.
double Grey(const model::Image& picture, double x, double y) {
  const int x0 = static_cast<int>(x), y0 = static_cast<int>(y);
  const int x1 = std::min(x0 + 1, picture.width - 1), y1 = std::min(y0 + 1, picture.height - 1);
  const auto pixel = [&](int column, int row) {
    return picture.pixels[static_cast<std::size_t>((row * picture.width + column) *
                                                   picture.channels)] /
           255.0;
  };
  const double u = x - x0, v = y - y0;
  return (1 - v) * ((1 - u) * pixel(x0, y0) + u * pixel(x1, y0)) +
         v * ((1 - u) * pixel(x0, y1) + u * pixel(x1, y1));
}

}  // namespace

geometry::TriangleMesh HeightmapMesh(const model::Image& picture, const Vector3& size,
                                     int most_vertices) {
  const int columns = std::clamp(picture.width, 2, most_vertices);
  const int rows = std::clamp(picture.height, 2, most_vertices);
  geometry::TriangleMesh mesh;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double u = static_cast<double>(column) / (columns - 1);
      const double v = static_cast<double>(row) / (rows - 1);
      const double grey = Grey(picture, u * (picture.width - 1), v * (picture.height - 1));
      mesh.positions.push_back({(u - 0.5) * size.x, (0.5 - v) * size.y, grey * size.z});
      mesh.texture_coordinates.push_back({u, 1 - v});
    }
  }
  mesh.normals.assign(mesh.positions.size(), Vector3{});
  const auto at = [&](int column, int row) {
    return static_cast<std::uint32_t>(row * columns + column);
  };
  for (int row = 0; row + 1 < rows; ++row) {
    for (int column = 0; column + 1 < columns; ++column) {
      // Rows run towards -y: this order is counter-clockwise from above.
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

}  // namespace gsv::formats
