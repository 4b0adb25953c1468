// What assimp's glTF reader takes on trust.
#pragma once

#include <string>

#include "gsv/base/error.h"
#include "gsv/formats/files/read_limits.h"

namespace gsv::formats {

// Fails, with a sentence, for a .glb whose chunks reach beyond its end (assimp takes memory for
// what they claim, up to 8 GiB, before it looks), and for JSON, alone or in a .glb, that is
// malformed or nested so deeply that assimp's reader, which calls itself, would run out of stack,
// or whose buffers and accessors claim more than `limits` allow (assimp takes memory for them,
// too). Format: glTF 2.0, section 4.4 (GLB), 5.1 (accessor), 5.10 (buffer), 5.11 (bufferView).
base::Status CheckGltf(const std::string& bytes, bool is_binary, const ReadLimits& limits,
                       const std::string& file);

}  // namespace gsv::formats
