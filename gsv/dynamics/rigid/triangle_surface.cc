#include "gsv/dynamics/rigid/triangle_surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>
#include <tuple>
#include <unordered_set>

#include "gsv/dynamics/rigid/mesh_points.h"

namespace gsv::dynamics {
namespace {

using geometry::Vector3;

// Two triangles are in one plane if the sine of the angle between them is below this.
constexpr double kOnePlane = 1e-4;
// Tolerance, as a cosine, for a direction outside of the Voronoi region of an edge or vertex.
constexpr double kBeyond = 1e-4;

std::size_t ToIndex(int i) { return static_cast<std::size_t>(i); }
std::size_t After(std::size_t corner) { return corner == 2 ? 0 : corner + 1; }

auto Tied(const Vector3& v) { return std::tie(v.x, v.y, v.z); }

// Numbers the positions. Equal positions have the same number: the index of the first of them.
std::vector<int> Weld(const std::vector<Vector3>& positions) {
  std::vector<int> order, numbers(positions.size());
  std::iota(numbers.begin(), numbers.end(), 0);
  for (const int i : numbers) {
    if (geometry::IsFinite(positions[ToIndex(i)])) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), [&](int a, int b) {
    return std::tuple_cat(Tied(positions[ToIndex(a)]), std::tuple(a)) <
           std::tuple_cat(Tied(positions[ToIndex(b)]), std::tuple(b));
  });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto at = ToIndex(order[i]);
    const bool is_same = i > 0 && Tied(positions[at]) == Tied(positions[ToIndex(order[i - 1])]);
    numbers[at] = is_same ? numbers[ToIndex(order[i - 1])] : order[i];
  }
  return numbers;
}

}  // namespace

TriangleSurface::TriangleSurface(const geometry::TriangleMesh& mesh, const Vector3& scale) {
  vertices_.reserve(mesh.positions.size());
  for (const Vector3& position : mesh.positions) vertices_.push_back(Scaled(position, scale));
  const std::vector<int> numbers = Weld(vertices_);
  // Skips a triangle whose vertices were used before: meshes made for rendering often have a second
  // triangle for the back of each.
  std::set<std::array<int, 3>> known;
  for (const auto& [a, b, c] : mesh.triangles) {
    std::array<int, 3> vertices{numbers[a], numbers[b], numbers[c]};
    std::array<int, 3> sorted = vertices;
    std::sort(sorted.begin(), sorted.end());
    if (known.insert(sorted).second) AddTriangle(vertices);
  }
  JoinNeighbours();
  ListVerticesBeside();
  std::vector<BoxBvh::Box> boxes;
  boxes.reserve(triangles_.size());
  for (const Triangle& triangle : triangles_) {
    const Vector3 &a = CornerOf(triangle, 0), &b = CornerOf(triangle, 1);
    const Vector3& c = CornerOf(triangle, 2);
    boxes.push_back(
        {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
         {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}});
  }
  bvh_.Build(boxes);
}

void TriangleSurface::AddTriangle(const std::array<int, 3>& vertices) {
  // fraction of the square of the longest edge; a triangle with less area counts as a line
  constexpr double kThinnest = 1e-9;
  Triangle triangle;
  triangle.vertices = vertices;
  std::array<Vector3, 3> along;
  double longest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    along[i] = CornerOf(triangle, After(i)) - CornerOf(triangle, i);
    longest = std::max(longest, Dot(along[i], along[i]));
  }
  const Vector3 twice_area = Cross(along[0], along[1]);
  const double size = Norm(twice_area);
  if (!(size > kThinnest * longest)) return;
  triangle.normal = (1 / size) * twice_area;
  for (std::size_t i = 0; i < 3; ++i) {
    triangle.beside[i] = -1;
    triangle.inwards[i] = Normalized(Cross(triangle.normal, along[i]));
  }
  triangles_.push_back(triangle);
}

void TriangleSurface::JoinNeighbours() {
  struct Side {
    int low, high;  // indices of the vertices
    int edge;       // 3 * triangle + edge
  };
  std::vector<Side> sides;
  sides.reserve(3 * triangles_.size());
  for (const Triangle& triangle : triangles_) {
    for (std::size_t i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(triangle.vertices[i], triangle.vertices[After(i)]);
      sides.push_back({low, high, static_cast<int>(sides.size())});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.edge) < std::tie(b.low, b.high, b.edge);
  });
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].low == sides[begin].low &&
           sides[end].high == sides[begin].high) {
      ++end;
    }
    if (end - begin != 2) continue;
    const int own = sides[begin].edge, other = sides[begin + 1].edge;
    Triangle &first = triangles_[ToIndex(own / 3)], &second = triangles_[ToIndex(other / 3)];
    const auto i = ToIndex(own % 3), j = ToIndex(other % 3);
    const bool is_flat = Dot(first.inwards[i], second.inwards[j]) < 0 &&
                         std::abs(Dot(first.normal, second.inwards[j])) < kOnePlane;
    first.beside[i] = other;
    second.beside[j] = own;
    first.edges[i] = is_flat ? Edge::kFlat : Edge::kOwn;
    second.edges[j] = is_flat ? Edge::kFlat : Edge::kOther;
  }
}

void TriangleSurface::ListVerticesBeside() {
  std::vector<std::pair<int, int>> pairs;
  pairs.reserve(6 * triangles_.size());
  for (const Triangle& triangle : triangles_) {
    for (std::size_t i = 0; i < 3; ++i) {
      const int a = triangle.vertices[i], b = triangle.vertices[After(i)];
      pairs.emplace_back(a, b);
      pairs.emplace_back(b, a);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  first_beside_.assign(vertices_.size() + 1, 0);
  for (const auto& [from, to] : pairs) {
    ++first_beside_[ToIndex(from) + 1];
    beside_.push_back(to);
  }
  std::partial_sum(first_beside_.begin(), first_beside_.end(), first_beside_.begin());
}

bool TriangleSurface::MayTouchEdge(const Triangle& triangle, std::size_t edge,
                                   const Vector3& normal) const {
  if (Dot(normal, triangle.inwards[edge]) > kBeyond) return false;
  const int beside = triangle.beside[edge];
  return beside < 0 ||
         Dot(normal, triangles_[ToIndex(beside / 3)].inwards[ToIndex(beside % 3)]) <= kBeyond;
}

bool TriangleSurface::MayTouchVertex(int vertex, const Vector3& normal) const {
  const Vector3& at = vertices_[ToIndex(vertex)];
  for (int i = first_beside_[ToIndex(vertex)]; i < first_beside_[ToIndex(vertex) + 1]; ++i) {
    const Vector3 along = vertices_[ToIndex(beside_[ToIndex(i)])] - at;
    if (Dot(normal, along) > kBeyond * Norm(along)) return false;
  }
  return true;
}

class TriangleSurface::SphereContacts {
 public:
  SphereContacts(const TriangleSurface& surface, const PlacedPiece& sphere, MeshPoints& list)
      : surface_(surface), middle_(sphere.position), radius_(sphere.piece->half.x), list_(list) {}

  void Add(const Triangle& triangle) {
    const Vector3 from = middle_ - surface_.CornerOf(triangle, 0);
    const double height = Dot(triangle.normal, from);
    if (!(std::abs(height) - radius_ < list_.margin())) return;
    const Vector3 below = middle_ - height * triangle.normal;
    int beyond = 0;
    for (std::size_t i = 0; i < 3; ++i) {
      if (Dot(triangle.inwards[i], below - surface_.CornerOf(triangle, i)) >= 0) continue;
      ++beyond;
      AddEdge(triangle, i);
    }
    if (beyond > 0) return;
    const Vector3 normal = height < 0 ? -triangle.normal : triangle.normal;
    list_.Add(below, normal, std::abs(height) - radius_);
  }

 private:
  void AddEdge(const Triangle& triangle, std::size_t i) {
    const Vector3& a = surface_.CornerOf(triangle, i);
    const Vector3 along = surface_.CornerOf(triangle, After(i)) - a;
    const double at = Dot(middle_ - a, along), square = Dot(along, along);
    const bool is_vertex = at <= 0 || at >= square;
    const std::size_t corner = at <= 0 ? i : After(i);
    const Vector3 nearest =
        is_vertex ? surface_.CornerOf(triangle, corner) : a + (at / square) * along;
    const Vector3 between = middle_ - nearest;
    const double length = Norm(between);
    if (!(length > 0) || !(length - radius_ < list_.margin())) return;
    const Vector3 normal = (1 / length) * between;
    if (is_vertex && !answered_.insert(triangle.vertices[corner]).second) return;
    const bool may_touch = is_vertex ? surface_.MayTouchVertex(triangle.vertices[corner], normal)
                                     : surface_.MayTouchEdge(triangle, i, normal);
    if (may_touch) list_.Add(nearest, normal, length - radius_);
  }

  const TriangleSurface& surface_;
  const Vector3 middle_;
  const double radius_;
  MeshPoints& list_;
  // Vertices that were already checked; thousands of triangles may share one.
  std::unordered_set<int> answered_;
};

// Works in the frame of the cylinder, whose axis is z.
class TriangleSurface::CylinderContacts {
 public:
  CylinderContacts(const TriangleSurface& surface, const PlacedPiece& cylinder, MeshPoints& list)
      : surface_(surface),
        cylinder_(cylinder),
        radius_(cylinder.piece->half.x),
        half_(cylinder.piece->half.z),
        list_(list) {}

  void Add(const Triangle& triangle) {
    Vector3 normal = triangle.normal;
    double height = Dot(normal, cylinder_.position - surface_.CornerOf(triangle, 0));
    if (height < 0) {
      normal = -normal;
      height = -height;
    }
    const double up = Dot(normal, cylinder_.rotation.z);
    const double face =
        height - radius_ * std::sqrt(std::max(0.0, 1 - up * up)) - half_ * std::abs(up);
    if (!(face < list_.margin())) return;
    for (std::size_t i = 0; i < 3; ++i) {
      corners_[i] =
          TransposeTimes(cylinder_.rotation, surface_.CornerOf(triangle, i) - cylinder_.position);
    }
    const auto [low, high] = std::minmax({corners_[0].z, corners_[1].z, corners_[2].z});
    const double axial = std::max(low - half_, -high - half_);
    if (!(axial < list_.margin())) return;
    const double radial = RadialDistance() - radius_;
    if (!(radial < list_.margin())) return;
    // The cylinder and the triangle touch along the direction in which they are farthest apart or
    // overlap the least. Contacts along other directions are dropped.
    constexpr double kBetter = 0.05, kLeast = 1e-6;
    const double best = std::max({face, axial, radial});
    floor_ = best - kBetter * std::abs(best) - kLeast;
    AddFace(triangle, normal, height);
    for (std::size_t i = 0; i < 3; ++i) {
      AddVertex(triangle, i);
      if (triangle.edges[i] == Edge::kOpen || triangle.edges[i] == Edge::kOwn) {
        AddEdge(triangle, i);
      }
    }
  }

  // If two neighbouring triangles are in one plane up to a small angle, their contacts are this
  // close to each other.
  static double SameDistance(double radius) { return 2 * kOnePlane * radius; }

 private:
  // Returns the distance from the axis to the triangle, seen along the axis. If it is negative, the
  // triangle must move by that distance for the axis to be outside.
  double RadialDistance() const {
    const double area = Cross2(corners_[1] - corners_[0], corners_[2] - corners_[0]);
    const double sign = area < 0 ? -1 : 1;
    double inside = 1e300, outside = 1e300;
    bool is_inside = true;
    for (std::size_t i = 0; i < 3; ++i) {
      const Vector3 &a = corners_[i], along = corners_[After(i)] - a;
      const double square = along.x * along.x + along.y * along.y;
      const double at =
          square > 0 ? std::clamp(-(a.x * along.x + a.y * along.y) / square, 0.0, 1.0) : 0;
      const double x = a.x + at * along.x, y = a.y + at * along.y;
      outside = std::min(outside, x * x + y * y);
      const double left = sign * Cross2(along, -a);
      if (left < 0) is_inside = false;
      if (square > 0) inside = std::min(inside, left / std::sqrt(square));
    }
    return is_inside && area != 0 ? -inside : std::sqrt(outside);
  }

  static double Cross2(const Vector3& a, const Vector3& b) { return a.x * b.y - a.y * b.x; }

  bool IsContact(double distance) const { return distance < list_.margin() && distance >= floor_; }
  // Here and in MayTouch(), `on_mesh` and `normal` are in the frame of the cylinder.
  void Add(const Vector3& on_mesh, const Vector3& normal, double distance) {
    list_.Add(cylinder_.position + cylinder_.rotation * on_mesh, cylinder_.rotation * normal,
              distance);
  }
  bool MayTouch(const Triangle& triangle, std::size_t edge, const Vector3& normal) const {
    return surface_.MayTouchEdge(triangle, edge, cylinder_.rotation * normal);
  }

  void AddFace(const Triangle& triangle, const Vector3& normal, double height) {
    std::array<Vector3, 4> lowest;
    const int count = LowestOfCylinder(cylinder_, normal, lowest);
    for (std::size_t k = 0; k < ToIndex(count); ++k) {
      const double distance = height + Dot(normal, lowest[k]);
      if (!IsContact(distance)) continue;
      const Vector3 below = cylinder_.position + lowest[k] - distance * normal;
      bool is_above = true;
      for (std::size_t i = 0; is_above && i < 3; ++i) {
        const double beyond = triangle.edges[i] == Edge::kFlat ? SameDistance(radius_) : 0;
        is_above = Dot(triangle.inwards[i], below - surface_.CornerOf(triangle, i)) >= -beyond;
      }
      if (is_above) list_.Add(below, normal, distance);
    }
  }

  void AddVertex(const Triangle& triangle, std::size_t corner) {
    // A vertex between two flat edges is inside of a plane, where only the faces have contacts.
    if (triangle.edges[corner] == Edge::kFlat && triangle.edges[(corner + 2) % 3] == Edge::kFlat) {
      return;
    }
    const Vector3& v = corners_[corner];
    const double from_axis = std::sqrt(v.x * v.x + v.y * v.y);
    if (!(from_axis > 0)) return;
    const double out = from_axis - radius_, beyond = std::abs(v.z) - half_;
    const Vector3 inwards{-v.x / from_axis, -v.y / from_axis, 0};
    const Vector3 down{0, 0, v.z > 0 ? -1.0 : 1.0};
    Vector3 normal;
    double distance = 0;
    if (out > 0 && beyond > 0) {
      distance = std::sqrt(out * out + beyond * beyond);
      normal = (1 / distance) * (out * inwards + beyond * down);
    } else {
      distance = std::max(out, beyond);
      normal = out > beyond ? inwards : down;
    }
    if (IsContact(distance) && answered_.insert(triangle.vertices[corner]).second &&
        surface_.MayTouchVertex(triangle.vertices[corner], cylinder_.rotation * normal)) {
      Add(v, normal, distance);
    }
  }

  void AddEdge(const Triangle& triangle, std::size_t edge) {
    constexpr double kAlong = 0.7;  // component along the axis
    const Vector3 &a = corners_[edge], along = corners_[After(edge)] - a;
    const double square = along.x * along.x + along.y * along.y;
    const double length_square = square + along.z * along.z;
    if (square > 1e-12 * length_square) {
      const double nearest = -(a.x * along.x + a.y * along.y) / square;
      const Vector3 at = a + nearest * along;
      if (nearest > 0 && nearest < 1 && std::abs(at.z) <= half_) AddSide(triangle, edge, at);
    }
    if (along.z * along.z >= kAlong * kAlong * length_square) {
      for (const double end : {-half_, half_}) {
        const double at = (end - a.z) / along.z;
        if (at >= 0 && at <= 1) AddRim(triangle, edge, a + at * along, end);
      }
      return;
    }
    // Seen along the axis, a rim is a circle. Finds the points at which the edge crosses it.
    const double middle = -(a.x * along.x + a.y * along.y) / square;
    const double x = a.x + middle * along.x, y = a.y + middle * along.y;
    const double room = radius_ * radius_ - x * x - y * y;
    if (!(room > 0)) return;
    const double reach = std::sqrt(room / square);
    for (const double at : {middle - reach, middle + reach}) {
      if (at < 0 || at > 1) continue;
      const Vector3 point = a + at * along;
      AddRim(triangle, edge, point, point.z < 0 ? -half_ : half_);
    }
  }

  // Adds the contact of the cylinder's side with `at`, the point of the edge that is nearest to the
  // axis.
  void AddSide(const Triangle& triangle, std::size_t edge, const Vector3& at) {
    const double from_axis = std::sqrt(at.x * at.x + at.y * at.y);
    if (!(from_axis > 0) || !IsContact(from_axis - radius_)) return;
    const Vector3 normal{-at.x / from_axis, -at.y / from_axis, 0};
    if (MayTouch(triangle, edge, normal)) Add(at, normal, from_axis - radius_);
  }

  // Adds the contact of the rim at height `end` with the edge, near the point `at`. The normal is
  // at right angles to the rim and the edge.
  void AddRim(const Triangle& triangle, std::size_t edge, const Vector3& at, double end) {
    // Drops a contact whose normal points out of the cylinder by more than this component.
    constexpr double kAway = 0.1;
    const double from_axis = std::sqrt(at.x * at.x + at.y * at.y);
    if (!(from_axis > 0)) return;
    const Vector3 out{at.x / from_axis, at.y / from_axis, 0};
    Vector3 normal = Cross(corners_[After(edge)] - corners_[edge], Vector3{-out.y, out.x, 0});
    const double length = Norm(normal);
    if (!(length > 0)) return;
    normal = (Dot(normal, at) > 0 ? -1 / length : 1 / length) * normal;
    if (Dot(normal, out) > kAway || (end < 0 ? -normal.z : normal.z) > kAway) return;
    const double distance = Dot(normal, radius_ * out + Vector3{0, 0, end} - at);
    if (IsContact(distance) && MayTouch(triangle, edge, normal)) Add(at, normal, distance);
  }

  const TriangleSurface& surface_;
  const PlacedPiece& cylinder_;
  const double radius_, half_;
  MeshPoints& list_;
  std::unordered_set<int> answered_;  // vertices that were already checked
  std::array<Vector3, 3> corners_;
  double floor_ = 0;
};

bool TriangleSurface::AddPoints(const PlacedPiece& piece, const PlacedPiece& mesh, double margin,
                                std::vector<TouchPoint>& points) const {
  const Matrix3 to_mesh{{mesh.rotation.x.x, mesh.rotation.y.x, mesh.rotation.z.x},
                        {mesh.rotation.x.y, mesh.rotation.y.y, mesh.rotation.z.y},
                        {mesh.rotation.x.z, mesh.rotation.y.z, mesh.rotation.z.z}};
  PlacedPiece local;
  local.piece = piece.piece;
  local.position = to_mesh * (piece.position - mesh.position);
  local.rotation = to_mesh * piece.rotation;
  SetBoundsOf(local);
  const Vector3 wide{margin, margin, margin};
  const Vector3 low = local.low - wide, high = local.high + wide;
  switch (piece.piece->kind) {
    case Piece::Kind::kSphere: {
      MeshPoints list(margin, 1e-9, local.piece->half.x, points);
      SphereContacts contacts(*this, local, list);
      bvh_.ForEachNear(low, high, [&](int i) { contacts.Add(triangles_[ToIndex(i)]); });
      list.Finish(mesh);
      return true;
    }
    case Piece::Kind::kCylinder: {
      const double radius = piece.piece->half.x;
      MeshPoints list(margin, CylinderContacts::SameDistance(radius), radius, points);
      CylinderContacts contacts(*this, local, list);
      bvh_.ForEachNear(low, high, [&](int i) { contacts.Add(triangles_[ToIndex(i)]); });
      list.Finish(mesh);
      return true;
    }
    default: {
      bool is_near = false;
      bvh_.ForEachNear(low, high, [&](int) { is_near = true; });
      return !is_near;
    }
  }
}

}  // namespace gsv::dynamics
