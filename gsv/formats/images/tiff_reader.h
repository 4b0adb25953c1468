// Reads TIFF files: images, and heights (GeoTIFF, as digital elevation models are kept).
//
// Not read  heights in more than one band (the first counts), in complex numbers, or in projections
//           other than metres and degrees.
// Errors    a sentence for what is absent, damaged or larger than the limits.
// Threads   concurrently.
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

// A grid of heights, rows from the north, in the file's unit (metres for a DEM). Finite: what the
// file marks as unknown is as low as the lowest.
struct HeightGrid {
  int width = 0, height = 0;
  std::vector<double> heights;               // width * height
  std::optional<geometry::Vector2> spacing;  // metres from one to the next, where the file says so
};

bool IsTiff(const unsigned char* bytes, std::size_t size);

base::Result<std::shared_ptr<model::Image>> DecodeTiff(const unsigned char* bytes, std::size_t size,
                                                       const std::string& source,
                                                       const ReadLimits& limits);

base::Result<HeightGrid> ReadTiffHeights(const std::filesystem::path& path,
                                         const ReadLimits& limits);

}  // namespace gsv::formats
