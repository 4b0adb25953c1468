// A MeshReader reads meshes (COLLADA, OBJ, STL, glTF) with their materials. It reads each file
// once for each submesh.
//
// Units    metres: COLLADA's <unit> is applied.
// Axes     the file's own axes. Like Gazebo and RViz, this ignores COLLADA's <up_axis>, because
//          models are made for these programs (TurtleBot3's arena declares Y_UP, but has z up).
//          glTF's y axis, which is up by definition, is not changed either.
// Repairs  triangles without area, and triangles that refer to missing vertices, are dropped.
// Errors   an error for a file that is missing, beyond the limits, unreadable or without triangles.
// Threads  one thread at a time.
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

// The content of a mesh file, or of one of its submeshes.
struct MeshFile {
  std::shared_ptr<const geometry::TriangleMesh> triangles;
  std::vector<model::Material> materials;  // materials of the mesh's parts, by index
};

// Reads mesh files, each once.
class MeshReader {
 public:
  MeshReader(const ReadLimits& limits, TextureReader& textures)
      : limits_(limits), textures_(textures) {}

  // Reads a mesh. `submesh` is the name or id of a node or geometry; empty: the whole mesh.
  // `centred`: moves the mesh so that the centre of its bounding box is at the origin. Adds
  // warnings for textures that cannot be read, and for parts of the mesh that were left out.
  base::Result<MeshFile> Read(const std::filesystem::path& path, const std::string& submesh,
                              bool centred, base::Problems& problems);

 private:
  ReadLimits limits_;
  TextureReader& textures_;
  // The results of Read(), by path, submesh and `centred`.
  std::map<std::tuple<std::filesystem::path, std::string, bool>, base::Result<MeshFile>> files_;
};

}  // namespace gsv::formats
