#include "gsv/presentation/model_identity.h"

#include <string_view>
#include <variant>
#include <vector>

#include "gsv/base/hash.h"

namespace gsv::presentation {
namespace {

// The version of the model writer. Increase it when the same model is written differently, so that
// browsers fetch models again.
constexpr std::uint64_t kWriterVersion = 1;

class Identity {
 public:
  Identity() { Add(kWriterVersion); }
  std::string Hex() const { return hash_.Hex(); }

  void Add(const model::Model& model) {
    Add(std::string_view(model.name));
    Add(model.links.size());
    for (const model::Link& link : model.links) Add(link);
  }

 private:
  void Add(std::uint64_t value) { hash_.Add(value); }
  void Add(double value) { hash_.Add(value); }
  void Add(std::string_view text) { hash_.Add(text); }
  void Add(const geometry::Vector2& v) { Add(v.x), Add(v.y); }
  void Add(const geometry::Vector3& v) { Add(v.x), Add(v.y), Add(v.z); }

  void Add(const geometry::Pose& pose) {
    Add(pose.position);
    const geometry::Quaternion& q = pose.orientation;
    Add(q.w), Add(q.x), Add(q.y), Add(q.z);
  }

  // Hashes scalars without padding between them, as bytes in memory.
  template <typename Element>
  void AddBlock(const std::vector<Element>& block) {
    static_assert(std::is_trivially_copyable_v<Element>);
    Add(std::string_view(reinterpret_cast<const char*>(block.data()),
                         block.size() * sizeof(Element)));
  }

  void Add(const geometry::TriangleMesh& mesh) {
    AddBlock(mesh.positions);
    AddBlock(mesh.normals);
    AddBlock(mesh.texture_coordinates);
    AddBlock(mesh.triangles);
    Add(mesh.parts.size());
    for (const geometry::MeshPart& part : mesh.parts) {
      Add(std::uint64_t{part.first_triangle});
      Add(std::uint64_t{part.triangle_count});
      Add(std::uint64_t{part.material});
    }
  }

  void AddShape(const geometry::Box& box) { Add(box.size); }
  void AddShape(const geometry::Sphere& sphere) { Add(sphere.radius); }
  void AddShape(const geometry::Cylinder& shape) { Add(shape.radius), Add(shape.length); }
  void AddShape(const geometry::Capsule& shape) { Add(shape.radius), Add(shape.length); }
  void AddShape(const geometry::Ellipsoid& shape) { Add(shape.radii); }
  void AddShape(const geometry::Cone& shape) { Add(shape.radius), Add(shape.length); }
  void AddShape(const geometry::Plane& plane) { Add(plane.normal), Add(plane.size); }
  void AddShape(const geometry::Mesh& mesh) { Add(*mesh.triangles), Add(mesh.scale); }

  void Add(const model::Colour& c) { Add(c.r), Add(c.g), Add(c.b), Add(c.a); }

  void Add(const std::shared_ptr<const model::Image>& map) {
    Add(std::uint64_t{map != nullptr});
    if (!map) return;
    Add(static_cast<std::uint64_t>(map->width));
    Add(static_cast<std::uint64_t>(map->height));
    Add(static_cast<std::uint64_t>(map->channels));
    AddBlock(map->pixels);
  }

  void Add(const model::Material& material) {
    Add(material.base_colour);
    Add(material.emissive);
    Add(material.metalness);
    Add(material.roughness);
    Add(material.base_colour_map);
    Add(material.normal_map);
    Add(material.metallic_roughness_map);
    Add(material.emissive_map);
    if (material.occlusion_map) Add(std::string_view("occlusion")), Add(material.occlusion_map);
    if (material.light_map) Add(std::string_view("light")), Add(material.light_map);
    Add(std::uint64_t{material.alpha_mask});
    Add(std::uint64_t{material.double_sided});
  }

  void Add(const model::Visual& visual) {
    Add(std::string_view(visual.name));
    Add(visual.link_from_visual);
    Add(visual.shape.index());
    std::visit([this](const auto& shape) { AddShape(shape); }, visual.shape);
    Add(visual.materials.size());
    for (const model::Material& material : visual.materials) Add(material);
  }

  void Add(const model::Link& link) {
    Add(std::string_view(link.name));
    Add(link.model_from_link);
    Add(link.visuals.size());
    for (const model::Visual& visual : link.visuals) Add(visual);
  }

  base::Hash hash_;
};

}  // namespace

std::string ModelIdentity(const model::Model& model) {
  Identity identity;
  identity.Add(model);
  return identity.Hex();
}

}  // namespace gsv::presentation
