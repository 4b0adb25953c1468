#include "gsv/rendering/scene/mesh_surfaces.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace gsv::rendering {
namespace {

constexpr std::size_t kFloats = 8;

// Disjoint sets that can be joined. Each set is identified by one of its members.
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), 0u);
  }
  std::uint32_t Find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(std::uint32_t a, std::uint32_t b) { parent_[Find(a)] = Find(b); }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace

std::vector<std::uint32_t> NumberSurfaces(const std::vector<float>& vertices,
                                          const std::vector<std::uint32_t>& indices) {
  const std::size_t count = vertices.size() / kFloats;
  Sets sets(count);
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
    sets.Join(indices[i], indices[i + 1]);
    sets.Join(indices[i], indices[i + 2]);
  }
  // Normals are compared with a tolerance of about a degree, because the normals of one flat face
  // may differ in their last bits.
  const auto key = [&](std::uint32_t i) {
    const float* v = &vertices[kFloats * i];
    const auto rounded = [&](int c) { return std::lround(64 * v[c]); };
    return std::tuple(v[0], v[1], v[2], rounded(3), rounded(4), rounded(5));
  };
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(),
            [&](std::uint32_t a, std::uint32_t b) { return key(a) < key(b); });
  for (std::size_t i = 1; i < count; ++i) {
    if (key(order[i - 1]) == key(order[i])) sets.Join(order[i - 1], order[i]);
  }
  std::vector<std::uint32_t> numbers(count), number_of(count, 0);
  std::uint32_t next = 1;
  for (std::uint32_t i = 0; i < count; ++i) {
    std::uint32_t& number = number_of[sets.Find(i)];
    if (number == 0) number = next++;
    numbers[i] = number;
  }
  return numbers;
}

}  // namespace gsv::rendering
