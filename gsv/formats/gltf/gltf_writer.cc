#include "gsv/formats/gltf/gltf_writer.h"

#include <algorithm>
#include <map>
#include <string>
#include <tuple>
#include <utility>

#include "gsv/formats/gltf/glb_buffer.h"
#include "gsv/formats/images/web_texture.h"
#include "gsv/model/srgb.h"

namespace gsv::formats {
namespace {

using geometry::TriangleMesh;
using geometry::Vector3;
using model::Image;
using model::Material;

// Mozilla Hubs' extension, the only extension for baked light:
// {"index": texture, "intensity": factor}.
constexpr const char* kLightMapExtension = "MOZ_lightmap";

constexpr std::size_t kMaxBytes = std::size_t{1} << 30;

std::vector<float> Flat(const std::vector<Vector3>& vectors) {
  std::vector<float> values;
  values.reserve(vectors.size() * 3);
  for (const Vector3& v : vectors) {
    for (const double c : {v.x, v.y, v.z}) values.push_back(static_cast<float>(c));
  }
  return values;
}

// Returns u and v of each vertex. v is flipped, because glTF has (0, 0) in the upper left corner.
std::vector<float> FlatTextureCoordinates(const TriangleMesh& mesh) {
  std::vector<float> values;
  values.reserve(mesh.texture_coordinates.size() * 2);
  for (const geometry::Vector2& uv : mesh.texture_coordinates) {
    values.push_back(static_cast<float>(uv.x));
    values.push_back(static_cast<float>(1 - uv.y));
  }
  return values;
}

bool SeeThrough(const Image* image) {
  if (image == nullptr || image->channels != 4) return false;
  for (std::size_t i = 3; i < image->pixels.size(); i += 4) {
    if (image->pixels[i] < 250) return true;
  }
  return false;
}

void SetPose(const geometry::Pose& pose, Json& node) {
  const geometry::Quaternion q = geometry::Normalized(pose.orientation);
  if (pose.position != Vector3{}) {
    node["translation"] = {pose.position.x, pose.position.y, pose.position.z};
  }
  if (q != geometry::Quaternion{}) node["rotation"] = {q.x, q.y, q.z, q.w};
}

// Returns the kind and the size (metres) of a shape, for viewers that show them as text.
Json ShapeJson(const geometry::Shape& shape) {
  const auto of = [](const Vector3& v) { return Json{v.x, v.y, v.z}; };
  if (const auto* box = std::get_if<geometry::Box>(&shape)) {
    return {{"kind", "box"}, {"size", of(box->size)}};
  }
  if (const auto* sphere = std::get_if<geometry::Sphere>(&shape)) {
    return {{"kind", "sphere"}, {"radius", sphere->radius}};
  }
  if (const auto* cylinder = std::get_if<geometry::Cylinder>(&shape)) {
    return {{"kind", "cylinder"}, {"radius", cylinder->radius}, {"length", cylinder->length}};
  }
  if (const auto* capsule = std::get_if<geometry::Capsule>(&shape)) {
    return {{"kind", "capsule"}, {"radius", capsule->radius}, {"length", capsule->length}};
  }
  if (const auto* cone = std::get_if<geometry::Cone>(&shape)) {
    return {{"kind", "cone"}, {"radius", cone->radius}, {"length", cone->length}};
  }
  if (const auto* ellipsoid = std::get_if<geometry::Ellipsoid>(&shape)) {
    return {{"kind", "ellipsoid"}, {"radii", of(ellipsoid->radii)}};
  }
  if (const auto* plane = std::get_if<geometry::Plane>(&shape)) {
    return {{"kind", "plane"}, {"size", {plane->size.x, plane->size.y}}};
  }
  const auto& mesh = std::get<geometry::Mesh>(shape);
  const geometry::Bounds bounds = geometry::BoundsOf(shape);
  return {{"kind", "mesh"},
          {"size", of(bounds.max - bounds.min)},
          {"triangles", mesh.triangles->triangles.size()}};
}

class Writer {
 public:
  base::Result<std::vector<std::uint8_t>> Write(const model::Model& model) {
    Json roots = Json::array();
    for (std::size_t i = 0; i < model.links.size(); ++i) {
      roots.push_back(AddLink(model.links[i], i));
      if (buffer_.size() > kMaxBytes) {
        return base::Fail(base::ErrorCode::kBadModel,
                          "the model has more than 1 GiB of meshes and textures, too much for a "
                          "viewer; use smaller ones",
                          model.source.empty() ? model.name : model.source);
      }
    }
    Json document{{"asset",
                   {{"version", "2.0"},
                    {"generator", "gsv"},
                    {"extras", {{"up_axis", "z"}, {"unit", "metre"}}}}},
                  {"scene", 0},
                  {"scenes", Json::array({{{"name", model.name}, {"nodes", roots}}})},
                  {"nodes", nodes_}};
    for (const auto& [name, list] : {std::pair{"meshes", &meshes_},
                                     {"materials", &materials_},
                                     {"textures", &textures_},
                                     {"images", &images_}}) {
      if (!list->empty()) document[name] = *list;
    }
    for (const Json& material : materials_) {
      if (!material.contains("extensions")) continue;
      document["extensionsUsed"] = Json::array({kLightMapExtension});
      break;
    }
    if (!textures_.empty()) {
      constexpr int kRepeat = 10497, kLinear = 9729, kTrilinear = 9987;
      document["samplers"] = Json::array({{{"magFilter", kLinear},
                                           {"minFilter", kTrilinear},
                                           {"wrapS", kRepeat},
                                           {"wrapT", kRepeat}}});
    }
    return buffer_.Finish(std::move(document));
  }

 private:
  // Accessors of the vertices that all parts of a mesh share; -1 for accessors that do not exist.
  struct Vertices {
    int position = -1, normal = -1, uv = -1;
  };

  int AddLink(const model::Link& link, std::size_t index) {
    Json node{{"name", link.name}, {"extras", {{"link", index}, {"name", link.name}}}};
    SetPose(link.model_from_link, node);
    Json children = Json::array();
    for (const model::Visual& visual : link.visuals) {
      if (const int child = AddVisual(visual); child >= 0) children.push_back(child);
    }
    if (!children.empty()) node["children"] = std::move(children);
    return Add(std::move(node), nodes_);
  }

  // Returns the index of the visual's node, or -1 if nothing of the visual is visible.
  int AddVisual(const model::Visual& visual) {
    const auto* file_mesh = std::get_if<geometry::Mesh>(&visual.shape);
    const std::shared_ptr<const TriangleMesh> triangles =
        file_mesh != nullptr ? file_mesh->triangles : Tessellated(visual.shape);
    const int mesh = AddMesh(triangles, visual.materials);
    if (mesh < 0) return -1;
    Json node{{"mesh", mesh},
              {"extras",
               {{"visual", visual.name},
                {"cast_shadows", visual.cast_shadows},
                {"shape", ShapeJson(visual.shape)}}}};
    SetPose(visual.link_from_visual, node);
    if (file_mesh != nullptr && file_mesh->scale != Vector3{1, 1, 1}) {
      node["scale"] = {file_mesh->scale.x, file_mesh->scale.y, file_mesh->scale.z};
    }
    return Add(std::move(node), nodes_);
  }

  // Returns the triangles of a shape: the same mesh object for equal shapes.
  std::shared_ptr<const TriangleMesh> Tessellated(const geometry::Shape& shape) {
    const geometry::Bounds bounds = geometry::BoundsOf(shape);
    double more = 0;  // the size of the shape, if its bounds do not determine it
    if (const auto* capsule = std::get_if<geometry::Capsule>(&shape)) more = capsule->radius;
    Vector3 normal;
    if (const auto* plane = std::get_if<geometry::Plane>(&shape)) normal = plane->normal;
    auto& mesh = tessellated_[{shape.index(), bounds.max.x, bounds.max.y, bounds.max.z, more,
                               normal.x, normal.y, normal.z}];
    if (mesh == nullptr) mesh = std::make_shared<const TriangleMesh>(geometry::Tessellate(shape));
    return mesh;
  }

  int AddMesh(const std::shared_ptr<const TriangleMesh>& triangles,
              const std::vector<Material>& materials) {
    if (triangles->positions.empty()) return -1;
    const Vertices& vertices = VerticesOf(triangles);
    Json primitives = Json::array();
    for (std::size_t p = 0; p < triangles->parts.size(); ++p) {
      const geometry::MeshPart& part = triangles->parts[p];
      if (part.triangle_count == 0) continue;
      Json attributes{{"POSITION", vertices.position}};
      if (vertices.normal >= 0) attributes["NORMAL"] = vertices.normal;
      if (vertices.uv >= 0) attributes["TEXCOORD_0"] = vertices.uv;
      const std::size_t slot = std::min<std::size_t>(part.material, materials.size() - 1);
      primitives.push_back({{"attributes", std::move(attributes)},
                            {"indices", IndicesOf(*triangles, p)},
                            {"material", AddMaterial(materials[slot])}});
    }
    if (primitives.empty()) return -1;
    return AddOnce(Json{{"primitives", std::move(primitives)}}, meshes_, mesh_index_);
  }

  const Vertices& VerticesOf(const std::shared_ptr<const TriangleMesh>& mesh) {
    const auto [it, is_new] = vertices_.try_emplace(mesh.get());
    Vertices& vertices = it->second;
    if (!is_new) return vertices;
    vertices.position = buffer_.AddPositions(Flat(mesh->positions));
    if (!mesh->normals.empty()) vertices.normal = buffer_.AddVectors(Flat(mesh->normals), 3);
    if (!mesh->texture_coordinates.empty()) {
      vertices.uv = buffer_.AddVectors(FlatTextureCoordinates(*mesh), 2);
    }
    return vertices;
  }

  int IndicesOf(const TriangleMesh& mesh, std::size_t part_index) {
    const auto [it, is_new] = indices_.try_emplace({&mesh, part_index}, 0);
    if (!is_new) return it->second;
    const geometry::MeshPart& part = mesh.parts[part_index];
    std::vector<std::uint32_t> indices;
    indices.reserve(part.triangle_count * 3);
    for (std::uint32_t t = 0; t < part.triangle_count; ++t) {
      const auto& triangle = mesh.triangles[part.first_triangle + t];
      indices.insert(indices.end(), triangle.begin(), triangle.end());
    }
    return it->second = buffer_.AddIndices(indices, mesh.positions.size());
  }

  int AddMaterial(const Material& material) {
    const auto linear = [](double value) { return model::LinearFromSrgb(value); };
    const model::Colour &base = material.base_colour, &glow = material.emissive;
    Json pbr{{"baseColorFactor",
              {linear(base.r), linear(base.g), linear(base.b), std::clamp(base.a, 0.0, 1.0)}},
             {"metallicFactor", std::clamp(material.metalness, 0.0, 1.0)},
             {"roughnessFactor", std::clamp(material.roughness, 0.0, 1.0)}};
    Json json;
    const auto set_map = [&](const std::shared_ptr<const Image>& map, const char* name,
                             bool original_allowed, Json& in) {
      if (const int texture = AddTexture(map, original_allowed); texture >= 0) {
        in[name] = {{"index", texture}};
      }
    };
    set_map(material.base_colour_map, "baseColorTexture", true, pbr);
    // The map was combined from several files, so no original file can be used.
    set_map(material.metallic_roughness_map, "metallicRoughnessTexture", false, pbr);
    json["pbrMetallicRoughness"] = std::move(pbr);
    set_map(material.normal_map, "normalTexture", true, json);
    set_map(material.emissive_map, "emissiveTexture", true, json);
    set_map(material.occlusion_map, "occlusionTexture", true, json);
    if (const int texture = AddTexture(material.light_map, true); texture >= 0) {
      json["extensions"][kLightMapExtension] = {{"index", texture}, {"intensity", 1.0}};
    }
    if (glow.r > 0 || glow.g > 0 || glow.b > 0) {
      json["emissiveFactor"] = {linear(glow.r), linear(glow.g), linear(glow.b)};
    }
    if (base.a < 1 || SeeThrough(material.base_colour_map.get())) {
      json["alphaMode"] = material.alpha_mask && base.a >= 1 ? "MASK" : "BLEND";
    }
    if (material.double_sided) json["doubleSided"] = true;
    return AddOnce(std::move(json), materials_, material_index_);
  }

  // Returns the index of the texture, or -1 if there is no usable image.
  int AddTexture(const std::shared_ptr<const Image>& image, bool original_allowed) {
    if (image == nullptr) return -1;
    const auto [it, is_new] = texture_index_.try_emplace({image.get(), original_allowed}, -1);
    if (!is_new) return it->second;
    const WebTexture encoded = EncodeForWeb(*image, original_allowed);
    if (encoded.mime_type.empty()) return -1;
    const int view = buffer_.AddBytes(encoded.bytes);
    const int index = Add(Json{{"bufferView", view}, {"mimeType", encoded.mime_type}}, images_);
    return it->second = Add(Json{{"sampler", 0}, {"source", index}}, textures_);
  }

  static int Add(Json item, Json& list) {
    list.push_back(std::move(item));
    return static_cast<int>(list.size()) - 1;
  }

  static int AddOnce(Json item, Json& list, std::map<std::string, int>& index) {
    const auto [it, is_new] = index.try_emplace(item.dump(), static_cast<int>(list.size()));
    if (is_new) list.push_back(std::move(item));
    return it->second;
  }

  using ShapeKey = std::tuple<std::size_t, double, double, double, double, double, double, double>;

  GlbBuffer buffer_;
  Json nodes_ = Json::array(), meshes_ = Json::array(), materials_ = Json::array(),
       textures_ = Json::array(), images_ = Json::array();
  std::map<ShapeKey, std::shared_ptr<const TriangleMesh>> tessellated_;
  std::map<const TriangleMesh*, Vertices> vertices_;
  std::map<std::pair<const TriangleMesh*, std::size_t>, int> indices_;
  std::map<std::pair<const Image*, bool>, int> texture_index_;
  std::map<std::string, int> material_index_, mesh_index_;
};

}  // namespace

base::Result<std::vector<std::uint8_t>> WriteGlb(const model::Model& model) {
  return Writer().Write(model);
}

}  // namespace gsv::formats
