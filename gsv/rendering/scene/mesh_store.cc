#include "gsv/rendering/scene/mesh_store.h"

#include "gsv/rendering/scene/mesh_surfaces.h"

namespace gsv::rendering {
namespace {

using geometry::Shape;
using geometry::TriangleMesh;
using geometry::Vector2;
using geometry::Vector3;

void Append(const Vector3& position, const Vector3& normal, const Vector2& uv,
            std::vector<float>& out) {
  for (const double value :
       {position.x, position.y, position.z, normal.x, normal.y, normal.z, uv.x, 1 - uv.y}) {
    out.push_back(static_cast<float>(value));
  }
}

Vector2 TextureCoordinate(const TriangleMesh& mesh, std::uint32_t vertex) {
  return mesh.texture_coordinates.empty() ? Vector2{} : mesh.texture_coordinates[vertex];
}

struct Arrays {
  std::vector<float> vertices;
  std::vector<std::uint32_t> indices;
};

Arrays WithNormals(const TriangleMesh& mesh, const std::vector<std::uint32_t>& order) {
  Arrays arrays;
  arrays.vertices.reserve(mesh.positions.size() * 8);
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) {
    Append(mesh.positions[i], mesh.normals[i], TextureCoordinate(mesh, i), arrays.vertices);
  }
  arrays.indices.reserve(order.size() * 3);
  for (const std::uint32_t triangle : order) {
    const auto& t = mesh.triangles[triangle];
    arrays.indices.insert(arrays.indices.end(), t.begin(), t.end());
  }
  return arrays;
}

// Makes separate vertices for each triangle, with the triangle's normal (flat shading).
Arrays WithoutNormals(const TriangleMesh& mesh, const std::vector<std::uint32_t>& order) {
  Arrays arrays;
  for (const std::uint32_t triangle : order) {
    const auto& t = mesh.triangles[triangle];
    const Vector3 normal = geometry::Normalized(geometry::Cross(
        mesh.positions[t[1]] - mesh.positions[t[0]], mesh.positions[t[2]] - mesh.positions[t[0]]));
    for (const std::uint32_t vertex : t) {
      arrays.indices.push_back(static_cast<std::uint32_t>(arrays.vertices.size() / 8));
      Append(mesh.positions[vertex], normal, TextureCoordinate(mesh, vertex), arrays.vertices);
    }
  }
  return arrays;
}

// Adds to each vertex the number of its surface.
std::vector<float> WithSurfaces(const Arrays& arrays) {
  const std::vector<std::uint32_t> surfaces = NumberSurfaces(arrays.vertices, arrays.indices);
  std::vector<float> vertices;
  vertices.reserve(9 * surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const auto first = arrays.vertices.begin() + static_cast<std::ptrdiff_t>(8 * i);
    vertices.insert(vertices.end(), first, first + 8);
    // With numbers below 4096, renderers can compute with them exactly in single precision.
    vertices.push_back(static_cast<float>(surfaces[i] % 4096));
  }
  return vertices;
}

MeshArrays ArraysOf(const TriangleMesh& mesh) {
  MeshChunks chunks = CutIntoChunks(mesh);
  Arrays arrays =
      mesh.normals.empty() ? WithoutNormals(mesh, chunks.order) : WithNormals(mesh, chunks.order);
  std::vector<float> vertices = WithSurfaces(arrays);
  return {std::move(vertices), std::move(arrays.indices), std::move(chunks.chunks)};
}

}  // namespace

DrawShape MeshStore::Find(const Shape& shape) {
  const auto generated = [&](double a, double b, const Shape& unit, const Vector3& scale) {
    return DrawShape{FindGenerated({static_cast<int>(unit.index()), a, b, 0, 0, 0}, unit), scale};
  };
  if (const auto* mesh = std::get_if<geometry::Mesh>(&shape)) {
    return {FindFileMesh(mesh->triangles), mesh->scale};
  }
  if (const auto* box = std::get_if<geometry::Box>(&shape)) {
    return generated(0, 0, geometry::Box{{1, 1, 1}}, box->size);
  }
  if (const auto* sphere = std::get_if<geometry::Sphere>(&shape)) {
    return generated(0, 0, geometry::Sphere{1}, {sphere->radius, sphere->radius, sphere->radius});
  }
  if (const auto* ellipsoid = std::get_if<geometry::Ellipsoid>(&shape)) {
    return generated(0, 0, geometry::Sphere{1}, ellipsoid->radii);
  }
  if (const auto* cylinder = std::get_if<geometry::Cylinder>(&shape)) {
    return generated(0, 0, geometry::Cylinder{1, 1},
                     {cylinder->radius, cylinder->radius, cylinder->length});
  }
  if (const auto* cone = std::get_if<geometry::Cone>(&shape)) {
    return generated(0, 0, geometry::Cone{1, 1}, {cone->radius, cone->radius, cone->length});
  }
  if (const auto* capsule = std::get_if<geometry::Capsule>(&shape)) {
    return generated(capsule->radius, capsule->length, shape, {1, 1, 1});
  }
  const auto& plane = std::get<geometry::Plane>(shape);
  return {FindGenerated({static_cast<int>(shape.index()), plane.size.x, plane.size.y,
                         plane.normal.x, plane.normal.y, plane.normal.z},
                        shape),
          {1, 1, 1}};
}

std::shared_ptr<const DrawMesh> MeshStore::FindFileMesh(
    const std::shared_ptr<const TriangleMesh>& triangles) {
  FileMesh& entry = file_meshes_[triangles.get()];
  // To compare addresses is not sufficient: a destroyed mesh may have had the same address.
  if (entry.mesh == nullptr || entry.triangles.lock() != triangles) {
    entry = {triangles, make_(ArraysOf(*triangles))};
  }
  return entry.mesh;
}

std::shared_ptr<const DrawMesh> MeshStore::FindGenerated(const Key& key, const Shape& shape) {
  std::weak_ptr<const DrawMesh>& entry = generated_[key];
  std::shared_ptr<const DrawMesh> mesh = entry.lock();
  if (mesh == nullptr) {
    mesh = make_(ArraysOf(geometry::Tessellate(shape)));
    entry = mesh;
  }
  return mesh;
}

void MeshStore::Sweep() {
  std::erase_if(file_meshes_, [](const auto& item) { return item.second.triangles.expired(); });
  std::erase_if(generated_, [](const auto& item) { return item.second.expired(); });
}

std::size_t MeshStore::size() const { return file_meshes_.size() + generated_.size(); }

}  // namespace gsv::rendering
