#include "gsv/formats/urdf/stl_writer.h"

#include <bit>
#include <cstdint>
#include <cstring>

namespace gsv::formats {
namespace {

static_assert(std::endian::native == std::endian::little, "STL is little-endian");

constexpr std::size_t kHeader = 80, kTriangle = 50;

template <typename Value>
void AppendValue(Value value, std::string& out) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}

void AppendVector(const geometry::Vector3& v, std::string& out) {
  for (const double value : {v.x, v.y, v.z}) AppendValue(static_cast<float>(value), out);
}

}  // namespace

std::string WriteStl(const geometry::TriangleMesh& mesh, std::size_t first, std::size_t count) {
  std::string stl = "binary STL, metres";  // a file that begins with "solid" is an ASCII STL
  stl.reserve(kHeader + 4 + count * kTriangle);
  stl.resize(kHeader, ' ');
  AppendValue(static_cast<std::uint32_t>(count), stl);
  for (std::size_t i = first; i < first + count; ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const geometry::Vector3 &p = mesh.positions[a], &q = mesh.positions[b], &r = mesh.positions[c];
    AppendVector(Normalized(Cross(q - p, r - p)), stl);
    for (const geometry::Vector3* vertex : {&p, &q, &r}) AppendVector(*vertex, stl);
    AppendValue(std::uint16_t{0}, stl);
  }
  return stl;
}

}  // namespace gsv::formats
