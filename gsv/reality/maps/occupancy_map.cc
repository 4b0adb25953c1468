#include "gsv/reality/maps/occupancy_map.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "gsv/base/atomic_file.h"

namespace gsv::reality {

std::vector<CellBox> BoxesOf(const OccupancyMap& map) {
  std::vector<CellBox> boxes;
  // Indices of the boxes that end in the previous row, by (x, width). A row with an equal run of
  // cells extends its box.
  std::map<std::pair<int, int>, std::size_t> open;
  for (int y = 0; y < map.height; ++y) {
    std::map<std::pair<int, int>, std::size_t> here;
    for (int x = 0; x < map.width; ++x) {
      if (map.at(x, y) != Cell::kOccupied) continue;
      int end = x;
      while (end < map.width && map.at(end, y) == Cell::kOccupied) ++end;
      const std::pair<int, int> run{x, end - x};
      const auto below = open.find(run);
      if (below != open.end()) {
        ++boxes[below->second].height;
        here.emplace(run, below->second);
      } else {
        here.emplace(run, boxes.size());
        boxes.push_back({x, y, end - x, 1});
      }
      x = end;
    }
    open = std::move(here);
  }
  return boxes;
}

base::Status WriteMap(const OccupancyMap& map, const std::filesystem::path& yaml) {
  std::filesystem::path image = yaml;
  image.replace_extension(".pgm");
  std::string pgm = fmt::format("P5\n{} {}\n255\n", map.width, map.height);
  pgm.reserve(pgm.size() + map.cells.size());
  for (int y = map.height - 1; y >= 0; --y) {
    for (int x = 0; x < map.width; ++x) {
      const Cell cell = map.at(x, y);
      pgm.push_back(cell == Cell::kOccupied ? '\0'
                                            : static_cast<char>(cell == Cell::kFree ? 254 : 205));
    }
  }
  if (auto ok = base::WriteAtomically(image, pgm, base::Durability::kProcess); !ok) return ok;
  return base::WriteAtomically(
      yaml,
      fmt::format("image: {}\nresolution: {}\norigin: [{}, {}, {}]\nnegate: 0\n"
                  "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
                  image.filename().string(), map.resolution, map.origin_x, map.origin_y,
                  map.origin_yaw),
      base::Durability::kProcess);
}

}  // namespace gsv::reality
