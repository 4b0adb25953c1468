#include "gsv/dynamics/shapes/connected_pieces.h"

#include <map>
#include <numeric>
#include <tuple>

namespace gsv::dynamics {
namespace {

using geometry::Vector3;

// Disjoint sets that can be merged (union-find).
class Sets {
 public:
  explicit Sets(std::size_t count) : parent_(count) {
    std::iota(parent_.begin(), parent_.end(), std::size_t{0});
  }
  std::size_t Find(std::size_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }
  void Join(std::size_t a, std::size_t b) { parent_[Find(b)] = Find(a); }

 private:
  std::vector<std::size_t> parent_;
};

struct Before {
  bool operator()(const Vector3& a, const Vector3& b) const {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  }
};

}  // namespace

std::vector<std::vector<Vector3>> ConnectedPieces(const geometry::Mesh& mesh, int max_pieces) {
  const auto& positions = mesh.triangles->positions;
  Sets sets(positions.size());
  std::map<Vector3, std::size_t, Before> at;  // corners at the same place count as one
  for (std::size_t i = 0; i < positions.size(); ++i) {
    sets.Join(at.emplace(positions[i], i).first->second, i);
  }
  for (const auto& triangle : mesh.triangles->triangles) {
    sets.Join(triangle[0], triangle[1]);
    sets.Join(triangle[0], triangle[2]);
  }
  std::map<std::size_t, std::size_t> piece_of;
  std::vector<std::vector<Vector3>> pieces;
  std::vector<Vector3> all;
  for (const auto& triangle : mesh.triangles->triangles) {
    const auto [it, is_new] = piece_of.emplace(sets.Find(triangle[0]), pieces.size());
    if (is_new) pieces.emplace_back();
    for (const std::uint32_t corner : triangle) {
      pieces[it->second].push_back(Scaled(positions[corner], mesh.scale));
      all.push_back(pieces[it->second].back());
    }
  }
  if (pieces.size() > static_cast<std::size_t>(max_pieces)) return {std::move(all)};
  return pieces;
}

}  // namespace gsv::dynamics
