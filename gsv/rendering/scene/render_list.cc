#include "gsv/rendering/scene/render_list.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <tuple>

#include "gsv/base/check.h"
#include "gsv/model/srgb.h"

namespace gsv::rendering {
namespace {

using geometry::Scaled;
using geometry::Vector3;

SurfaceFactors FactorsOf(const model::Material& material) {
  const model::Colour &b = material.base_colour, &e = material.emissive;
  const auto linear = [](double value) { return static_cast<float>(model::LinearFromSrgb(value)); };
  return {{linear(b.r), linear(b.g), linear(b.b), static_cast<float>(std::clamp(b.a, 0.0, 1.0))},
          {linear(e.r), linear(e.g), linear(e.b),
           static_cast<float>(std::clamp(material.metalness, 0.0, 1.0))},
          static_cast<float>(std::clamp(material.roughness, 0.05, 1.0)),
          0};
}

// Returns the shape to draw. A plane with sides of at least kLandscape and without a texture is
// enlarged to sides of at least kHorizon.
geometry::Shape AsDrawn(const model::Visual& visual) {
  constexpr double kLandscape = 20, kHorizon = 2000;
  const auto* plane = std::get_if<geometry::Plane>(&visual.shape);
  const model::Material& material = visual.materials.front();
  if (plane == nullptr || std::min(plane->size.x, plane->size.y) < kLandscape ||
      material.base_colour_map != nullptr || material.light_map != nullptr) {
    return visual.shape;
  }
  return geometry::Plane{plane->normal,
                         {std::max(plane->size.x, kHorizon), std::max(plane->size.y, kHorizon)}};
}

class Builder {
 public:
  Builder(MeshStore& meshes, TextureStore& textures) : meshes_(meshes), textures_(textures) {}

  // Adds the pieces of a visual. `part` has the visual's body and link.
  void Add(const model::Visual& visual, const DrawItem& part) {
    const DrawShape shape = meshes_.Find(AsDrawn(visual));
    const bool plane = std::holds_alternative<geometry::Plane>(visual.shape);
    const int first_surface = next_surface_;
    next_surface_ += static_cast<int>(visual.materials.size());
    for (const MeshChunk& chunk : shape.mesh->chunks) {
      const std::size_t material_index =
          std::min<std::size_t>(chunk.material, visual.materials.size() - 1);
      const model::Material& material = visual.materials[material_index];
      DrawGroup group = GroupOf(material);
      group.mesh = shape.mesh;
      group.chunk = static_cast<std::uint32_t>(&chunk - shape.mesh->chunks.data());
      group.first_index = 3 * chunk.first_triangle;
      group.index_count = 3 * chunk.triangle_count;
      group.mirrored = shape.scale.x * shape.scale.y * shape.scale.z < 0;
      group.ground = plane;
      DrawItem item = part;
      item.link_from_visual = visual.link_from_visual;
      item.scale = shape.scale;
      item.centre_in_visual = Scaled(0.5 * (chunk.bounds.min + chunk.bounds.max), shape.scale);
      item.radius = 0.5 * Norm(Scaled(chunk.bounds.max - chunk.bounds.min, shape.scale));
      item.factors = FactorsOf(material);
      // Renderers add multiples of this number and of the number of the mesh's surface, and reduce
      // the sum to eight bits. Both numbers are below 4096, so that the sum is exact as a float.
      item.factors.surface =
          static_cast<float>((first_surface + static_cast<int>(material_index)) % 4096);
      item.casts_shadow = visual.cast_shadows && !plane && group.blending != Blending::kTransparent;
      item.group = Index(std::move(group));
      items.push_back(item);
    }
  }

  std::vector<DrawGroup> groups;
  std::vector<DrawItem> items;

 private:
  DrawGroup GroupOf(const model::Material& material) {
    DrawGroup group;
    group.base_colour = textures_.Find(material.base_colour_map);
    group.normal = textures_.Find(material.normal_map);
    group.metallic_roughness = textures_.Find(material.metallic_roughness_map);
    group.emissive = textures_.Find(material.emissive_map);
    group.occlusion = textures_.Find(material.occlusion_map);
    group.light = textures_.Find(material.light_map);
    group.double_sided = material.double_sided;
    const bool map_see_through = group.base_colour != nullptr && group.base_colour->is_transparent;
    if (material.base_colour.a < 1 || (map_see_through && !material.alpha_mask)) {
      group.blending = Blending::kTransparent;
    } else if (map_see_through) {
      group.blending = Blending::kAlphaMask;
    }
    return group;
  }

  int Index(DrawGroup group) {
    const Key key{group.mesh.get(),
                  group.first_index,
                  group.base_colour.get(),
                  group.normal.get(),
                  group.metallic_roughness.get(),
                  group.emissive.get(),
                  group.occlusion.get(),
                  group.light.get(),
                  group.blending,
                  group.mirrored,
                  group.double_sided};
    const auto [it, is_new] = index_of_.try_emplace(key, static_cast<int>(groups.size()));
    if (is_new) groups.push_back(std::move(group));
    return it->second;
  }

  using Key = std::tuple<const DrawMesh*, std::uint32_t, const DrawTexture*, const DrawTexture*,
                         const DrawTexture*, const DrawTexture*, const DrawTexture*,
                         const DrawTexture*, Blending, bool, bool>;
  MeshStore& meshes_;
  TextureStore& textures_;
  std::map<Key, int> index_of_;
  int next_surface_ = 0;
};

}  // namespace

RenderList::RenderList(const world::Layout& layout, MeshStore& meshes, TextureStore& textures)
    : meshes_(meshes), textures_(textures) {
  Builder builder(meshes, textures);
  bodies_.resize(layout.bodies.size());
  for (std::size_t b = 0; b < layout.bodies.size(); ++b) {
    const world::Body& body = layout.bodies[b];
    const bool of_robot = body.is_robot();
    bodies_[b].moved = of_robot;
    bodies_[b].first_item = builder.items.size();
    DrawItem part;
    part.body = static_cast<int>(b);
    part.of_robot = of_robot;
    for (const model::Link& link : body.model->links) {
      for (const model::Visual& visual : link.visuals) {
        builder.Add(visual, part);
        ++part.visual;
      }
      ++part.link;
    }
    bodies_[b].item_count = builder.items.size() - bodies_[b].first_item;
  }
  groups_ = std::move(builder.groups);
  items_ = std::move(builder.items);
  placed_.resize(items_.size());
  body_item_count_ = items_.size();
}

void RenderList::Pose(const world::Snapshot& snapshot, Glow glow) {
  GSV_CHECK(snapshot.layout->bodies.size() == bodies_.size());
  items_.resize(body_item_count_);
  placed_.resize(body_item_count_);
  for (std::size_t b = 0; b < bodies_.size(); ++b) {
    BodyPose& last = bodies_[b];
    if (last.item_count == 0) continue;
    const world::Body& body = snapshot.layout->bodies[b];
    const auto first_joint = snapshot.state.joint_positions.begin() + body.first_joint;
    const auto last_joint = first_joint + static_cast<std::ptrdiff_t>(body.model->joints.size());
    const geometry::Pose& world_from_model = snapshot.state.bodies[b].world_from_model;
    if (last.posed && last.world_from_model == world_from_model &&
        std::equal(first_joint, last_joint, last.joints.begin(), last.joints.end())) {
      continue;
    }
    if (last.posed && !last.moved) {
      last.moved = true;
      ++moved_count_;
    }
    last.posed = true;
    last.world_from_model = world_from_model;
    last.joints.assign(first_joint, last_joint);
    const std::vector<geometry::Pose> world_from_link =
        world::LinkPoses(snapshot, static_cast<int>(b));
    for (std::size_t i = last.first_item; i < last.first_item + last.item_count; ++i) {
      Place(i, world_from_link[items_[i].link]);
    }
  }
  if (glow == Glow::kHidden) return;
  for (const LitLamp& lit : LitLamps(snapshot)) {
    AddGlow(lit, world::LinkPose(snapshot, lit.body, lit.mount->link));
  }
}

void RenderList::MakeGlow() {
  model::Visual ball;
  ball.shape = geometry::Sphere{1};
  ball.materials.front().base_colour = {0, 0, 0, 1};
  ball.cast_shadows = false;
  Builder builder(meshes_, textures_);
  DrawItem part;
  part.of_robot = true;
  builder.Add(ball, part);
  glow_ = std::move(builder.items);
  for (DrawItem& item : glow_) item.group += static_cast<int>(groups_.size());
  std::move(builder.groups.begin(), builder.groups.end(), std::back_inserter(groups_));
}

void RenderList::AddGlow(const LitLamp& lit, const geometry::Pose& world_from_link) {
  if (glow_.empty()) MakeGlow();
  const double radius = lit.glow.radius;
  const auto emitted = [&](double part) {
    return static_cast<float>(lit.glow.brightness * model::LinearFromSrgb(part));
  };
  for (DrawItem item : glow_) {
    item.body = lit.body;
    item.link = lit.mount->link;
    item.link_from_visual = lit.mount->link_from_device;
    item.scale = radius * item.scale;
    item.centre_in_visual = radius * item.centre_in_visual;
    item.radius *= radius;
    const model::Colour& colour = lit.glow.colour;
    item.factors.emissive_metalness = {emitted(colour.r), emitted(colour.g), emitted(colour.b), 0};
    items_.push_back(item);
    placed_.emplace_back();
    Place(items_.size() - 1, world_from_link);
  }
}

void RenderList::Place(std::size_t index, const geometry::Pose& world_from_link) {
  const DrawItem& item = items_[index];
  const geometry::Pose world_from_visual = world_from_link * item.link_from_visual;
  const geometry::Quaternion& q = world_from_visual.orientation;
  placed_[index] = {{q * Vector3{item.scale.x, 0, 0}, q * Vector3{0, item.scale.y, 0},
                     q * Vector3{0, 0, item.scale.z}},
                    world_from_visual.position,
                    world_from_visual * item.centre_in_visual};
}

}  // namespace gsv::rendering
