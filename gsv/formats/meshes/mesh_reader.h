// Reads meshes (COLLADA, OBJ, STL, glTF) with their materials; each file is read once.
//
// Units    metres: COLLADA's <unit> is applied.
// Axes     the file's own: like Gazebo and RViz, COLLADA's <up_axis> is ignored, because models
//          are made for those (TurtleBot3's arena says Y_UP and stands along z). glTF's y is up by
//          its definition and is likewise kept.
// Repairs  triangles without area, and those that name vertices that do not exist, are dropped.
// Errors   a sentence for a file that is absent, beyond the limits, unreadable or without
// triangles. Threads  one at a time.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/formats/images/texture_reader.h"
#include "gsv/geometry/triangle_mesh.h"
#include "gsv/model/material.h"

namespace gsv::formats {

struct MeshFile {
  std::shared_ptr<const geometry::TriangleMesh> triangles;
  std::vector<model::Material> materials;  // as the mesh's parts name them
};

class MeshReader {
 public:
  MeshReader(const ReadLimits& limits, TextureReader& textures)
      : limits_(limits), textures_(textures) {}

  // `submesh` empty: all of it; `centred`: moved so that the box around it has its middle at the
  // origin. A submesh is named by the name or id of its node or geometry. Textures that cannot be
  // read, and what was left out of the mesh, are warnings.
  base::Result<MeshFile> Read(const std::filesystem::path& path, const std::string& submesh,
                              bool centred, base::Problems& problems);

 private:
  ReadLimits limits_;
  TextureReader& textures_;
  std::map<std::tuple<std::filesystem::path, std::string, bool>, base::Result<MeshFile>> files_;
};

}  // namespace gsv::formats
