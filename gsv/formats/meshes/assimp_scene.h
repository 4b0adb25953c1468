// Opens mesh files with assimp: only the importers this program names, and no file beyond the
// mesh's own folder and its parent.
#pragma once

#include <filesystem>
#include <memory>

#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include "gsv/base/error.h"
#include "gsv/formats/files/read_limits.h"

namespace gsv::formats {

struct AssimpScene {
  std::unique_ptr<Assimp::Importer> importer;  // owns the scene
  const aiScene* scene = nullptr;              // triangles only, never null
};

base::Result<AssimpScene> OpenScene(const std::filesystem::path& path, const ReadLimits& limits);

}  // namespace gsv::formats
