// Reads meshes (COLLADA, OBJ, STL, glTF) with their materials; each file is read once.
//
// Units    metres: COLLADA's <unit> is applied.
// Axes     the file's own. Like Gazebo and RViz, this ignores COLLADA's <up_axis>, because models
//          are made for those (TurtleBot3's arena declares Y_UP, but has z up). The y axis of glTF
//          is up by definition, and is kept as well.
// Repairs  triangles without area, and those that name vertices that do not exist, are dropped.
// Errors   a sentence for a file that is missing, beyond the limits, unreadable or without
//          triangles.
// Threads  one at a time.
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
  std::vector<model::Material> materials;  // materials of the mesh's parts, by index
};

class MeshReader {
 public:
  MeshReader(const ReadLimits& limits, TextureReader& textures)
      : limits_(limits), textures_(textures) {}

  // `submesh` empty: the whole mesh; `centred`: moved so that the centre of its bounding box is at
  // the origin. A submesh is named by the name or id of its node or geometry. Textures that cannot
  // be read, and parts of the mesh that were left out, give warnings.
  base::Result<MeshFile> Read(const std::filesystem::path& path, const std::string& submesh,
                              bool centred, base::Problems& problems);

 private:
  ReadLimits limits_;
  TextureReader& textures_;
  std::map<std::tuple<std::filesystem::path, std::string, bool>, base::Result<MeshFile>> files_;
};

}  // namespace gsv::formats
