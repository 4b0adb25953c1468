#include "gsv/formats/meshes/mesh_materials.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <assimp/GltfMaterial.h>
#include <assimp/scene.h>

#include "gsv/formats/files/resource_finder.h"
#include "gsv/formats/meshes/surface_gloss.h"

namespace gsv::formats {
namespace {

using base::Problem;
using model::Colour;
using model::Image;
using model::Material;

constexpr char kFileScheme[] = "file://";

double Unit(double value) { return std::isfinite(value) ? std::clamp(value, 0.0, 1.0) : 0.0; }

Colour ToColour(const aiColor4D& c) { return {Unit(c.r), Unit(c.g), Unit(c.b), Unit(c.a)}; }

class MaterialReader {
 public:
  MaterialReader(const aiScene& scene, const std::filesystem::path& mesh, TextureReader& textures,
                 const ReadLimits& limits, base::Problems& problems)
      : scene_(scene), mesh_(mesh), textures_(textures), limits_(limits), problems_(problems) {}

  Material Read(const aiMaterial& source) {
    Material material;
    ReadColours(source, material);
    ReadGloss(source, material);
    material.base_colour_map = FirstMap(source, {aiTextureType_BASE_COLOR, aiTextureType_DIFFUSE});
    if (material.base_colour_map != nullptr && !IsGltf(source)) {
      // The image replaces the diffuse colour, so the colour must not tint the image.
      material.base_colour = {1, 1, 1, material.base_colour.a};
    }
    ReadSeeThrough(source, material);
    material.normal_map = FirstMap(source, {aiTextureType_NORMALS});
    material.emissive_map = FirstMap(source, {aiTextureType_EMISSIVE});
    if (material.emissive_map != nullptr) material.emissive = {1, 1, 1, 1};
    int two_sided = 0;
    source.Get(AI_MATKEY_TWOSIDED, two_sided);
    material.double_sided = two_sided != 0;
    return material;
  }

 private:
  static bool IsGltf(const aiMaterial& source) {
    ai_real factor = 0;
    return source.Get(AI_MATKEY_METALLIC_FACTOR, factor) == AI_SUCCESS;
  }

  void ReadColours(const aiMaterial& source, Material& material) {
    aiColor4D colour;
    if (source.Get(AI_MATKEY_BASE_COLOR, colour) == AI_SUCCESS ||
        source.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == AI_SUCCESS) {
      material.base_colour = ToColour(colour);
    }
    if (source.Get(AI_MATKEY_COLOR_EMISSIVE, colour) == AI_SUCCESS) {
      material.emissive = ToColour(colour);
    }
    ai_real opacity = 1;
    if (!IsGltf(source) && source.Get(AI_MATKEY_OPACITY, opacity) == AI_SUCCESS) {
      // Some exporters write zero for an opaque material; an invisible mesh would be useless.
      material.base_colour.a = opacity > 0 ? Unit(static_cast<double>(opacity)) : 1.0;
    }
  }

  // Reads whether the material is transparent. A colour map's alpha is used only if the file
  // requests it, because many files have a meaningless alpha.
  void ReadSeeThrough(const aiMaterial& source, Material& material) {
    std::string mode = source.GetTextureCount(aiTextureType_OPACITY) > 0 ? "MASK" : "OPAQUE";
    if (IsGltf(source)) {
      aiString written;
      if (source.Get(AI_MATKEY_GLTF_ALPHAMODE, written) == AI_SUCCESS) mode = written.C_Str();
      if (mode == "OPAQUE") material.base_colour.a = 1;
    }
    if (mode == "OPAQUE") material.base_colour_map = textures_.Opaque(material.base_colour_map);
    material.alpha_mask = mode == "MASK" && material.base_colour_map != nullptr &&
                          material.base_colour_map->channels == 4;
  }

  void ReadGloss(const aiMaterial& source, Material& material) {
    ai_real metalness = 0, roughness = 0, shininess = 0;
    if (source.Get(AI_MATKEY_METALLIC_FACTOR, metalness) == AI_SUCCESS &&
        source.Get(AI_MATKEY_ROUGHNESS_FACTOR, roughness) == AI_SUCCESS) {
      material.metalness = Unit(static_cast<double>(metalness));
      material.roughness = Unit(static_cast<double>(roughness));
      material.metallic_roughness_map = FirstMap(
          source,
          {aiTextureType_METALNESS, aiTextureType_DIFFUSE_ROUGHNESS, aiTextureType_UNKNOWN});
      int set = 0;  // only the first set of texture coordinates is read
      source.Get(AI_MATKEY_UVWSRC(aiTextureType_LIGHTMAP, 0), set);
      // assimp returns glTF's occlusion texture as a light map.
      if (set == 0) material.occlusion_map = FirstMap(source, {aiTextureType_LIGHTMAP});
      return;
    }
    aiColor4D specular(0, 0, 0, 1);
    source.Get(AI_MATKEY_COLOR_SPECULAR, specular);
    source.Get(AI_MATKEY_SHININESS, shininess);
    material.roughness = RoughnessOf(ToColour(specular), static_cast<double>(shininess));
  }

  std::shared_ptr<const Image> FirstMap(const aiMaterial& source,
                                        std::initializer_list<aiTextureType> types) {
    for (const aiTextureType type : types) {
      aiString name;
      if (source.GetTexture(type, 0, &name) == AI_SUCCESS && name.length > 0) return Read(name);
    }
    return nullptr;
  }

  std::shared_ptr<const Image> Read(const aiString& name) {
    auto image = ReadAny(name);
    if (image) return *image;
    problems_.push_back({Problem::Severity::kWarning,
                         "texture " + std::string(name.C_Str()) + ": " + image.error().message,
                         mesh_.string()});
    return nullptr;
  }

  base::Result<std::shared_ptr<const Image>> ReadAny(const aiString& name) {
    if (const aiTexture* embedded = scene_.GetEmbeddedTexture(name.C_Str())) {
      if (embedded->mHeight != 0) {
        return Fail(base::ErrorCode::kBadModel, "uncompressed embedded textures are not supported");
      }
      return DecodeImage(reinterpret_cast<const unsigned char*>(embedded->pcData), embedded->mWidth,
                         mesh_.string(), limits_);
    }
    std::string path = name.C_Str();
    std::replace(path.begin(), path.end(), '\\', '/');
    if (path.rfind(kFileScheme, 0) == 0) path.erase(0, sizeof kFileScheme - 1);
    const std::string file_name = std::filesystem::path(path).filename().string();
    // Searches only beside the mesh: a bare name must not match a file of another model.
    for (const std::string& candidate :
         {path, "../materials/textures/" + file_name, "../textures/" + file_name,
          "../../materials/textures/" + file_name, file_name}) {
      if (auto found = FindBeside(candidate, mesh_)) return textures_.Read(*found);
    }
    return Fail(base::ErrorCode::kNotFound, "there is no such file");
  }

  const aiScene& scene_;
  std::filesystem::path mesh_;
  TextureReader& textures_;
  const ReadLimits& limits_;
  base::Problems& problems_;
};

}  // namespace

std::vector<Material> ReadMeshMaterials(const aiScene& scene, const std::filesystem::path& mesh,
                                        TextureReader& textures, const ReadLimits& limits,
                                        base::Problems& problems) {
  MaterialReader reader(scene, mesh, textures, limits, problems);
  std::vector<Material> materials;
  for (unsigned i = 0; i < scene.mNumMaterials; ++i) {
    materials.push_back(reader.Read(*scene.mMaterials[i]));
  }
  if (materials.empty()) materials.emplace_back();
  return materials;
}

}  // namespace gsv::formats
