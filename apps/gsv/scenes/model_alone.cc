#include "apps/gsv/scenes/model_alone.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gsv/geometry/box_corners.h"

namespace gsv::app {
namespace {

using geometry::Pose;
using geometry::Vector3;

// Returns the height of the lowest visible point in the model's frame, at zero joint positions.
double LowestVisiblePoint(const model::Model& model) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const model::Link& link : model.links) {
    for (const model::Visual& visual : link.visuals) {
      if (std::holds_alternative<geometry::Plane>(visual.shape)) continue;
      const Pose model_from_visual = link.model_from_link * visual.link_from_visual;
      for (const Vector3& corner : geometry::CornersOf(geometry::BoundsOf(visual.shape))) {
        lowest = std::min(lowest, (model_from_visual * corner).z);
      }
    }
  }
  return lowest;
}

}  // namespace

bool IsModelAlone(const model::WorldDescription& world) {
  return !world.models.empty() && world.models.size() <= 2 &&
         world.models.back().model->name == world.name;
}

void StandModelOnGround(model::WorldDescription& world) {
  model::PlacedModel& placed = world.models.back();
  const double lowest = LowestVisiblePoint(*placed.model);
  if (std::isfinite(lowest)) placed.world_from_model.position.z = -lowest;
}

}  // namespace gsv::app
