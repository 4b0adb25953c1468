// Reads the GLB files of WriteGlb() (gltf_writer.h), to render models without their original files.
//
// Result   a model with links, visuals and materials only: no joints, collisions or sensors. A flat
//          rectangle without a texture is a geometry::Plane again, so that it is rendered as
//          ground.
// Input    untrusted. Returns kCorrupt if the file was not written by WriteGlb(). Textures that
//          cannot be decoded are left out.
// Threads  any.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "gsv/base/error.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// Reads a GLB file. `name` is the file's name for messages.
[[nodiscard]] base::Result<model::Model> ReadGlb(std::span<const std::uint8_t> bytes,
                                                 const std::string& name);

}  // namespace gsv::formats
