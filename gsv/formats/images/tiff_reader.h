// Reads TIFF files: images, and heights (GeoTIFF, the format of digital elevation models).
//
// Not read  heights in more than one band (the first is used), in complex numbers, or in
//           projections other than metres and degrees.
// Errors    an error for a file that is missing, damaged or larger than the limits.
// Threads   any; calls may run concurrently.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/formats/files/read_limits.h"
#include "gsv/geometry/vector3.h"
#include "gsv/model/image.h"

namespace gsv::formats {

// A grid of heights in the file's unit (metres for a digital elevation model), rows from the north.
// All heights are finite: samples that the file marks as unknown get the lowest height.
struct HeightGrid {
  int width = 0, height = 0;    // numbers of columns and rows
  std::vector<double> heights;  // width * height
  // Distance between samples in metres, if the file has it.
  std::optional<geometry::Vector2> spacing;
};

// Whether the bytes begin like a TIFF file.
bool IsTiff(const unsigned char* bytes, std::size_t size);

// Decodes a TIFF image.
base::Result<std::shared_ptr<model::Image>> DecodeTiff(const unsigned char* bytes, std::size_t size,
                                                       const std::string& source,
                                                       const ReadLimits& limits);

// Reads heights from a TIFF file.
base::Result<HeightGrid> ReadTiffHeights(const std::filesystem::path& path,
                                         const ReadLimits& limits);

}  // namespace gsv::formats
