// Opens mesh files with assimp: only the importers this program names, and no file beyond the
// mesh's own folder and its parent.
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

struct AssimpScene {
  std::unique_ptr<Assimp::Importer> importer;  // owns the scene
  const aiScene* scene = nullptr;              // triangles only, never null
  std::vector<std::string> changes;            // a sentence for each thing that was left out
  // COLLADA: the ids under which assimp knows nodes and geometries, by their names.
  std::multimap<std::string, std::string> ids_of;
};

// OpenScene repairs or leaves out what makes the file unreadable, where that is known to help: see
// collada_repair.h. It reads the complete triangles of a binary STL that ends early.
base::Result<AssimpScene> OpenScene(const std::filesystem::path& path, const ReadLimits& limits);

}  // namespace gsv::formats
