// Terrain from a grey picture, as SDFormat's <heightmap> describes it.
#pragma once

#include "gsv/base/error.h"
#include "gsv/geometry/triangle_mesh.h"
#include "gsv/model/image.h"

namespace gsv::formats {

// A grid over [-size.x/2, size.x/2] x [-size.y/2, size.y/2], white at height size.z and black at
// 0; the picture's upper edge lies at +y. At most `most_vertices` (at least 2) a side: larger
// pictures are sampled down.
geometry::TriangleMesh HeightmapMesh(const model::Image& picture, const geometry::Vector3& size,
                                     int most_vertices);

}  // namespace gsv::formats
