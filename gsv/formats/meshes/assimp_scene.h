// Opens mesh files with assimp, with a few importers only, and reads no file outside of the mesh's
// own folder and its parent.
#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "gsv/base/error.h"
#include "gsv/formats/files/read_limits.h"

namespace gsv::formats {

// The content of a mesh file, as assimp has read it.
struct AssimpScene {
  std::unique_ptr<Assimp::Importer> importer;  // owns the scene
  const aiScene* scene = nullptr;              // triangles only, never null
  std::vector<std::string> changes;            // a sentence for each part that was left out
  // COLLADA: assimp's ids of nodes and geometries, by their names.
  std::multimap<std::string, std::string> ids_of;
};

// OpenScene() repairs or leaves out parts that make the file unreadable, see collada_repair.h. It
// reads the complete triangles of a truncated binary STL.
base::Result<AssimpScene> OpenScene(const std::filesystem::path& path, const ReadLimits& limits);

}  // namespace gsv::formats
