// Makes terrain meshes from a grey image or an elevation model, for SDFormat's <heightmap>.
#pragma once

#include "gsv/base/error.h"
#include "gsv/formats/images/tiff_reader.h"
#include "gsv/geometry/triangle_mesh.h"
#include "gsv/model/image.h"

namespace gsv::formats {

// A grid over [-size.x/2, size.x/2] x [-size.y/2, size.y/2], white at height size.z and black at
// 0; the image's upper edge is at +y. A side has at most `max_vertices` (>= 2); larger images are
// sampled down.
geometry::TriangleMesh HeightmapMesh(const model::Image& image, const geometry::Vector3& size,
                                     int max_vertices);

// Makes a mesh of a height grid. Its lowest height is at 0 and its highest at size.z.
geometry::TriangleMesh HeightmapMesh(const HeightGrid& grid, const geometry::Vector3& size,
                                     int max_vertices);

// The size of a grid in metres, as its file gives it: width, depth, and the range of heights. If
// the file gives no distance between samples, it is 1 m.
geometry::Vector3 TrueSize(const HeightGrid& grid);

}  // namespace gsv::formats
