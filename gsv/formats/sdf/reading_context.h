// The objects that the readers of one file share.
#pragma once

#include <filesystem>
#include <string>

#include <ignition/math/Color.hh>
#include <ignition/math/Pose3.hh>
#include <ignition/math/Vector3.hh>

#include "gsv/base/error.h"
#include "gsv/formats/files/resource_finder.h"
#include "gsv/formats/images/texture_reader.h"
#include "gsv/formats/meshes/mesh_reader.h"
#include "gsv/formats/sdf/read_options.h"
#include "gsv/geometry/pose.h"
#include "gsv/model/material.h"

namespace gsv::formats {

// The objects that the readers of one file share, and the list to which they add problems.
struct ReadingContext {
  const ResourceFinder& finder;
  const ReadLimits& limits;
  TextureReader& textures;
  MeshReader& meshes;
  base::Problems& problems;
  const SensorCheck& check_sensor;  // may be empty
  std::filesystem::path source;     // the file being read

  // Adds a warning to the problems.
  void Warn(std::string message, std::string where) const {
    problems.push_back({base::Problem::Severity::kWarning, std::move(message), std::move(where)});
  }
};

inline geometry::Vector3 FromIgnition(const ignition::math::Vector3d& v) {
  return {v.X(), v.Y(), v.Z()};
}
inline geometry::Pose FromIgnition(const ignition::math::Pose3d& p) {
  return {FromIgnition(p.Pos()),
          geometry::Normalized({p.Rot().W(), p.Rot().X(), p.Rot().Y(), p.Rot().Z()})};
}
inline model::Colour FromIgnition(const ignition::math::Color& c) {
  return {static_cast<double>(c.R()), static_cast<double>(c.G()), static_cast<double>(c.B()),
          static_cast<double>(c.A())};
}

}  // namespace gsv::formats
