// The echoes of light pulses: the nearest surface on each ray, and how much of the light this
// surface returns.
//
// Threads  as for RayScene.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "gsv/model/model.h"
#include "gsv/sensing/rays/ray_scene.h"

namespace gsv::sensing {

// The echo of one ray.
struct Echo {
  double distance = 0;     // m
  double cosine = 1;       // cosine of the angle of incidence; 1 at right angles to the surface
  double reflectance = 0;  // the fraction of light that the surface reflects, from 0 to 1
};

// Finds the echo of each ray. Ignores `ignored_body`. `scene` must be from a RaySceneCache.
void FindEchoes(const RayScene& scene, std::span<const Ray> rays, int ignored_body,
                std::span<std::optional<Echo>> echoes);

// Returns the reflectance of the collision with this index. This is the luminance (ITU-R BT.709,
// linear light) of the base colour of a visual. The visual is the one with the collision's name. If
// there is none, it is the visual with the same index, or else the first visual. If the visual has
// a texture, the luminance is multiplied by the mean luminance of some of its pixels. Without a
// visual or without a material, the reflectance is 0.5.
double ReflectanceOf(const model::Link& link, std::size_t collision);

}  // namespace gsv::sensing
