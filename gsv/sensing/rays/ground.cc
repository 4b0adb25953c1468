#include "gsv/sensing/rays/ground.h"

namespace gsv::sensing {

double FloorHeight(const RayScene& scene, double x, double y,
                   const std::function<bool(int body)>& may_carry) {
  constexpr double kMaxDepthBelow = 10;
  constexpr double kSteepest = 0.70710678118654757;
  // Tolerance, so that a floor exactly at kMaxFloorHeight counts.
  constexpr double kRounding = 1e-9;
  constexpr int kMaxBodies = 64;  // maximum number of ignored bodies above one another
  Ray down{{x, y, kMaxFloorHeight + kRounding}, {0, 0, -1}, kMaxFloorHeight + kMaxDepthBelow};
  for (int i = 0; i < kMaxBodies; ++i) {
    const std::optional<Hit> hit = scene.Cast(down, -1);
    if (!hit) return 0;
    if (may_carry(hit->body)) {
      return hit->normal.z >= kSteepest ? down.origin.z - hit->distance : 0;
    }
    down.origin.z -= hit->distance + 1e-6;
    down.max_distance -= hit->distance + 1e-6;
  }
  return 0;
}

}  // namespace gsv::sensing
