// The floor below a position, for robots whose height is not given.
#pragma once

#include <functional>

#include "gsv/sensing/rays/ray_scene.h"

namespace gsv::sensing {

// The highest floor for robots.
inline constexpr double kMaxFloorHeight = 0.3;  // m

// Returns the height of the highest floor at (x, y): a surface that is not above kMaxFloorHeight
// and is less steep than 45°. Returns 0 if there is none within ten metres below, or if a steeper
// surface covers it. A ground plane, a floor slab and a low platform are floors; a table top is
// not. Only bodies that `may_carry` accepts count; for example, the roof of a robot is no floor.
double FloorHeight(
    const RayScene& scene, double x, double y,
    const std::function<bool(int body)>& may_carry = [](int) { return true; });

}  // namespace gsv::sensing
