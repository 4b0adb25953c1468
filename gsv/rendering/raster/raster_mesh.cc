#include "gsv/rendering/raster/raster_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

namespace gsv::rendering::raster {
namespace {

struct Vertex {
  std::array<float, 3> position, normal;
  std::array<float, 2> uv;
  std::uint16_t surface = 0;
};

// The triangles of one chunk. Each triangle has its own vertices.
struct Piece {
  std::vector<Vertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

Piece PieceOf(const MeshArrays& arrays, const MeshChunk& chunk) {
  Piece piece;
  std::map<std::uint32_t, std::uint32_t> number_of;
  for (std::uint32_t t = 0; t < chunk.triangle_count; ++t) {
    std::array<std::uint32_t, 3> triangle;
    for (std::uint32_t corner = 0; corner < 3; ++corner) {
      const std::uint32_t index = arrays.indices[3 * (chunk.first_triangle + t) + corner];
      const auto [it, is_new] =
          number_of.try_emplace(index, static_cast<std::uint32_t>(piece.vertices.size()));
      if (is_new) {
        const float* f = &arrays.vertices[std::size_t{kVertexFloats} * index];
        piece.vertices.push_back({{f[0], f[1], f[2]},
                                  {f[3], f[4], f[5]},
                                  {f[6], f[7]},
                                  static_cast<std::uint16_t>(f[8])});
      }
      triangle[corner] = it->second;
    }
    piece.triangles.push_back(triangle);
  }
  return piece;
}

// Joins vertices in one cell of a grid (Rossignac and Borrel, 1993). All vertices of a cell move to
// their mean, and vertices with similar normals become one.
Piece Coarser(const Piece& fine, float cell) {
  using Cell = std::array<int, 3>;
  const auto cell_of = [&](const Vertex& vertex) {
    Cell c;
    for (int i = 0; i < 3; ++i) c[i] = static_cast<int>(std::floor(vertex.position[i] / cell));
    return c;
  };
  const auto facing = [](const Vertex& vertex) {
    int axis = 0;
    for (int i = 1; i < 3; ++i) {
      if (std::abs(vertex.normal[i]) > std::abs(vertex.normal[axis])) axis = i;
    }
    return 2 * axis + (vertex.normal[axis] < 0 ? 1 : 0);
  };
  struct Mean {
    std::array<double, 3> position{};
    int count = 0;
  };
  std::map<Cell, Mean> means;
  for (const Vertex& vertex : fine.vertices) {
    Mean& mean = means[cell_of(vertex)];
    for (int i = 0; i < 3; ++i) mean.position[i] += vertex.position[i];
    ++mean.count;
  }
  Piece coarse;
  std::map<std::tuple<Cell, int>, std::uint32_t> number_of;
  std::vector<std::uint32_t> renumbered;
  std::vector<Cell> cells;
  for (const Vertex& vertex : fine.vertices) {
    const Cell c = cell_of(vertex);
    const auto [it, is_new] = number_of.try_emplace(
        {c, facing(vertex)}, static_cast<std::uint32_t>(coarse.vertices.size()));
    renumbered.push_back(it->second);
    if (!is_new) {
      Vertex& joined = coarse.vertices[it->second];
      for (int i = 0; i < 3; ++i) joined.normal[i] += vertex.normal[i];
      continue;
    }
    const Mean& mean = means[c];
    Vertex moved = vertex;
    for (int i = 0; i < 3; ++i)
      moved.position[i] = static_cast<float>(mean.position[i] / mean.count);
    coarse.vertices.push_back(moved);
    cells.push_back(c);
  }
  std::map<std::array<std::uint32_t, 3>, bool> seen;
  for (const auto& t : fine.triangles) {
    std::array<std::uint32_t, 3> r{renumbered[t[0]], renumbered[t[1]], renumbered[t[2]]};
    if (cells[r[0]] == cells[r[1]] || cells[r[1]] == cells[r[2]] || cells[r[2]] == cells[r[0]]) {
      continue;
    }
    std::rotate(r.begin(), std::min_element(r.begin(), r.end()), r.end());
    if (seen.try_emplace(r, true).second) coarse.triangles.push_back(r);
  }
  return coarse;
}

std::uint32_t WholeEights(std::size_t count) {
  return static_cast<std::uint32_t>((count + 7) / 8 * 8);
}

Level Append(const Piece& piece, float cell, RasterMesh& mesh) {
  Level level;
  level.cell = cell;
  level.first_vertex = static_cast<std::uint32_t>(mesh.x.size());
  level.vertex_count = WholeEights(piece.vertices.size());
  level.first_triangle = static_cast<std::uint32_t>(mesh.corners[0].size());
  level.triangle_count = WholeEights(piece.triangles.size());
  for (std::size_t i = 0; i < level.vertex_count; ++i) {
    const Vertex& vertex = piece.vertices[i < piece.vertices.size() ? i : 0];
    mesh.x.push_back(vertex.position[0]);
    mesh.y.push_back(vertex.position[1]);
    mesh.z.push_back(vertex.position[2]);
    const auto& [normal, uv] = std::tie(vertex.normal, vertex.uv);
    mesh.attributes.push_back({{1, uv[0], uv[1], normal[0], normal[1], normal[2], 0, 0}});
    mesh.surface.push_back(vertex.surface);
  }
  for (std::size_t i = 0; i < level.triangle_count; ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      mesh.corners[corner].push_back(i < piece.triangles.size() ? piece.triangles[i][corner] : 0);
    }
  }
  return level;
}

}  // namespace

std::shared_ptr<const DrawMesh> MakeRasterMesh(MeshArrays arrays) {
  constexpr std::size_t kMinTriangles = 32;  // smaller chunks have no coarser level
  auto mesh = std::make_shared<RasterMesh>();
  for (const MeshChunk& chunk : arrays.chunks) {
    Piece piece = PieceOf(arrays, chunk);
    std::vector<Level>& levels = mesh->levels.emplace_back();
    levels.push_back(Append(piece, 0, *mesh));
    const auto size = static_cast<float>(geometry::Norm(chunk.bounds.max - chunk.bounds.min));
    for (float cell = size / 128; cell < size / 3 && piece.triangles.size() > kMinTriangles;
         cell *= 1.5f) {
      Piece coarser = Coarser(piece, cell);
      if (coarser.triangles.size() > 0.7 * static_cast<double>(piece.triangles.size())) continue;
      if (coarser.triangles.empty()) break;
      piece = std::move(coarser);
      levels.push_back(Append(piece, cell, *mesh));
    }
  }
  mesh->chunks = std::move(arrays.chunks);
  return mesh;
}

}  // namespace gsv::rendering::raster
