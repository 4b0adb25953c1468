// Terrain from a grey picture or an elevation model, as SDFormat's <heightmap> describes it.
#pragma once

#include "gsv/base/error.h"
#include "gsv/formats/images/tiff_reader.h"
#include "gsv/geometry/triangle_mesh.h"
#include "gsv/model/image.h"

namespace gsv::formats {

// A grid over [-size.x/2, size.x/2] x [-size.y/2, size.y/2], white at height size.z and black at
// 0; the picture's upper edge lies at +y. At most `most_vertices` (at least 2) a side: larger
// pictures are sampled down.
geometry::TriangleMesh HeightmapMesh(const model::Image& picture, const geometry::Vector3& size,
                                     int most_vertices);

// The same of a grid: its lowest height lies at 0 and its highest at size.z.
geometry::TriangleMesh HeightmapMesh(const HeightGrid& grid, const geometry::Vector3& size,
                                     int most_vertices);

// How large a grid is by what its file says: metres a side, and from the lowest to the highest.
// Where the file does not say how far the heights lie apart, 1 m.
geometry::Vector3 TrueSize(const HeightGrid& grid);

}  // namespace gsv::formats
