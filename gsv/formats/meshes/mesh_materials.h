// Reads the materials of a mesh file.
#pragma once

#include <filesystem>
#include <vector>

#include "gsv/formats/images/texture_reader.h"
#include "gsv/model/material.h"

struct aiScene;

namespace gsv::formats {

// Returns a material for each material of the scene. Textures are searched beside the mesh, and
// in ../materials/textures, ../textures and ../../materials/textures, the usual folders of models.
std::vector<model::Material> ReadMeshMaterials(const aiScene& scene,
                                               const std::filesystem::path& mesh,
                                               TextureReader& textures, const ReadLimits& limits,
                                               base::Problems& problems);

}  // namespace gsv::formats
