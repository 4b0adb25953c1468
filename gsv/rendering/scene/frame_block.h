// The shader parameters of an image: camera, lights and sky.
//
// Frame   the world's axes with the origin at the camera, so that single precision suffices
//         everywhere.
// Layout  std140; shaders.cc declares the same block.
#pragma once

#include <array>
#include <cstdint>

#include "gsv/rendering/lenses/camera_view.h"
#include "gsv/world/snapshot.h"

namespace gsv::rendering {

inline constexpr int kMaxLights = 8;  // maximum number of lights of an image besides the sun

using Float4 = std::array<float, 4>;

// One light in a FrameBlock.
struct LightBlock {
  Float4 position_range;  // position in metres and range; a directional light has range 0
  // unit vector away from the light; cosine of the outer half angle, or -2 if it has no cone
  Float4 direction_outer;
  // colour; 1 / (cosine of the inner half angle - cosine of the outer half angle)
  Float4 colour_inner;
  Float4 attenuation;  // constant, linear, quadratic; then 1 / range², or 0 for a directional light
};

// The parameters of an image.
struct FrameBlock {
  // Column-major matrices from the frame of this block to clip space and to the shadow map.
  std::array<float, 16> clip_from_relative;
  std::array<float, 16> shadow_from_relative;
  Float4 to_sun;      // w is the side of a shadow map's texel in metres, or 0 without shadows
  Float4 sun_colour;  // linear light
  Float4 ambient_above, ambient_below;  // ambient light on surfaces that face up and down
  Float4 zenith, horizon, nadir;        // colours of the sky above, at the horizon and below
  // Vectors from the camera to the image's centre, and from the image's centre to the middles of
  // its right and of its lower edge.
  Float4 view_forward, view_right, view_down;
  // Element 0 is the number of used elements of `lights`. Elements 1 to 3 are 0.
  std::array<std::int32_t, 4> light_count;
  std::array<LightBlock, kMaxLights> lights;
};

// The lights of a world and of the robots in it, in the world's frame.
class Lighting {
 public:
  explicit Lighting(const model::WorldDescription& description);

  // The direction to the sun, unit length, in the world.
  const geometry::Vector3& to_sun() const { return to_sun_; }
  bool sun_casts_shadows() const { return shadows_; }

  // Replaces the lamps of robots by the lamps that are on in `snapshot`.
  void TakeLamps(const world::Snapshot& snapshot);

  // Returns the block of a view, without the shadow parameters (see ShadowRegion::Describe()).
  FrameBlock BlockFor(const CameraView& view) const;

 private:
  struct Lamp {
    geometry::Vector3 position;
    double range = 0;  // infinite for directional lights
    LightBlock block;
  };
  // Adds a light of any kind, except the sun, to lamps_.
  void AddLamp(const model::Light& light);

  geometry::Vector3 to_sun_{0.5, -0.1, 0.9};
  std::array<double, 3> sun_colour_{};  // red, green and blue, linear light
  bool shadows_ = true;                 // whether the sun casts shadows
  std::vector<Lamp> lamps_;             // lamps of the world, followed by the lamps of robots
  std::size_t own_lamp_count_ = 0;      // number of lamps in lamps_ that belong to the world
  Float4 ambient_above_, ambient_below_, zenith_, horizon_, nadir_;  // see FrameBlock
};

}  // namespace gsv::rendering
