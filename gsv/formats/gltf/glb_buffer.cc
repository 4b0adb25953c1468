#include "gsv/formats/gltf/glb_buffer.h"

#include <algorithm>
#include <cstring>

namespace gsv::formats {
namespace {

constexpr int kFloat = 5126, kUnsignedShort = 5123, kUnsignedInt = 5125;
constexpr int kArrayBuffer = 34962, kElementArrayBuffer = 34963, kNoTarget = 0;

void Append(std::uint32_t value, std::vector<std::uint8_t>& out) {
  for (int shift = 0; shift < 32; shift += 8)
    out.push_back(static_cast<std::uint8_t>(value >> shift));
}

void Pad(std::vector<std::uint8_t>& out, std::uint8_t with) {
  while (out.size() % 4 != 0) out.push_back(with);
}

}  // namespace

template <typename T>
int GlbBuffer::AddView(std::span<const T> values, int target) {
  Pad(bytes_, 0);
  Json view{{"buffer", 0}, {"byteOffset", bytes_.size()}, {"byteLength", values.size_bytes()}};
  if (target != kNoTarget) view["target"] = target;
  const auto* begin = reinterpret_cast<const std::uint8_t*>(values.data());
  bytes_.insert(bytes_.end(), begin, begin + values.size_bytes());
  views_.push_back(std::move(view));
  return static_cast<int>(views_.size()) - 1;
}

int GlbBuffer::AddAccessor(int view, int component_type, std::size_t count, const char* type) {
  accessors_.push_back(
      {{"bufferView", view}, {"componentType", component_type}, {"count", count}, {"type", type}});
  return static_cast<int>(accessors_.size()) - 1;
}

int GlbBuffer::AddBytes(std::span<const std::uint8_t> bytes) { return AddView(bytes, kNoTarget); }

int GlbBuffer::AddPositions(std::span<const float> xyz) {
  const int accessor = AddVectors(xyz, 3);
  float min[3] = {xyz[0], xyz[1], xyz[2]}, max[3] = {xyz[0], xyz[1], xyz[2]};
  for (std::size_t i = 0; i < xyz.size(); ++i) {
    min[i % 3] = std::min(min[i % 3], xyz[i]);
    max[i % 3] = std::max(max[i % 3], xyz[i]);
  }
  accessors_[accessor]["min"] = {min[0], min[1], min[2]};
  accessors_[accessor]["max"] = {max[0], max[1], max[2]};
  return accessor;
}

int GlbBuffer::AddVectors(std::span<const float> values, int components) {
  return AddAccessor(AddView(values, kArrayBuffer), kFloat, values.size() / components,
                     components == 2 ? "VEC2" : "VEC3");
}

int GlbBuffer::AddIndices(std::span<const std::uint32_t> indices, std::size_t vertex_count) {
  // The 16-bit index 0xffff means primitive restart, so no vertex may have it.
  if (vertex_count <= 0xffff) {
    const std::vector<std::uint16_t> narrow(indices.begin(), indices.end());
    return AddAccessor(AddView(std::span<const std::uint16_t>(narrow), kElementArrayBuffer),
                       kUnsignedShort, indices.size(), "SCALAR");
  }
  return AddAccessor(AddView(indices, kElementArrayBuffer), kUnsignedInt, indices.size(), "SCALAR");
}

std::vector<std::uint8_t> GlbBuffer::Finish(Json document) const {
  std::vector<std::uint8_t> binary = bytes_;
  Pad(binary, 0);
  if (!binary.empty()) {
    document["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
    document["bufferViews"] = views_;
    if (!accessors_.empty()) document["accessors"] = accessors_;
  }
  // Names may have any bytes; invalid UTF-8 is replaced.
  const std::string text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
  std::vector<std::uint8_t> json(text.begin(), text.end());
  Pad(json, ' ');

  const std::size_t total = 12 + 8 + json.size() + (binary.empty() ? 0 : 8 + binary.size());
  std::vector<std::uint8_t> file;
  file.reserve(total);
  Append(0x46546c67, file);  // "glTF"
  Append(2, file);
  Append(static_cast<std::uint32_t>(total), file);
  Append(static_cast<std::uint32_t>(json.size()), file);
  Append(0x4e4f534a, file);  // "JSON"
  file.insert(file.end(), json.begin(), json.end());
  if (!binary.empty()) {
    Append(static_cast<std::uint32_t>(binary.size()), file);
    Append(0x004e4942, file);  // "BIN"
    file.insert(file.end(), binary.begin(), binary.end());
  }
  return file;
}

}  // namespace gsv::formats
