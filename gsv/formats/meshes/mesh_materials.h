// The materials of a mesh file.
#pragma once

#include <filesystem>
#include <vector>

#include "gsv/formats/images/texture_reader.h"
#include "gsv/model/material.h"

struct aiScene;

namespace gsv::formats {

// One for each material of the scene. Textures are looked for beside the mesh, in ../materials/
// textures and ../textures, as model folders are laid out.
std::vector<model::Material> ReadMeshMaterials(const aiScene& scene,
                                               const std::filesystem::path& mesh,
                                               TextureReader& textures, const ReadLimits& limits,
                                               base::Problems& problems);

}  // namespace gsv::formats
