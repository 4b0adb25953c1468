// What there is to draw in a layout: one item for each piece of each visual, gathered into groups
// that are drawn by one call.
//
// A plan is made once for a layout and posed for each snapshot. It keeps no model alive, only what
// the back end made of it.
// Threads  the render thread only.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "gsv/rendering/scene/lit_lamps.h"
#include "gsv/rendering/scene/mesh_store.h"
#include "gsv/rendering/scene/texture_store.h"
#include "gsv/world/snapshot.h"

namespace gsv::rendering {

enum class Blending { kOpaque, kAlphaMask, kTransparent };

// What the items of one draw call have in common.
struct DrawGroup {
  std::shared_ptr<const DrawMesh> mesh;
  std::uint32_t chunk = 0;  // of the mesh
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  std::shared_ptr<const DrawTexture> base_colour, normal, metallic_roughness, emissive;  // or null
  Blending blending = Blending::kOpaque;
  bool mirrored = false;
  bool double_sided = false;
  bool ground = false;  // a plane: gives way to what lies on it
};

// Linear colours, as the shader takes them.
struct SurfaceFactors {
  std::array<float, 4> base_colour;
  std::array<float, 4> emissive_metalness;
  float roughness;
  float surface;  // tells surfaces of different visuals apart, for the edges between them
};

struct DrawItem {
  int group = 0;
  int body = 0;
  int link = 0;
  int visual = 0;  // among the body's, counted through its links
  geometry::Pose link_from_visual;
  geometry::Vector3 scale;
  geometry::Vector3 centre_in_visual;
  double radius = 0;  // of the sphere about the centre that holds the item
  SurfaceFactors factors;
  bool casts_shadow = false;
  bool of_robot = false;  // or of an avatar: made to move
};

// An item in the world.
struct PlacedItem {
  // Columns of the turn and stretch that take the mesh to the world's axes, and where its origin
  // is.
  std::array<geometry::Vector3, 3> columns;
  geometry::Vector3 origin;
  geometry::Vector3 centre;
};

class RenderList {
 public:
  // The stores outlive the plan.
  RenderList(const world::Layout& layout, MeshStore& meshes, TextureStore& textures);

  // Whether lamps that are on are among the items: light has no depth and is nothing to be found.
  enum class Glow { kShown, kHidden };

  // Moves every item to where `snapshot`, of this plan's layout, has it.
  void Pose(const world::Snapshot& snapshot, Glow glow = Glow::kShown);

  const std::vector<DrawGroup>& groups() const { return groups_; }
  const std::vector<DrawItem>& items() const { return items_; }
  const std::vector<PlacedItem>& placed() const { return placed_; }  // as items()

  // Whether a body is where the first snapshot had it, as buildings and furniture are that nobody
  // has pushed; robots and avatars never count as still.
  bool IsStill(int body) const { return !bodies_[body].moved; }
  // Grows with each body that moves for the first time.
  int moved_count() const { return moved_count_; }

 private:
  void Place(std::size_t item, const geometry::Pose& world_from_link);
  void MakeGlow();
  void AddGlow(const LitLamp& lit, const geometry::Pose& world_from_link);

  // What a body's links depend on, to see whether it moved.
  struct BodyPose {
    bool posed = false;
    bool moved = false;
    geometry::Pose world_from_model;
    std::vector<double> joints;
    std::size_t first_item = 0, item_count = 0;
  };

  MeshStore& meshes_;
  TextureStore& textures_;
  std::vector<DrawGroup> groups_;
  std::vector<DrawItem> items_;  // by body, then the lamps that are on
  std::size_t body_item_count_ = 0;
  std::vector<DrawItem> glow_;  // of a lamp with a radius of 1 m; empty until one is on
  std::vector<PlacedItem> placed_;
  std::vector<BodyPose> bodies_;
  int moved_count_ = 0;
};

}  // namespace gsv::rendering
