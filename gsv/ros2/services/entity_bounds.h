// Computes bounding boxes of bodies.
#pragma once

#include <optional>

#include "gsv/geometry/triangle_mesh.h"
#include "gsv/world/snapshot.h"

namespace gsv::ros2 {

// Returns the smallest box around the bounding boxes of a body's collision shapes, along the axes
// of the body's frame, at the present joint positions. If the body has no collision shapes, its
// visuals are used. Returns nullopt for a body without shapes, and for a body with an infinite
// plane.
std::optional<geometry::Bounds> BoundsOfBody(const world::Snapshot& snapshot, int body);

// Returns the smallest box along the world's axes that contains `bounds`, a box along a body's
// axes.
geometry::Bounds InWorld(const geometry::Bounds& bounds, const geometry::Pose& world_from_body);

}  // namespace gsv::ros2
