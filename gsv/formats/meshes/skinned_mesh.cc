#include "gsv/formats/meshes/skinned_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "gsv/formats/meshes/assimp_scene.h"
#include "gsv/formats/meshes/mesh_materials.h"

namespace gsv::formats {
namespace {

using base::ErrorCode;
using geometry::Pose;
using geometry::TriangleMesh;
using geometry::Vector3;

constexpr int kMaxBoneDepth = 128;
constexpr double kMaxAnimationTime = 600;  // maximum length of an animation, s

Vector3 PointOf(const aiVector3D& v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

// Returns the rotation and translation of a transform, without scale and shear.
Pose RigidPartOf(const aiMatrix4x4& matrix) {
  aiVector3D scale, position;
  aiQuaternion turn;
  matrix.Decompose(scale, turn, position);
  return {PointOf(position),
          geometry::Normalized({static_cast<double>(turn.w), static_cast<double>(turn.x),
                                static_cast<double>(turn.y), static_cast<double>(turn.z)})};
}

// Returns the keys before and after `time`, and the position of `time` between them, from 0 to 1.
template <typename Key>
std::pair<std::pair<unsigned, unsigned>, float> KeysAround(const Key* keys, unsigned count,
                                                           double time) {
  const Key* const end = keys + count;
  const Key* const after =
      std::upper_bound(keys, end, time, [](double t, const Key& key) { return t < key.mTime; });
  if (after == keys) return {{0, 0}, 0.0F};
  if (after == end) return {{count - 1, count - 1}, 0.0F};
  const auto i = static_cast<unsigned>(after - keys);
  const double span = keys[i].mTime - keys[i - 1].mTime;
  return {{i - 1, i}, span > 0 ? static_cast<float>((time - keys[i - 1].mTime) / span) : 0.0F};
}

aiVector3D VectorAt(const aiVectorKey* keys, unsigned count, double time,
                    const aiVector3D& otherwise) {
  if (count == 0) return otherwise;
  const auto [pair, part] = KeysAround(keys, count, time);
  return keys[pair.first].mValue + (keys[pair.second].mValue - keys[pair.first].mValue) * part;
}

// The nodes of a skeleton, at the poses of their animation.
class Skeleton {
 public:
  struct Node {
    const aiNode* node;
    int parent;
    const aiNodeAnim* channel = nullptr;
    double ticks_per_second = 1;
  };

  explicit Skeleton(const aiScene& scene) { Add(*scene.mRootNode, -1, kMaxBoneDepth); }

  // Assigns the channels of an animation to the nodes. Returns false if the animation moves none of
  // the nodes, has no length, or is longer than kMaxAnimationTime.
  bool Animate(const aiScene& motion) {
    bool any = false;
    for (unsigned a = 0; a < motion.mNumAnimations; ++a) {
      const aiAnimation& animation = *motion.mAnimations[a];
      const double ticks = animation.mTicksPerSecond > 0 ? animation.mTicksPerSecond : 1;
      for (unsigned c = 0; c < animation.mNumChannels; ++c) {
        const aiNodeAnim& channel = *animation.mChannels[c];
        const int index = Find(channel.mNodeName.C_Str());
        if (index < 0 || nodes_[static_cast<std::size_t>(index)].channel != nullptr) continue;
        nodes_[static_cast<std::size_t>(index)].channel = &channel;
        nodes_[static_cast<std::size_t>(index)].ticks_per_second = ticks;
        any = true;
      }
      length_ = std::max(length_, animation.mDuration / ticks);
    }
    return any && length_ > 0 && length_ <= kMaxAnimationTime;
  }

  double length() const { return length_; }
  const std::vector<Node>& nodes() const { return nodes_; }

  // Returns the index of the node `name`, or -1.
  int Find(const std::string& name) const {
    const auto found = by_name_.find(name);
    return found == by_name_.end() ? -1 : found->second;
  }

  // Returns root_from_node of every node.
  std::vector<aiMatrix4x4> PosesAt(double seconds) const {
    std::vector<aiMatrix4x4> poses;
    for (const Node& node : nodes_) {
      const aiMatrix4x4 own = node.channel == nullptr
                                  ? node.node->mTransformation
                                  : ChannelAt(*node.channel, seconds * node.ticks_per_second);
      poses.push_back(node.parent < 0 ? own : poses[static_cast<std::size_t>(node.parent)] * own);
    }
    return poses;
  }

 private:
  void Add(const aiNode& node, int parent, int levels_left) {
    if (levels_left == 0) return;
    const auto index = static_cast<int>(nodes_.size());
    nodes_.push_back({&node, parent});
    by_name_.emplace(node.mName.C_Str(), index);
    for (unsigned i = 0; i < node.mNumChildren; ++i)
      Add(*node.mChildren[i], index, levels_left - 1);
  }

  static aiMatrix4x4 ChannelAt(const aiNodeAnim& channel, double ticks) {
    aiQuaternion turn;
    if (channel.mNumRotationKeys > 0) {
      const auto [pair, part] = KeysAround(channel.mRotationKeys, channel.mNumRotationKeys, ticks);
      aiQuaternion::Interpolate(turn, channel.mRotationKeys[pair.first].mValue,
                                channel.mRotationKeys[pair.second].mValue, part);
    }
    return {VectorAt(channel.mScalingKeys, channel.mNumScalingKeys, ticks, {1, 1, 1}), turn,
            VectorAt(channel.mPositionKeys, channel.mNumPositionKeys, ticks, {})};
  }

  std::vector<Node> nodes_;  // parents before children
  std::map<std::string, int> by_name_;
  double length_ = 0;
};

// Assigns the triangles of a skin to the nodes of its skeleton.
class BoneCutter {
 public:
  BoneCutter(const aiScene& scene, const Skeleton& skeleton, const ReadLimits& limits)
      : scene_(scene), skeleton_(skeleton), limits_(limits), pieces_(skeleton.nodes().size()) {}

  // Assigns the triangles to nodes, in the root's frame with the skeleton at its rest poses.
  // Returns false if the skin exceeds the limits on triangles and vertices.
  bool Cut(const std::vector<aiMatrix4x4>& rest) {
    for (std::size_t n = 0; n < skeleton_.nodes().size(); ++n) {
      const aiNode& node = *skeleton_.nodes()[n].node;
      for (unsigned i = 0; i < node.mNumMeshes; ++i) {
        if (node.mMeshes[i] >= scene_.mNumMeshes) continue;
        const aiMesh& mesh = *scene_.mMeshes[node.mMeshes[i]];
        count_ += mesh.mNumFaces;
        if (count_ > limits_.mesh_triangles || mesh.mNumVertices > limits_.mesh_vertices) {
          return false;
        }
        Assign(mesh, static_cast<int>(n));
      }
    }
    LeaveFewToTheBoneAbove();
    for (std::size_t n = 0; n < pieces_.size(); ++n) {
      for (const Piece& piece : pieces_[n]) Add(piece, rest, n);
    }
    return true;
  }

  bool has_bones() const { return has_bones_; }
  std::vector<TriangleMesh>& meshes() { return meshes_; }

 private:
  struct Driver {
    int node = 0;
    aiMatrix4x4 offset;  // node_from_mesh, at the skin's rest pose
  };
  // The faces of one mesh that one bone moves.
  struct Piece {
    const aiMesh* mesh;
    aiMatrix4x4 offset;
    int node;  // index of the bone's node, to which `offset` belongs
    std::vector<unsigned> faces;
  };

  void Assign(const aiMesh& mesh, int own_node) {
    std::vector<Driver> drivers{{own_node, aiMatrix4x4()}};
    std::vector<std::size_t> driver_of(mesh.mNumVertices, 0);
    std::vector<float> weight_of(mesh.mNumVertices, 0.0F);
    for (unsigned b = 0; b < mesh.mNumBones; ++b) {
      const aiBone& bone = *mesh.mBones[b];
      const int node = skeleton_.Find(bone.mName.C_Str());
      if (node < 0) continue;
      has_bones_ = true;
      drivers.push_back({node, bone.mOffsetMatrix});
      for (unsigned w = 0; w < bone.mNumWeights; ++w) {
        const aiVertexWeight& weight = bone.mWeights[w];
        if (weight.mVertexId >= mesh.mNumVertices) continue;
        if (!(weight.mWeight > weight_of[weight.mVertexId])) continue;
        weight_of[weight.mVertexId] = weight.mWeight;
        driver_of[weight.mVertexId] = drivers.size() - 1;
      }
    }
    std::vector<Piece> pieces;
    for (const Driver& driver : drivers) pieces.push_back({&mesh, driver.offset, driver.node, {}});
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      if (face.mNumIndices != 3) continue;
      std::array<std::size_t, 3> of{};
      bool is_whole = true;
      for (unsigned k = 0; k < 3; ++k) {
        is_whole = is_whole && face.mIndices[k] < mesh.mNumVertices;
        if (is_whole) of[k] = driver_of[face.mIndices[k]];
      }
      if (!is_whole) continue;
      for (unsigned k = 0; k < 3; ++k) {
        if (std::find(of.begin(), of.begin() + k, of[k]) == of.begin() + k) {
          pieces[of[k]].faces.push_back(f);
        }
      }
    }
    for (Piece& piece : pieces) {
      if (piece.faces.empty()) continue;
      pieces_[static_cast<std::size_t>(piece.node)].push_back(std::move(piece));
    }
  }

  void LeaveFewToTheBoneAbove() {
    for (std::size_t n = pieces_.size(); n-- > 0;) {
      std::size_t faces = 0;
      for (const Piece& piece : pieces_[n]) faces += piece.faces.size();
      const int parent = skeleton_.nodes()[n].parent;
      const bool are_few = static_cast<double>(faces) < kMinTriangles * static_cast<double>(count_);
      if (faces == 0 || !are_few || parent <= 0) continue;
      auto& above = pieces_[static_cast<std::size_t>(parent)];
      above.insert(above.end(), pieces_[n].begin(), pieces_[n].end());
      pieces_[n].clear();
    }
    meshes_.resize(pieces_.size());
  }

  void Add(const Piece& piece, const std::vector<aiMatrix4x4>& rest, std::size_t node) {
    const aiMesh& mesh = *piece.mesh;
    const aiMatrix4x4 root_from_mesh = rest[static_cast<std::size_t>(piece.node)] * piece.offset;
    aiMatrix3x3 normals(root_from_mesh);
    normals.Inverse().Transpose();
    TriangleMesh& target = meshes_[node];
    std::map<unsigned, std::uint32_t> added;
    const auto vertex = [&](unsigned index) {
      const auto [it, is_new] =
          added.emplace(index, static_cast<std::uint32_t>(target.positions.size()));
      if (!is_new) return it->second;
      target.positions.push_back(PointOf(root_from_mesh * mesh.mVertices[index]));
      Vector3 normal{0, 0, 1};
      if (mesh.HasNormals()) normal = PointOf(normals * mesh.mNormals[index]);
      const bool is_usable = geometry::IsFinite(normal) && geometry::Dot(normal, normal) > 0;
      target.normals.push_back(is_usable ? geometry::Normalized(normal) : Vector3{0, 0, 1});
      geometry::Vector2 at;
      if (mesh.HasTextureCoords(0)) {
        const aiVector3D& uv = mesh.mTextureCoords[0][index];
        at = {static_cast<double>(uv.x), static_cast<double>(uv.y)};
        if (!std::isfinite(at.x) || !std::isfinite(at.y)) at = {};
      }
      target.texture_coordinates.push_back(at);
      return it->second;
    };
    geometry::MeshPart part;
    part.name = mesh.mName.C_Str();
    part.material = mesh.mMaterialIndex;
    part.first_triangle = static_cast<std::uint32_t>(target.triangles.size());
    for (const unsigned f : piece.faces) {
      std::array<std::uint32_t, 3> corners{};
      bool is_finite = true;
      for (unsigned k = 0; k < 3; ++k) {
        corners[k] = vertex(mesh.mFaces[f].mIndices[k]);
        is_finite = is_finite && geometry::IsFinite(target.positions[corners[k]]);
      }
      const Vector3 a = target.positions[corners[1]] - target.positions[corners[0]];
      const Vector3 b = target.positions[corners[2]] - target.positions[corners[0]];
      const Vector3 area = geometry::Cross(a, b);
      if (is_finite && geometry::Dot(area, area) > 0) target.triangles.push_back(corners);
    }
    part.triangle_count = static_cast<std::uint32_t>(target.triangles.size()) - part.first_triangle;
    if (part.triangle_count > 0) target.parts.push_back(std::move(part));
  }

  const aiScene& scene_;
  const Skeleton& skeleton_;
  const ReadLimits& limits_;
  std::vector<std::vector<Piece>> pieces_;  // by node
  std::vector<TriangleMesh> meshes_;        // by node
  std::size_t count_ = 0;                   // triangles so far
  bool has_bones_ = false;
};

void IntoFrame(const Pose& root_from_bone, double scale, TriangleMesh& mesh) {
  const Pose bone_from_root = Inverse(root_from_bone);
  Vector3 spare;
  for (const auto& corners : mesh.triangles) spare = mesh.positions[corners[0]];
  for (Vector3& position : mesh.positions) {
    // No triangle uses a vertex that is not finite, so any finite position can replace it.
    if (!geometry::IsFinite(position)) position = spare;
    position = scale * (bone_from_root * position);
  }
  for (Vector3& normal : mesh.normals) normal = bone_from_root.orientation * normal;
}

// Returns the root bone: the first node that the animation moves. Parents come before their
// children. Returns 0 if there is no such node.
std::size_t RootOf(const Skeleton& skeleton, const std::vector<TriangleMesh>& meshes) {
  for (std::size_t n = 0; n < meshes.size(); ++n) {
    if (skeleton.nodes()[n].channel != nullptr) return n;
  }
  return 0;
}

}  // namespace

base::Result<SkinnedMesh> ReadSkinnedMesh(const std::filesystem::path& skin,
                                          const std::filesystem::path& motion, double scale,
                                          const ReadLimits& limits, TextureReader& textures,
                                          base::Problems& problems) {
  auto scene = OpenScene(skin, limits);
  if (!scene) return Fail(scene.error());
  base::Result<AssimpScene> moving = AssimpScene{};
  if (motion != skin) moving = OpenScene(motion, limits);
  if (!moving) return Fail(moving.error());
  Skeleton skeleton(*scene->scene);
  if (!skeleton.Animate(motion == skin ? *scene->scene : *moving->scene)) {
    return Fail(ErrorCode::kNotFound, "the file has no animation of the skin's bones",
                motion.string());
  }
  BoneCutter cutter(*scene->scene, skeleton, limits);
  const std::vector<aiMatrix4x4> rest = skeleton.PosesAt(0);
  if (!cutter.Cut(rest)) {
    return Fail(ErrorCode::kBadModel,
                "the mesh has more than the limit of " + std::to_string(limits.mesh_triangles) +
                    " triangles, or of " + std::to_string(limits.mesh_vertices) + " vertices",
                skin.string());
  }
  if (!cutter.has_bones()) {
    return Fail(ErrorCode::kNotFound, "the mesh has no bones", skin.string());
  }
  SkinnedMesh mesh;
  mesh.length = skeleton.length();
  mesh.materials = ReadMeshMaterials(*scene->scene, skin, textures, limits, problems);
  std::vector<TriangleMesh>& pieces = cutter.meshes();
  std::vector<std::size_t> nodes;  // nodes of the bones
  for (std::size_t n = 0; n < pieces.size(); ++n) {
    if (pieces[n].triangles.empty()) continue;
    for (geometry::MeshPart& part : pieces[n].parts) {
      if (part.material >= mesh.materials.size()) part.material = 0;
    }
    IntoFrame(RigidPartOf(rest[n]), scale, pieces[n]);
    nodes.push_back(n);
    mesh.bones.push_back({skeleton.nodes()[n].node->mName.C_Str(),
                          std::make_shared<const TriangleMesh>(std::move(pieces[n])),
                          {}});
  }
  if (mesh.bones.empty()) {
    return Fail(ErrorCode::kBadModel, "the mesh has no triangles", skin.string());
  }
  const std::size_t root = RootOf(skeleton, pieces);
  const int frames =
      std::clamp(static_cast<int>(std::ceil(mesh.length * kFramesPerSecond)), 2, kMaxFrames);
  for (int f = 0; f < frames; ++f) {
    const std::vector<aiMatrix4x4> poses = skeleton.PosesAt(mesh.length * f / frames);
    mesh.root.push_back(scale * RigidPartOf(poses[root]).position);
    for (std::size_t b = 0; b < nodes.size(); ++b) {
      Pose pose = RigidPartOf(poses[nodes[b]]);
      pose.position = scale * pose.position;
      if (!geometry::IsFinite(pose)) pose = {};
      mesh.bones[b].skin_from_bone.push_back(pose);
    }
  }
  return mesh;
}

}  // namespace gsv::formats
