// The render list of a layout. Each visual has one item per chunk of its mesh. The items of one
// draw call are a group.
//
// A list is made once per layout and posed for each snapshot. It owns a share of the back end's
// meshes and textures, but it does not keep the models alive.
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

// How a surface uses alpha: it ignores alpha, has holes (glTF's MASK), or is blended with the
// surfaces behind it.
enum class Blending { kOpaque, kAlphaMask, kTransparent };

// The data that all items of one draw call share.
struct DrawGroup {
  std::shared_ptr<const DrawMesh> mesh;
  std::uint32_t chunk = 0;  // index of the chunk in the mesh
  // Range in the mesh's list of indices.
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  // each is null if the material has no such map
  std::shared_ptr<const DrawTexture> base_colour, normal, metallic_roughness, emissive, occlusion,
      light;
  Blending blending = Blending::kOpaque;
  // whether the scale mirrors the mesh, so that its front faces are reversed
  bool mirrored = false;
  bool double_sided = false;
  bool ground = false;  // true for a plane, which is drawn behind coplanar surfaces
};

// The factors of a material (as in glTF): the shader multiplies the values of its textures by them.
// Colours are linear.
struct SurfaceFactors {
  std::array<float, 4> base_colour;  // red, green, blue, alpha
  // red, green and blue of the emitted light; then the metalness
  std::array<float, 4> emissive_metalness;
  float roughness;
  float surface;  // the visual's number, for antialiasing
};

// One visual, or one chunk of it, on a link.
struct DrawItem {
  int group = 0;   // index in RenderList::groups()
  int body = 0;    // index in Layout::bodies
  int link = 0;    // index in Model::links
  int visual = 0;  // index among the body's visuals, in the order of links
  geometry::Pose link_from_visual;
  geometry::Vector3 scale;             // factor from the mesh to the visual, along each axis
  geometry::Vector3 centre_in_visual;  // centre of the bounding sphere
  double radius = 0;                   // radius of the bounding sphere about the centre
  SurfaceFactors factors;              // colours and roughness of the material
  bool casts_shadow = false;
  bool of_robot = false;  // whether the item belongs to a robot or an avatar
};

// An item with its pose in the world.
struct PlacedItem {
  // The columns of the matrix that rotates and scales vectors from the mesh to the world's axes,
  // and the origin of the mesh in the world.
  std::array<geometry::Vector3, 3> columns;
  geometry::Vector3 origin;
  geometry::Vector3 centre;  // centre of the item's bounding sphere in the world
};

// The meshes, materials and poses of all visuals of a layout, ready for drawing.
class RenderList {
 public:
  // The stores must outlive the list.
  RenderList(const world::Layout& layout, MeshStore& meshes, TextureStore& textures);

  // Whether the items include the glow of lamps. Depth and label images do not show the glow.
  enum class Glow { kShown, kHidden };

  // Poses every item as in `snapshot`, which has this list's layout.
  void Pose(const world::Snapshot& snapshot, Glow glow = Glow::kShown);

  const std::vector<DrawGroup>& groups() const { return groups_; }
  const std::vector<DrawItem>& items() const { return items_; }
  const std::vector<PlacedItem>& placed() const { return placed_; }  // in the order of items()

  // Whether a body has not moved since the first snapshot. Always false for robots and avatars.
  bool IsStill(int body) const { return !bodies_[body].moved; }
  // The number of bodies that have moved. Robots and avatars do not count.
  int moved_count() const { return moved_count_; }

 private:
  // Computes the pose of an item from the pose of its link.
  void Place(std::size_t item, const geometry::Pose& world_from_link);
  // Makes glow_, a sphere with a radius of 1 m.
  void MakeGlow();
  // Adds the sphere of a lamp that is on.
  void AddGlow(const LitLamp& lit, const geometry::Pose& world_from_link);

  // The pose and joints of a body, to detect motion.
  struct BodyPose {
    bool posed = false;  // whether Pose() has posed the body
    // whether the body has moved since the first snapshot; always true for robots and avatars
    bool moved = false;
    geometry::Pose world_from_model;
    std::vector<double> joints;                  // joint positions, in the order of the model
    std::size_t first_item = 0, item_count = 0;  // the body's items in items_
  };

  MeshStore& meshes_;
  TextureStore& textures_;
  std::vector<DrawGroup> groups_;
  std::vector<DrawItem> items_;      // items by body, then the lamps that are on
  std::size_t body_item_count_ = 0;  // number of items in items_ without the lamps that are on
  // the items of a lamp's glow before scaling: a sphere with a radius of 1 m; empty until a lamp is
  // on
  std::vector<DrawItem> glow_;
  std::vector<PlacedItem> placed_;  // in the order of items_
  std::vector<BodyPose> bodies_;
  int moved_count_ = 0;
};

}  // namespace gsv::rendering
