#include "gsv/formats/meshes/mesh_reader.h"

#include <cmath>
#include <set>

#include "gsv/formats/meshes/assimp_scene.h"
#include "gsv/formats/meshes/mesh_materials.h"
#include "gsv/geometry/pose.h"

namespace gsv::formats {
namespace {

using base::ErrorCode;
using geometry::TriangleMesh;
using geometry::Vector3;

Vector3 ToVector(const aiVector3D& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

// Whether the triangle's area is zero up to rounding: the sine of the angle between two edges
// vanishes.
bool IsDegenerate(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 ab = b - a, ac = c - a, normal = geometry::Cross(ab, ac);
  constexpr double kSine = 1e-12;
  return !(geometry::Dot(normal, normal) >
           kSine * kSine * geometry::Dot(ab, ab) * geometry::Dot(ac, ac));
}

// Joins the meshes of a scene's nodes into one mesh, in the file's root frame. Each of these meshes
// becomes a part.
class MeshMerger {
 public:
  MeshMerger(const AssimpScene& opened, const std::string& submesh, const ReadLimits& limits)
      : scene_(*opened.scene), submesh_(submesh), limits_(limits) {
    const auto [first, last] = opened.ids_of.equal_range(submesh);
    for (auto id = first; id != last; ++id) submesh_ids_.insert(id->second);
  }

  base::Result<TriangleMesh> Gather() {
    if (!Visit(*scene_.mRootNode, aiMatrix4x4(), kMaxNodeDepth)) {
      return Fail(ErrorCode::kBadModel,
                  "the mesh has more than the limit of " + std::to_string(limits_.mesh_triangles) +
                      " triangles or " + std::to_string(limits_.mesh_vertices) + " vertices");
    }
    if (mesh_.triangles.empty()) {
      return Fail(ErrorCode::kBadModel, submesh_.empty()
                                            ? "the mesh has no triangles"
                                            : "the mesh has no submesh \"" + submesh_ + "\"");
    }
    DropIncompleteAttributes();
    return std::move(mesh_);
  }

 private:
  static constexpr int kMaxNodeDepth = 256;

  bool Visit(const aiNode& node, const aiMatrix4x4& root_from_parent, int levels_left) {
    if (levels_left == 0) return true;
    const aiMatrix4x4 root_from_node = root_from_parent * node.mTransformation;
    for (unsigned i = 0; i < node.mNumMeshes; ++i) {
      if (node.mMeshes[i] >= scene_.mNumMeshes) continue;
      const aiMesh& part = *scene_.mMeshes[node.mMeshes[i]];
      if (!IsWanted(node, part)) continue;
      if (mesh_.triangles.size() + part.mNumFaces > limits_.mesh_triangles ||
          mesh_.positions.size() + part.mNumVertices > limits_.mesh_vertices) {
        return false;
      }
      Add(part, root_from_node);
    }
    for (unsigned i = 0; i < node.mNumChildren; ++i) {
      if (!Visit(*node.mChildren[i], root_from_node, levels_left - 1)) return false;
    }
    return true;
  }

  bool IsWanted(const aiNode& node, const aiMesh& part) const {
    if (submesh_.empty()) return true;
    const auto is_wanted = [&](const char* name) {
      return submesh_ == name || submesh_ids_.count(name) != 0;
    };
    return is_wanted(part.mName.C_Str()) || is_wanted(node.mName.C_Str());
  }

  void Add(const aiMesh& part, const aiMatrix4x4& root_from_node) {
    const auto first_vertex = static_cast<std::uint32_t>(mesh_.positions.size());
    AddVertices(part, root_from_node);
    geometry::MeshPart run;
    run.name = part.mName.C_Str();
    run.material = part.mMaterialIndex;
    run.first_triangle = static_cast<std::uint32_t>(mesh_.triangles.size());
    const bool mirrored = root_from_node.Determinant() < 0;
    for (unsigned i = 0; i < part.mNumFaces; ++i) {
      AddTriangle(part.mFaces[i], part.mNumVertices, first_vertex, mirrored);
    }
    run.triangle_count = static_cast<std::uint32_t>(mesh_.triangles.size()) - run.first_triangle;
    if (run.triangle_count > 0) mesh_.parts.push_back(std::move(run));
  }

  void AddVertices(const aiMesh& part, const aiMatrix4x4& root_from_node) {
    // Normals are transformed by the inverse transpose of the matrix for positions.
    aiMatrix3x3 normal_matrix(root_from_node);
    normal_matrix.Inverse().Transpose();
    all_have_normals_ = all_have_normals_ && part.HasNormals();
    any_has_coordinates_ = any_has_coordinates_ || part.HasTextureCoords(0);
    for (unsigned i = 0; i < part.mNumVertices; ++i) {
      mesh_.positions.push_back(ToVector(root_from_node * part.mVertices[i]));
      if (all_have_normals_) mesh_.normals.push_back(UnitNormal(normal_matrix * part.mNormals[i]));
      mesh_.texture_coordinates.push_back(CoordinatesOf(part, i));
    }
  }

  static Vector3 UnitNormal(const aiVector3D& normal) {
    const Vector3 n = ToVector(normal);
    return geometry::IsFinite(n) && geometry::Dot(n, n) > 0 ? geometry::Normalized(n)
                                                            : Vector3{0, 0, 1};
  }

  static geometry::Vector2 CoordinatesOf(const aiMesh& part, unsigned i) {
    if (!part.HasTextureCoords(0)) return {};
    const aiVector3D& uv = part.mTextureCoords[0][i];
    const geometry::Vector2 result{static_cast<double>(uv.x), static_cast<double>(uv.y)};
    return std::isfinite(result.x) && std::isfinite(result.y) ? result : geometry::Vector2{};
  }

  void AddTriangle(const aiFace& face, unsigned vertices, std::uint32_t first, bool mirrored) {
    if (face.mNumIndices != 3) return;
    std::array<std::uint32_t, 3> corners{};
    for (unsigned k = 0; k < 3; ++k) {
      if (face.mIndices[k] >= vertices) return;
      corners[k] = first + face.mIndices[k];
      if (!geometry::IsFinite(mesh_.positions[corners[k]])) return;
    }
    if (IsDegenerate(mesh_.positions[corners[0]], mesh_.positions[corners[1]],
                     mesh_.positions[corners[2]])) {
      return;
    }
    if (mirrored) std::swap(corners[1], corners[2]);
    mesh_.triangles.push_back(corners);
  }

  // Drops the normals if a part has none, and the texture coordinates if no part has them. Replaces
  // vertices that are not finite.
  void DropIncompleteAttributes() {
    if (!all_have_normals_) mesh_.normals.clear();
    if (!any_has_coordinates_) mesh_.texture_coordinates.clear();
    for (Vector3& position : mesh_.positions) {
      if (!geometry::IsFinite(position)) position = mesh_.positions[mesh_.triangles[0][0]];
    }
  }

  const aiScene& scene_;
  const std::string& submesh_;
  std::set<std::string> submesh_ids_;  // ids of the nodes and geometries with the name submesh_
  const ReadLimits& limits_;
  TriangleMesh mesh_;
  bool all_have_normals_ = true;
  bool any_has_coordinates_ = false;
};

void Centre(TriangleMesh& mesh) {
  const geometry::Bounds bounds = geometry::BoundsOf(mesh);
  const Vector3 middle = (bounds.min + bounds.max) * 0.5;
  for (Vector3& position : mesh.positions) position -= middle;
}

base::Result<MeshFile> ReadMesh(const std::filesystem::path& path, const std::string& submesh,
                                bool centred, const ReadLimits& limits, TextureReader& textures,
                                base::Problems& problems) {
  auto opened = OpenScene(path, limits);
  if (!opened) return Fail(opened.error());
  auto mesh = MeshMerger(*opened, submesh, limits).Gather();
  if (!mesh) return Fail(mesh.error().code, mesh.error().message, path.string());
  for (const std::string& change : opened->changes) {
    problems.push_back(
        {base::Problem::Severity::kWarning, "of the mesh: " + change, path.string()});
  }
  if (centred) Centre(*mesh);
  MeshFile file;
  file.materials = ReadMeshMaterials(*opened->scene, path, textures, limits, problems);
  for (geometry::MeshPart& part : mesh->parts) {
    if (part.material >= file.materials.size()) part.material = 0;
  }
  file.triangles = std::make_shared<const TriangleMesh>(std::move(*mesh));
  return file;
}

}  // namespace

base::Result<MeshFile> MeshReader::Read(const std::filesystem::path& path,
                                        const std::string& submesh, bool centred,
                                        base::Problems& problems) {
  const auto key = std::make_tuple(path, submesh, centred);
  if (const auto it = files_.find(key); it != files_.end()) return it->second;
  auto file = ReadMesh(path, submesh, centred, limits_, textures_, problems);
  files_.emplace(key, file);
  return file;
}

}  // namespace gsv::formats
