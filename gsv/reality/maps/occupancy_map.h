// Reads and writes occupancy maps of ROS's map_server: an image (PGM or PNG) and a YAML file.
//
// Frame   cell (0, 0) is the lower left cell of the map. The lower left corner of this cell is at
//         `origin`. Images have their rows from the top.
// Source  https://wiki.ros.org/map_server, "Map format".
// Input   untrusted: a side of at most 16384 cells, 64 million cells, 1 MiB of YAML.
// Errors  kNotFound and kBadModel; the message names the file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "gsv/base/error.h"

namespace gsv::reality {

enum class Cell : std::uint8_t { kFree, kOccupied, kUnknown };

// A grid of cells, each free, occupied or unknown.
struct OccupancyMap {
  int width = 0, height = 0;  // cells
  double resolution = 0.05;   // side of a cell, m
  // Pose of the lower left corner of the map in the world, m and rad.
  double origin_x = 0, origin_y = 0, origin_yaw = 0;
  std::vector<Cell> cells;  // width * height cells, rows from the bottom

  Cell at(int x, int y) const {
    return cells[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                 static_cast<std::size_t>(x)];
  }
};

// Reads a map. The YAML file has the image, resolution, origin, negate, thresholds and optionally
// the mode.
base::Result<OccupancyMap> ReadMap(const std::filesystem::path& yaml, base::Problems& problems);

// Reads a map in CMU's text format: "robot_specifications->resolution 10" (cm), "global_map[0]: 800
// 800", and for each cell the probability that it is free, or -1 if it is unknown.
base::Result<OccupancyMap> ReadBeesoftMap(const std::filesystem::path& path);

// Writes NAME.yaml and, in the same folder, NAME.pgm.
base::Status WriteMap(const OccupancyMap& map, const std::filesystem::path& yaml);

// A rectangle of occupied cells: the columns x to x + width - 1 and the rows y to y + height - 1.
struct CellBox {
  int x = 0, y = 0, width = 1, height = 1;
};
// Covers all occupied cells with rectangles that do not overlap. Each rectangle is a run of cells
// in a row, together with the rows above that have the same run.
std::vector<CellBox> BoxesOf(const OccupancyMap& map);

}  // namespace gsv::reality
