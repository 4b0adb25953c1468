// Checks glTF files for errors that assimp's reader does not check.
#pragma once

#include <string>

#include "gsv/base/error.h"
#include "gsv/formats/files/read_limits.h"

namespace gsv::formats {

// Fails if a chunk of a .glb reaches beyond the file (assimp allocates its declared size, up to
// 8 GiB). Fails if the JSON is malformed, or if the JSON or its nodes are nested so deeply that
// assimp's recursive reader would run out of stack. Fails if a node contains itself. Fails if
// buffers or accessors declare more bytes or values than `limits` allows, or if there are more than
// 1,000,000 nodes (assimp allocates what is declared).
// Format: glTF 2.0, section 4.4 (GLB), 5.1 (accessor), 5.10 (buffer), 5.11 (bufferView).
base::Status CheckGltf(const std::string& bytes, bool is_binary, const ReadLimits& limits,
                       const std::string& file);

}  // namespace gsv::formats
