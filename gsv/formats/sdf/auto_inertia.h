// Computes mass and inertia from collision shapes: SDFormat 1.11's <inertial auto="true">.
#pragma once

#include <optional>
#include <vector>

#include "gsv/model/model.h"

namespace gsv::formats {

// SDFormat's default of <density>, which is the density of water, kg/m³.
inline constexpr double kDefaultDensity = 1000;

// Returns the inertia of uniformly filled collisions, each with its density (kg/m³). The principal
// frame is parallel to the link's frame. Returns nullopt if the collisions have no volume.
std::optional<model::Inertial> InertialOf(const std::vector<model::Collision>& collisions,
                                          const std::vector<double>& densities);

}  // namespace gsv::formats
