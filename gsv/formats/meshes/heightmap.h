// Makes terrain meshes from a grey image or an elevation model, for SDFormat's <heightmap>.
#pragma once

#include "gsv/base/error.h"
#include "gsv/formats/images/tiff_reader.h"
#include "gsv/geometry/triangle_mesh.h"
#include "gsv/model/image.h"

namespace gsv::formats {

// Makes a mesh of a grey image, over [-size.x/2, size.x/2] x [-size.y/2, size.y/2] (metres). White
// is at height size.z, black at 0. The image's upper edge is at +y. A side has at most
// `max_vertices` (>= 2) vertices: larger images are sampled down.
geometry::TriangleMesh HeightmapMesh(const model::Image& image, const geometry::Vector3& size,
                                     int max_vertices);

// Makes a mesh of a height grid. Its lowest height is at 0 and its highest at size.z.
geometry::TriangleMesh HeightmapMesh(const HeightGrid& grid, const geometry::Vector3& size,
                                     int max_vertices);

// Returns the size of a grid in metres, as its file gives it: width, depth, and the range of
// heights. The distance between samples is 1 m if the file does not give it.
geometry::Vector3 TrueSize(const HeightGrid& grid);

}  // namespace gsv::formats
