// Writes models as glTF 2.0 binary files (GLB), for viewers.
//
// Frames   each link is a child of the scene, at its pose in the model's frame at zero joint
//          positions; its children are its visuals. Coordinates stay as they are: metres, z up,
//          although glTF has y up; asset.extras contains {"up_axis": "z"}.
// Names    scene.nodes[i] is links[i] and has its name. Loaders change names ("::" is dropped by
//          three.js), so the node's extras contain the name as well:
//          {"link": i, "name": "inner::link"}.
//          A visual's node has {"visual": name, "cast_shadows": bool}.
// Sharing  equal meshes, materials and textures are written once. A texture is written as its
//          original file if this file is a PNG or JPEG with no side above 1024 pixels. Otherwise
//          the texture is encoded again and scaled down to 1024 pixels.
// Equal models give equal bytes.
// Threads  any.
#pragma once

#include <cstdint>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// Fails with kBadModel if the file would exceed 1 GiB.
[[nodiscard]] base::Result<std::vector<std::uint8_t>> WriteGlb(const model::Model& model);

}  // namespace gsv::formats
