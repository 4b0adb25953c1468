// Limits on the contents of files. If a file exceeds a limit, its reader returns an error, or
// leaves out the part beyond the limit and adds a warning. docs/formats/worlds.md lists the limits.
#pragma once

#include <cstddef>
#include <string>

#include "gsv/base/error.h"

namespace gsv::formats {

// The limits on files. Sizes are in bytes, depths in levels.
struct ReadLimits {
  std::size_t xml_bytes = 64u << 20;  // maximum size of a world or model file
  int xml_depth = 64;                 // maximum number of nested elements
  int include_depth = 16;             // maximum length of a chain of files that include each other
  std::size_t models_in_world = 100'000;
  std::size_t mesh_bytes = 512u << 20;     // maximum size of a mesh file
  std::size_t mesh_triangles = 5'000'000;  // maximum number in one mesh
  std::size_t mesh_vertices = 10'000'000;  // maximum number in one mesh
  std::size_t texture_bytes = 256u << 20;  // maximum size of an image file
  int texture_side = 8192;                 // maximum width and height, pixels
  int heightmap_side = 513;                // vertices per side; larger images are sampled down
  bool operator==(const ReadLimits&) const = default;
};

// Sets the limit with the name of a member of ReadLimits: "mesh_triangles=20000000". Returns
// kInvalidArgument, with the names of all limits, for an unknown name or a number that is not
// positive.
[[nodiscard]] base::Status SetLimit(const std::string& text, ReadLimits& limits);

}  // namespace gsv::formats
