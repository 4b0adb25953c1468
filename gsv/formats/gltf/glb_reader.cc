#include "gsv/formats/gltf/glb_reader.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "gsv/formats/images/texture_reader.h"

namespace gsv::formats {
namespace {

using GlbJson = nlohmann::json;
using GlbBytes = std::span<const std::uint8_t>;
using geometry::Vector3;

constexpr std::uint32_t kGlbMagic = 0x46546c67, kJsonChunk = 0x4e4f534a, kBinChunk = 0x004e4942;
constexpr std::int64_t kGlbFloat = 5126, kGlbShort = 5123, kGlbInt = 5125;
// Maximum number of values in all meshes of a model together. The size of the file does not limit
// this number, because many meshes can use the same accessor.
constexpr std::size_t kMaxGlbNumbers = 200'000'000;

// The exception for bytes that WriteGlb() has not written. This source file throws and catches it.
struct Flaw {
  std::string what;
};

std::uint32_t NumberAt(GlbBytes bytes, std::size_t at) {
  if (at + 4 > bytes.size()) throw Flaw{"it is truncated"};
  return static_cast<std::uint32_t>(bytes[at]) | static_cast<std::uint32_t>(bytes[at + 1]) << 8 |
         static_cast<std::uint32_t>(bytes[at + 2]) << 16 |
         static_cast<std::uint32_t>(bytes[at + 3]) << 24;
}

GlbBytes PartOf(GlbBytes bytes, std::size_t at, std::size_t size) {
  if (at > bytes.size() || size > bytes.size() - at)
    throw Flaw{"a chunk extends beyond the end of the file"};
  return bytes.subspan(at, size);
}

// Returns the member with that name, or null.
const GlbJson& Member(const GlbJson& object, const char* name) {
  static const GlbJson kNothing;
  if (!object.is_object()) return kNothing;
  const auto found = object.find(name);
  return found == object.end() ? kNothing : *found;
}

std::size_t WholeOf(const GlbJson& json, const char* what) {
  if (!json.is_number_unsigned()) throw Flaw{std::string(what) + " is not a number"};
  return json.get<std::size_t>();
}

const GlbJson& EntryOf(const GlbJson& document, const char* list, std::size_t index) {
  const GlbJson& entries = Member(document, list);
  if (!entries.is_array() || index >= entries.size()) {
    throw Flaw{std::string("it has no entry ") + std::to_string(index) + " in " + list};
  }
  return entries[index];
}

double FiniteOf(const GlbJson& json, double otherwise) {
  const double value = json.is_number() ? json.get<double>() : otherwise;
  return std::isfinite(value) ? value : otherwise;
}

double ElementOf(const GlbJson& list, std::size_t index, double otherwise) {
  return list.is_array() && index < list.size() ? FiniteOf(list[index], otherwise) : otherwise;
}

Vector3 VectorOf(const GlbJson& list, double otherwise) {
  return {ElementOf(list, 0, otherwise), ElementOf(list, 1, otherwise),
          ElementOf(list, 2, otherwise)};
}

geometry::Pose PoseOfNode(const GlbJson& node) {
  const GlbJson& rotation = Member(node, "rotation");
  return {VectorOf(Member(node, "translation"), 0),
          geometry::Normalized({ElementOf(rotation, 3, 1), ElementOf(rotation, 0, 0),
                                ElementOf(rotation, 1, 0), ElementOf(rotation, 2, 0)})};
}

std::string TextOf(const GlbJson& json) {
  return json.is_string() ? json.get<std::string>() : std::string();
}

// Converts linear light to sRGB: the inverse of model::LinearFromSrgb().
double SrgbOf(double linear) {
  linear = std::clamp(linear, 0.0, 1.0);
  return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

model::Colour ColourOf(const GlbJson& list, double otherwise) {
  const Vector3 c = VectorOf(list, otherwise);
  return {SrgbOf(c.x), SrgbOf(c.y), SrgbOf(c.z), std::clamp(ElementOf(list, 3, 1), 0.0, 1.0)};
}

// Returns the plane if the mesh is the rectangle that Tessellate() makes of a geometry::Plane with
// the normal (0, 0, 1).
std::optional<geometry::Plane> AsPlane(const geometry::TriangleMesh& mesh) {
  if (mesh.positions.size() != 4 || mesh.triangles.size() != 2) return std::nullopt;
  for (const Vector3& p : mesh.positions) {
    if (p.z != 0) return std::nullopt;
  }
  for (const Vector3& n : mesh.normals) {
    if (!(n.z > 0.999)) return std::nullopt;
  }
  const geometry::Bounds bounds = geometry::BoundsOf(mesh);
  const bool is_centred = bounds.min.x == -bounds.max.x && bounds.min.y == -bounds.max.y;
  if (!is_centred) return std::nullopt;
  return geometry::Plane{{0, 0, 1}, {2 * bounds.max.x, 2 * bounds.max.y}};
}

class GlbModelReader {
 public:
  GlbModelReader(GlbBytes bytes, const std::string& name) : name_(name) {
    if (NumberAt(bytes, 0) != kGlbMagic || NumberAt(bytes, 4) != 2) throw Flaw{"it is not glTF 2"};
    const std::size_t json_size = NumberAt(bytes, 12);
    if (NumberAt(bytes, 16) != kJsonChunk) throw Flaw{"it has no JSON"};
    const GlbBytes text = PartOf(bytes, 20, json_size);
    const std::string_view characters(reinterpret_cast<const char*>(text.data()), text.size());
    document_ = GlbJson::parse(characters, nullptr, false);
    if (!document_.is_object()) throw Flaw{"its JSON cannot be read"};
    const std::size_t next = 20 + json_size;
    if (next + 8 <= bytes.size() && NumberAt(bytes, next + 4) == kBinChunk) {
      binary_ = PartOf(bytes, next + 8, NumberAt(bytes, next));
    }
  }

  model::Model Read() {
    const GlbJson& scene = EntryOf(document_, "scenes", 0);
    model::Model model;
    model.name = TextOf(Member(scene, "name"));
    model.source = name_;
    const GlbJson& roots = Member(scene, "nodes");
    if (!roots.is_array() || roots.empty()) throw Flaw{"it has no links"};
    for (const GlbJson& root : roots) {
      model.links.push_back(ReadLink(EntryOf(document_, "nodes", WholeOf(root, "a node"))));
    }
    return model;
  }

 private:
  struct MeshOf {
    std::shared_ptr<const geometry::TriangleMesh> triangles;
    std::vector<model::Material> materials;
  };

  model::Link ReadLink(const GlbJson& node) {
    model::Link link;
    link.name = TextOf(Member(Member(node, "extras"), "name"));
    link.model_from_link = PoseOfNode(node);
    const GlbJson& children = Member(node, "children");
    if (!children.is_array()) return link;
    for (const GlbJson& child : children) {
      link.visuals.push_back(ReadVisual(EntryOf(document_, "nodes", WholeOf(child, "a node"))));
    }
    return link;
  }

  model::Visual ReadVisual(const GlbJson& node) {
    const GlbJson& extras = Member(node, "extras");
    const MeshOf& mesh = ReadMesh(WholeOf(Member(node, "mesh"), "a mesh"));
    model::Visual visual;
    visual.name = TextOf(Member(extras, "visual"));
    visual.link_from_visual = PoseOfNode(node);
    visual.materials = mesh.materials;
    const GlbJson& shadows = Member(extras, "cast_shadows");
    visual.cast_shadows = !shadows.is_boolean() || shadows.get<bool>();
    const auto plane = AsPlane(*mesh.triangles);
    const bool is_plain = mesh.materials.front().base_colour_map == nullptr;
    if (plane && is_plain && !node.contains("scale")) {
      visual.shape = *plane;
    } else {
      visual.shape = geometry::Mesh{mesh.triangles, VectorOf(Member(node, "scale"), 1)};
    }
    return visual;
  }

  const MeshOf& ReadMesh(std::size_t index) {
    const auto [it, is_new] = meshes_.try_emplace(index);
    if (!is_new) return it->second;
    const GlbJson& primitives = Member(EntryOf(document_, "meshes", index), "primitives");
    if (!primitives.is_array() || primitives.empty()) throw Flaw{"a mesh has no parts"};
    auto mesh = std::make_shared<geometry::TriangleMesh>();
    // for each combination of accessors that a primitive uses: the index of the first vertex
    std::map<VertexKey, std::uint32_t> first_vertex;
    for (const GlbJson& primitive : primitives) {
      geometry::MeshPart part;
      part.first_triangle = static_cast<std::uint32_t>(mesh->triangles.size());
      part.material = static_cast<std::uint32_t>(it->second.materials.size());
      AddTriangles(primitive, AddVertices(primitive, first_vertex, *mesh), *mesh);
      part.triangle_count =
          static_cast<std::uint32_t>(mesh->triangles.size()) - part.first_triangle;
      mesh->parts.push_back(part);
      it->second.materials.push_back(ReadMaterial(Member(primitive, "material")));
    }
    it->second.triangles = std::move(mesh);
    return it->second;
  }

  using VertexKey = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

  // Adds the vertices of a primitive to `mesh`, unless an earlier primitive had the same accessors.
  // Returns the index of the primitive's first vertex.
  std::uint32_t AddVertices(const GlbJson& primitive, std::map<VertexKey, std::uint32_t>& known,
                            geometry::TriangleMesh& mesh) {
    const GlbJson& attributes = Member(primitive, "attributes");
    const auto accessor = [&](const char* name) {
      const GlbJson& json = Member(attributes, name);
      return json.is_null() ? -1 : static_cast<std::int64_t>(WholeOf(json, name));
    };
    const VertexKey key{accessor("POSITION"), accessor("NORMAL"), accessor("TEXCOORD_0")};
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    const auto [it, is_new] = known.try_emplace(key, first);
    if (!is_new) return it->second;
    const std::vector<float> positions = FloatsOf(std::get<0>(key), 3);
    const std::vector<float> normals = FloatsOf(std::get<1>(key), 3);
    const std::vector<float> uvs = FloatsOf(std::get<2>(key), 2);
    const std::size_t count = positions.size() / 3;
    const bool fits = (normals.empty() || normals.size() == 3 * count) &&
                      (uvs.empty() || uvs.size() == 2 * count) &&
                      (first == 0 || mesh.normals.empty() == normals.empty()) &&
                      (first == 0 || mesh.texture_coordinates.empty() == uvs.empty());
    if (count == 0 || !fits) throw Flaw{"the vertex arrays of a mesh differ in length"};
    for (std::size_t i = 0; i < count; ++i) {
      mesh.positions.push_back({positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]});
      if (!normals.empty()) {
        mesh.normals.push_back({normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]});
      }
      if (!uvs.empty()) mesh.texture_coordinates.push_back({uvs[2 * i], 1 - uvs[2 * i + 1]});
    }
    return first;
  }

  void AddTriangles(const GlbJson& primitive, std::uint32_t first, geometry::TriangleMesh& mesh) {
    const GlbJson& accessor =
        EntryOf(document_, "accessors", WholeOf(Member(primitive, "indices"), "indices"));
    const std::size_t type = WholeOf(Member(accessor, "componentType"), "componentType");
    if (type != kGlbShort && type != kGlbInt) throw Flaw{"the indices of a mesh are not whole"};
    const std::size_t width = type == kGlbShort ? 2 : 4;
    const GlbBytes data = DataOf(accessor, width);
    const std::size_t limit = mesh.positions.size();
    const auto index = [&](std::size_t i) {
      std::uint32_t value = 0;
      std::memcpy(&value, data.data() + i * width, width);
      if (value >= limit - first) throw Flaw{"a triangle refers to a vertex that does not exist"};
      return first + value;
    };
    for (std::size_t i = 0; (i + 3) * width <= data.size(); i += 3) {
      mesh.triangles.push_back({index(i), index(i + 1), index(i + 2)});
    }
  }

  std::vector<float> FloatsOf(std::int64_t index, std::size_t components) {
    if (index < 0) return {};
    const GlbJson& accessor = EntryOf(document_, "accessors", static_cast<std::size_t>(index));
    if (Member(accessor, "componentType") != GlbJson(kGlbFloat)) {
      throw Flaw{"the vertices of a mesh are not floats"};
    }
    const GlbBytes data = DataOf(accessor, 4 * components);
    std::vector<float> values(data.size() / 4);
    std::memcpy(values.data(), data.data(), data.size());
    for (float& value : values) {
      if (!std::isfinite(value)) value = 0;
    }
    return values;
  }

  // Returns the bytes to which an accessor refers. `size` is the size of an element in bytes.
  GlbBytes DataOf(const GlbJson& accessor, std::size_t size) {
    const std::size_t count = WholeOf(Member(accessor, "count"), "count");
    numbers_ += std::min(count, kMaxGlbNumbers) * (size / 2);
    if (numbers_ > kMaxGlbNumbers) throw Flaw{"it has too many vertices and triangles"};
    return PartOf(ViewOf(Member(accessor, "bufferView")), 0, count * size);
  }

  GlbBytes ViewOf(const GlbJson& index) {
    const GlbJson& view = EntryOf(document_, "bufferViews", WholeOf(index, "bufferView"));
    return PartOf(binary_, WholeOf(Member(view, "byteOffset"), "byteOffset"),
                  WholeOf(Member(view, "byteLength"), "byteLength"));
  }

  model::Material ReadMaterial(const GlbJson& index) {
    model::Material material;
    if (index.is_null()) return material;
    const GlbJson& json = EntryOf(document_, "materials", WholeOf(index, "a material"));
    const GlbJson& pbr = Member(json, "pbrMetallicRoughness");
    material.base_colour = ColourOf(Member(pbr, "baseColorFactor"), 1);
    material.emissive = ColourOf(Member(json, "emissiveFactor"), 0);
    material.metalness = std::clamp(FiniteOf(Member(pbr, "metallicFactor"), 1), 0.0, 1.0);
    material.roughness = std::clamp(FiniteOf(Member(pbr, "roughnessFactor"), 1), 0.0, 1.0);
    material.base_colour_map = ReadTexture(Member(pbr, "baseColorTexture"));
    material.metallic_roughness_map = ReadTexture(Member(pbr, "metallicRoughnessTexture"));
    material.normal_map = ReadTexture(Member(json, "normalTexture"));
    material.emissive_map = ReadTexture(Member(json, "emissiveTexture"));
    material.occlusion_map = ReadTexture(Member(json, "occlusionTexture"));
    material.light_map = ReadTexture(Member(Member(json, "extensions"), "MOZ_lightmap"));
    material.alpha_mask = Member(json, "alphaMode") == GlbJson("MASK");
    material.double_sided = Member(json, "doubleSided") == GlbJson(true);
    return material;
  }

  // Returns null if there is no texture, or if it cannot be decoded.
  std::shared_ptr<const model::Image> ReadTexture(const GlbJson& reference) {
    if (reference.is_null()) return nullptr;
    const std::size_t index = WholeOf(Member(reference, "index"), "a texture");
    const auto [it, is_new] = textures_.try_emplace(index);
    if (!is_new) return it->second;
    const GlbJson& texture = EntryOf(document_, "textures", index);
    const GlbJson& image =
        EntryOf(document_, "images", WholeOf(Member(texture, "source"), "an image"));
    const GlbBytes bytes = ViewOf(Member(image, "bufferView"));
    if (const auto decoded = DecodeImage(bytes.data(), bytes.size(), name_, {})) {
      it->second = *decoded;
    }
    return it->second;
  }

  const std::string& name_;
  GlbJson document_;
  GlbBytes binary_;
  std::size_t numbers_ = 0;
  std::map<std::size_t, MeshOf> meshes_;
  std::map<std::size_t, std::shared_ptr<const model::Image>> textures_;
};

}  // namespace

base::Result<model::Model> ReadGlb(GlbBytes bytes, const std::string& name) {
  try {
    return GlbModelReader(bytes, name).Read();
  } catch (const Flaw& flaw) {
    return base::Fail(base::ErrorCode::kCorrupt, "cannot read the model: " + flaw.what, name);
  }
}

}  // namespace gsv::formats
