#include "gsv/formats/sdf/sdf_material.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <vector>

#include <sdf/Element.hh>
#include <sdf/Material.hh>
#include <sdf/Pbr.hh>

#include "gsv/base/sorting.h"
#include "gsv/formats/meshes/surface_gloss.h"
#include "gsv/formats/sdf/gazebo_materials.h"
#include "gsv/formats/sdf/ogre_material.h"
#include "gsv/formats/sdf/sdf_document.h"

namespace gsv::formats {
namespace {

namespace fs = std::filesystem;
using model::Colour;
using model::Image;
using model::Material;

constexpr std::size_t kMaxScriptBytes = 4u << 20;

Colour Clamped(const Colour& c) {
  const auto unit = [](double v) { return v > 0 ? std::min(v, 1.0) : 0.0; };
  return {unit(c.r), unit(c.g), unit(c.b), unit(c.a)};
}

class MaterialOfVisual {
 public:
  MaterialOfVisual(const sdf::Visual& visual, const ReadingContext& context)
      : source_(*visual.Material()),
        element_(source_.Element()),
        file_(FileOf(*visual.Element(), context.source)),
        place_(PlaceOf(*visual.Element(), context.source)),
        context_(context) {}

  std::optional<Material> Read() {
    bool said_anything = ReadScript();
    said_anything = ReadColours() || said_anything;
    said_anything = ReadMaps() || said_anything;
    if (!said_anything) return std::nullopt;
    material_.double_sided = material_.double_sided || source_.DoubleSided();
    material_.base_colour = Clamped(material_.base_colour);
    material_.emissive = Clamped(material_.emissive);
    material_.alpha_mask =
        material_.base_colour_map != nullptr && material_.base_colour_map->channels == 4;
    return material_;
  }

 private:
  bool Has(const char* name) const { return element_ != nullptr && element_->HasElement(name); }

  bool ReadColours() {
    if (Has("diffuse")) {
      material_.base_colour = FromIgnition(source_.Diffuse());
    } else if (Has("ambient") && !Has("script")) {
      material_.base_colour = FromIgnition(source_.Ambient());
    }
    if (Has("emissive")) material_.emissive = FromIgnition(source_.Emissive());
    if (Has("specular")) {
      double shininess = 0;
      if (Has("shininess")) shininess = element_->Get<double>("shininess", 0.0).first;
      material_.roughness = RoughnessOf(FromIgnition(source_.Specular()), shininess);
    }
    return Has("diffuse") || Has("ambient");
  }

  bool ReadMaps() {
    if (!source_.NormalMap().empty()) material_.normal_map = Texture(source_.NormalMap());
    const sdf::Pbr* pbr = source_.PbrMaterial();
    if (pbr == nullptr) return false;
    const sdf::PbrWorkflow* flow = pbr->Workflow(sdf::PbrWorkflowType::METAL);
    if (flow == nullptr) return ReadSpecularWorkflow(pbr->Workflow(sdf::PbrWorkflowType::SPECULAR));
    ReadSharedMaps(*flow);
    material_.metalness = std::clamp(flow->Metalness(), 0.0, 1.0);
    material_.roughness = std::clamp(flow->Roughness(), 0.0, 1.0);
    material_.metallic_roughness_map =
        context_.textures.Combine(Texture(flow->RoughnessMap()), Texture(flow->MetalnessMap()));
    return true;
  }

  bool ReadSpecularWorkflow(const sdf::PbrWorkflow* flow) {
    if (flow == nullptr) return false;
    ReadSharedMaps(*flow);
    material_.roughness = std::clamp(1.0 - flow->Glossiness(), 0.0, 1.0);
    return true;
  }

  void ReadSharedMaps(const sdf::PbrWorkflow& flow) {
    if (!flow.AlbedoMap().empty()) {
      material_.base_colour_map = Texture(flow.AlbedoMap());
      if (!Has("diffuse") && material_.base_colour_map != nullptr) material_.base_colour = {};
    }
    if (!flow.NormalMap().empty()) material_.normal_map = Texture(flow.NormalMap());
    if (!flow.EmissiveMap().empty()) {
      material_.emissive_map = Texture(flow.EmissiveMap());
      if (!Has("emissive") && material_.emissive_map != nullptr) material_.emissive = {};
    }
    material_.occlusion_map = Texture(flow.AmbientOcclusionMap());
    ReadLightMap(flow);
  }

  // GSV's meshes have one set of texture coordinates, so only set 0 can be used.
  void ReadLightMap(const sdf::PbrWorkflow& flow) {
    if (flow.LightMap().empty()) return;
    if (flow.LightMapTexCoordSet() != 0) return;  // element_audit.h adds a warning
    material_.light_map = Texture(flow.LightMap());
  }

  std::shared_ptr<const Image> Texture(const std::string& name) {
    if (name.empty()) return nullptr;
    auto path = context_.finder.Find(name, file_);
    if (!path) {
      if (auto beside = FindBesideScripts(name)) path = *beside;
    }
    auto image = path ? context_.textures.Read(*path)
                      : base::Result<std::shared_ptr<const Image>>(Fail(path.error()));
    if (image) return *image;
    context_.Warn("texture " + name + ": " + image.error().message, place_);
    return nullptr;
  }

  bool ReadScript() {
    if (!Has("script")) return false;
    const sdf::ElementPtr script = element_->GetElement("script");
    const std::string name = script->Get<std::string>("name", "").first;
    if (name.empty() || name == "__default__") return false;
    std::vector<fs::path>& places = script_places_;
    if (script->HasElement("uri")) {
      for (auto uri = script->GetElement("uri"); uri != nullptr; uri = uri->GetNextElement("uri")) {
        if (auto place = context_.finder.Find(uri->Get<std::string>(), file_)) {
          places.push_back(*place);
        }
      }
    }
    if (const auto ogre = FindInScripts(name, places)) {
      Apply(*ogre);
      return true;
    }
    if (auto known = GazeboMaterial(name)) {
      material_ = *known;
      return true;
    }
    context_.Warn(
        "material " + name + " is not in its scripts, and is not one of Gazebo's materials",
        place_);
    return false;
  }

  static std::optional<OgreMaterial> FindInScripts(const std::string& name,
                                                   const std::vector<fs::path>& places) {
    for (const fs::path& place : places) {
      for (const fs::path& file : ScriptsAt(place)) {
        std::error_code error;
        if (fs::file_size(file, error) > kMaxScriptBytes || error) continue;
        std::ifstream stream(file, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(stream),
                               std::istreambuf_iterator<char>()};
        const auto materials = ParseOgreMaterials(text);
        if (const auto it = materials.find(name); it != materials.end()) return it->second;
      }
    }
    return std::nullopt;
  }

  static std::vector<fs::path> ScriptsAt(const fs::path& place) {
    std::error_code error;
    if (!fs::is_directory(place, error)) return {place};
    std::vector<fs::path> scripts;
    for (const auto& entry : fs::directory_iterator(place, error)) {
      if (entry.path().extension() == ".material") scripts.push_back(entry.path());
    }
    base::Sort(scripts);
    return scripts;
  }

  // Finds an image in the folders of the visual's script. Like OGRE, this uses only the file name.
  std::optional<fs::path> FindBesideScripts(const std::string& name) const {
    for (const fs::path& place : script_places_) {
      for (const fs::path& folder : {place, place.parent_path(), place / "../textures",
                                     place.parent_path() / "../textures"}) {
        std::error_code error;
        const fs::path file = (folder / fs::path(name).filename()).lexically_normal();
        if (fs::is_regular_file(file, error)) return file;
      }
    }
    return std::nullopt;
  }

  void Apply(const OgreMaterial& ogre) {
    if (ogre.diffuse)
      material_.base_colour = *ogre.diffuse;
    else if (ogre.ambient)
      material_.base_colour = *ogre.ambient;
    if (ogre.emissive) material_.emissive = *ogre.emissive;
    if (ogre.specular) material_.roughness = RoughnessOf(*ogre.specular, ogre.shininess);
    if (ogre.texture.empty()) return;
    // If the pass has an image and no colour, the image is not tinted.
    if (!ogre.diffuse) material_.base_colour = {};
    const auto file = FindBesideScripts(ogre.texture);
    const auto image = file ? context_.textures.Read(*file)
                            : base::Result<std::shared_ptr<const Image>>(
                                  base::Fail(base::ErrorCode::kNotFound,
                                             "there is no such image in the folder of its script"));
    if (image) {
      material_.base_colour_map = *image;
    } else {
      context_.Warn("texture " + ogre.texture + ": " + image.error().message, place_);
    }
  }

  const sdf::Material& source_;
  sdf::ElementPtr element_;
  fs::path file_;
  std::string place_;
  std::vector<fs::path> script_places_;  // files and folders of the <script>'s <uri>s
  const ReadingContext& context_;
  Material material_;
};

}  // namespace

std::optional<Material> ReadVisualMaterial(const sdf::Visual& visual,
                                           const ReadingContext& context) {
  if (visual.Material() == nullptr) return std::nullopt;
  return MaterialOfVisual(visual, context).Read();
}

}  // namespace gsv::formats
