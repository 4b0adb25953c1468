// The appearance of a surface.
#pragma once

#include <memory>

#include "gsv/geometry/vector3.h"
#include "gsv/model/image.h"

namespace gsv::model {

// Components in [0, 1], as written in model files (sRGB).
struct Colour {
  double r = 1, g = 1, b = 1, a = 1;
  friend bool operator==(const Colour&, const Colour&) = default;
};

// The metallic-roughness model of glTF 2.0. Maps are shared between materials and may be null; a
// map is multiplied with the factor of the same name.
struct Material {
  Colour base_colour{0.7, 0.7, 0.7, 1};  // transparent if a < 1
  Colour emissive{0, 0, 0, 1};           // colour of the light that the surface emits
  double metalness = 0;
  double roughness = 0.8;
  std::shared_ptr<const Image> base_colour_map;
  std::shared_ptr<const Image> normal_map;
  std::shared_ptr<const Image> metallic_roughness_map;  // G: roughness, B: metalness
  std::shared_ptr<const Image> emissive_map;
  // R: the fraction of ambient and baked light that reaches the surface.
  std::shared_ptr<const Image> occlusion_map;
  // Baked light, sRGB. The surface reflects the baked light as diffuse light: the light map times
  // the diffuse colour is added to the colour of the surface, as in Gazebo.
  std::shared_ptr<const Image> light_map;
  // If true, the alpha of base_colour_map is a mask: a pixel is transparent if its alpha is below
  // one half. If false, alpha is blended.
  bool alpha_mask = false;
  bool double_sided = false;  // whether the back faces of triangles are drawn too
};

}  // namespace gsv::model
