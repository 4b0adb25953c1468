// Computes mass and inertia from collision shapes: SDFormat 1.11's <inertial auto="true">.
#pragma once

#include <optional>
#include <vector>

#include "gsv/model/model.h"

namespace gsv::formats {

// Water's: SDFormat's default of <density>, kg/m³.
inline constexpr double kDefaultDensity = 1000;

// For uniformly filled collisions, each with its density (kg/m³). The principal frame is parallel
// to the link's frame. Nothing if they have no volume.
std::optional<model::Inertial> InertialOf(const std::vector<model::Collision>& collisions,
                                          const std::vector<double>& densities);

}  // namespace gsv::formats
