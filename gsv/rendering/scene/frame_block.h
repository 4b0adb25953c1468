// The shader parameters of an image: camera, lights and sky.
//
// Frame   world axes with the origin at the camera, so that single precision is enough anywhere.
// Layout  std140; the same block stands in shaders.cc.
#pragma once

#include <array>
#include <cstdint>

#include "gsv/rendering/lenses/camera_view.h"
#include "gsv/world/snapshot.h"

namespace gsv::rendering {

inline constexpr int kMaxLights = 8;

using Float4 = std::array<float, 4>;

struct LightBlock {
  Float4 position_range;   // metres; range 0: directional
  Float4 direction_outer;  // from the light, unit; cosine of the outer half angle, -2: no cone
  Float4 colour_inner;     // 1 / (cosine of the inner half angle - that of the outer one)
  Float4 attenuation;      // constant, linear, quadratic; 1 / range², 0: directional
};

struct FrameBlock {
  std::array<float, 16> clip_from_relative;
  std::array<float, 16> shadow_from_relative;
  Float4 to_sun;  // w: the side of a shadow map's texel in metres, 0: no shadows
  Float4 sun_colour;
  Float4 ambient_above, ambient_below;
  Float4 zenith, horizon, nadir;
  Float4 view_forward, view_right, view_down;  // to the centre and the edges of the image
  std::array<std::int32_t, 4> light_count;
  std::array<LightBlock, kMaxLights> lights;
};

// The lights of a world and of the robots in it, in its own frame.
class Lighting {
 public:
  explicit Lighting(const model::WorldDescription& description);

  const geometry::Vector3& to_sun() const { return to_sun_; }
  bool sun_casts_shadows() const { return shadows_; }

  // Replaces the lamps of robots by those that are on now.
  void TakeLamps(const world::Snapshot& snapshot);

  // The block without the shadow.
  FrameBlock BlockFor(const CameraView& view) const;

 private:
  struct Lamp {
    geometry::Vector3 position;
    double range = 0;  // infinite: directional
    LightBlock block;
  };
  void AddLamp(const model::Light& light);

  geometry::Vector3 to_sun_{0.5, -0.1, 0.9};
  std::array<double, 3> sun_colour_{};
  bool shadows_ = true;
  std::vector<Lamp> lamps_;         // of the world, then of robots
  std::size_t own_lamp_count_ = 0;  // number of the world's lamps
  Float4 ambient_above_, ambient_below_, zenith_, horizon_, nadir_;
};

}  // namespace gsv::rendering
