// Models as glTF 2.0 binary files (GLB), for viewers.
//
// Frames   each link is a child of the scene, at its pose in the model's frame at zero joint
//          positions; its children are its visuals. Coordinates stay as they are: metres, z up,
//          although glTF has y up; asset.extras says so ({"up_axis": "z"}).
// Names    scene.nodes[i] is links[i] and has its name. Loaders change names ("::" is dropped by
//          three.js), so the node's extras hold it as well: {"link": i, "name": "inner::link"}.
//          A visual's node has {"visual": name, "cast_shadows": bool}.
// Sharing  equal meshes, materials and textures are written once. Textures are the files they came
//          from where these are PNG or JPEG and no side is above 1024 pixels, else encoded anew,
//          scaled down to 1024.
// Equal models give equal bytes.
// Threads  any.
#pragma once

#include <cstdint>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// kBadModel when the file would be above 1 GiB.
[[nodiscard]] base::Result<std::vector<std::uint8_t>> WriteGlb(const model::Model& model);

}  // namespace gsv::formats
