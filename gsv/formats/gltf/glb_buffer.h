// A GlbBuffer collects the binary part of a GLB file, and the JSON that describes it.
//
// Format  glTF 2.0 specification, sections 3.6 (buffers, accessors) and 4 (GLB).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include <nlohmann/json.hpp>

namespace gsv::formats {

using Json = nlohmann::ordered_json;

// The binary part of a GLB file.
class GlbBuffer {
 public:
  // Each of these functions returns the index by which other parts of the file refer to the added
  // data.
  int AddBytes(std::span<const std::uint8_t> bytes);  // adds a buffer view
  int AddPositions(std::span<const float> xyz);       // adds an accessor with min and max
  // Adds an accessor of vectors with this number of components.
  int AddVectors(std::span<const float> values, int components);
  // Adds an accessor of triangle indices.
  int AddIndices(std::span<const std::uint32_t> indices, std::size_t vertex_count);

  std::size_t size() const { return bytes_.size(); }

  // Adds the buffer, its views and the accessors to `document`, glTF's JSON. Returns the GLB file:
  // the JSON, then the binary part.
  std::vector<std::uint8_t> Finish(Json document) const;

 private:
  template <typename T>
  int AddView(std::span<const T> values, int target);
  // Adds an accessor to a buffer view.
  int AddAccessor(int view, int component_type, std::size_t count, const char* type);

  std::vector<std::uint8_t> bytes_;
  Json views_ = Json::array();      // glTF's bufferViews
  Json accessors_ = Json::array();  // glTF's accessors
};

}  // namespace gsv::formats
