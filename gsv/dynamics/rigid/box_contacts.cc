// Finds the contacts of two boxes by their separating axes (Gottschalk, Lin, Manocha, "OBBTree",
// SIGGRAPH 1996) and by clipping one face by the other.
#include <algorithm>
#include <array>
#include <cmath>

#include "gsv/dynamics/rigid/placed_piece.h"

namespace gsv::dynamics {
namespace {

using geometry::Vector3;

struct BoxAt {
  explicit BoxAt(const PlacedPiece& placed)
      : position(placed.position),
        axes{placed.rotation.x, placed.rotation.y, placed.rotation.z},
        half{placed.piece->half.x, placed.piece->half.y, placed.piece->half.z} {}
  Vector3 position;
  std::array<Vector3, 3> axes;
  std::array<double, 3> half;
};

struct Corner {
  double x, y, depth;  // position on the reference face, and depth beyond it along its normal
};

// At most eight corners: each of the four edges of the face cuts off one corner and adds two.
struct Polygon {
  std::array<Corner, 8> corners;
  int count = 0;
  void Add(const Corner& corner) {
    if (count < 8) corners[static_cast<std::size_t>(count++)] = corner;
  }
};

// Returns the part of the polygon with sign * coordinate <= half.
template <double Corner::*Coordinate>
Polygon Clip(const Polygon& polygon, double sign, double half) {
  Polygon clipped;
  for (int i = 0; i < polygon.count; ++i) {
    const Corner& a = polygon.corners[static_cast<std::size_t>(i)];
    const Corner& b = polygon.corners[static_cast<std::size_t>((i + 1) % polygon.count)];
    const double room_a = half - sign * a.*Coordinate, room_b = half - sign * b.*Coordinate;
    if (room_a >= 0) clipped.Add(a);
    if ((room_a < 0) == (room_b < 0)) continue;
    const double share = room_a / (room_a - room_b);
    clipped.Add({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
                 a.depth + share * (b.depth - a.depth)});
  }
  return clipped;
}

// Returns the four corners that span the largest area. Two of them are the deepest corner and the
// corner farthest from it. The other two are the corners farthest from the line between the first
// two, one on each side. If the depths of several corners differ by less than a millimetre per
// metre of their distance, their positions decide. So the same corners are chosen from step to
// step, and the solver can start at each corner with the impulse of the previous step.
Polygon ChooseFour(const Polygon& all) {
  constexpr double kSteady = 1e-3, kGolden = 0.618;
  if (all.count <= 4) return all;
  const auto begin = all.corners.begin(), end = begin + all.count;
  const auto order = [](const Corner& p) { return p.depth + kSteady * (p.x + kGolden * p.y); };
  const Corner& a =
      *std::min_element(begin, end, [&](auto& p, auto& q) { return order(p) < order(q); });
  const auto distance = [&](const Corner& p) {
    return (p.x - a.x) * (p.x - a.x) + (p.y - a.y) * (p.y - a.y);
  };
  const Corner& b =
      *std::max_element(begin, end, [&](auto& p, auto& q) { return distance(p) < distance(q); });
  const auto side = [&](const Corner& p) {
    return (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
  };
  const auto [low, high] =
      std::minmax_element(begin, end, [&](auto& p, auto& q) { return side(p) < side(q); });
  Polygon chosen;
  chosen.Add(a);
  chosen.Add(b);
  if (side(*low) < 0) chosen.Add(*low);
  if (side(*high) > 0) chosen.Add(*high);
  return chosen;
}

// Adds the contacts of the face of `reference` whose outward normal is along axis `axis`, with the
// face of `other` that faces it most directly. `is_first` means that the reference is the first box
// of the pair.
void AddFacePoints(const BoxAt& reference, int axis, double sign, const BoxAt& other, bool is_first,
                   double margin, std::vector<TouchPoint>& points) {
  const auto at = [](const auto& values, int i) { return values[static_cast<std::size_t>(i)]; };
  const Vector3 normal = sign * at(reference.axes, axis);
  const Vector3 x = at(reference.axes, (axis + 1) % 3), y = at(reference.axes, (axis + 2) % 3);
  const double half_x = at(reference.half, (axis + 1) % 3);
  const double half_y = at(reference.half, (axis + 2) % 3);
  const Vector3 face = reference.position + at(reference.half, axis) * normal;
  int facing = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(Dot(at(other.axes, i), normal)) > std::abs(Dot(at(other.axes, facing), normal))) {
      facing = i;
    }
  }
  const double side = Dot(at(other.axes, facing), normal) > 0 ? -1 : 1;
  const Vector3 middle =
      other.position + side * at(other.half, facing) * at(other.axes, facing) - face;
  const Vector3 u = at(other.half, (facing + 1) % 3) * at(other.axes, (facing + 1) % 3);
  const Vector3 v = at(other.half, (facing + 2) % 3) * at(other.axes, (facing + 2) % 3);
  Polygon polygon;
  for (const Vector3& corner : {middle + u + v, middle - u + v, middle - u - v, middle + u - v}) {
    polygon.Add({Dot(corner, x), Dot(corner, y), Dot(corner, normal)});
  }
  polygon = Clip<&Corner::x>(polygon, 1, half_x);
  polygon = Clip<&Corner::x>(polygon, -1, half_x);
  polygon = Clip<&Corner::y>(polygon, 1, half_y);
  polygon = Clip<&Corner::y>(polygon, -1, half_y);
  Polygon near;
  for (int i = 0; i < polygon.count; ++i) {
    if (at(polygon.corners, i).depth < margin) near.Add(at(polygon.corners, i));
  }
  near = ChooseFour(near);
  for (int i = 0; i < near.count; ++i) {
    const Corner corner = at(near.corners, i);
    const Vector3 on_face = face + corner.x * x + corner.y * y;
    if (is_first) {
      points.push_back({on_face + corner.depth * normal, -normal, corner.depth});
    } else {
      points.push_back({on_face, normal, corner.depth});
    }
  }
}

// Adds the point at which an edge of one box crosses an edge of the other. `normal` points away
// from the first box.
void AddEdgePoint(const BoxAt& first, int first_edge, const BoxAt& second, int second_edge,
                  const Vector3& normal, std::vector<TouchPoint>& points) {
  const auto middle_of = [](const BoxAt& box, int edge, const Vector3& towards) {
    Vector3 middle = box.position;
    for (int i = 0; i < 3; ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (i != edge) middle += (Dot(box.axes[k], towards) > 0 ? 1 : -1) * box.half[k] * box.axes[k];
    }
    return middle;
  };
  const Vector3& a = first.axes[static_cast<std::size_t>(first_edge)];
  const Vector3& b = second.axes[static_cast<std::size_t>(second_edge)];
  const Vector3 on_first = middle_of(first, first_edge, normal);
  const Vector3 on_second = middle_of(second, second_edge, -normal);
  const Vector3 between = on_second - on_first;
  const double ab = Dot(a, b), along = Dot(between, a), across = Dot(between, b);
  const double scale = 1 / (1 - ab * ab);
  const double half = second.half[static_cast<std::size_t>(second_edge)];
  const double t = std::clamp(scale * (ab * along - across), -half, half);
  const Vector3 point = on_second + t * b;
  points.push_back({point, -normal, Dot(normal, between)});
}

}  // namespace

void AddBoxPoints(const PlacedPiece& first, const PlacedPiece& second, double margin,
                  std::vector<TouchPoint>& points) {
  // An edge axis is used only if its overlap is clearly smaller than the overlaps of all face axes.
  // So boxes that lie on each other keep their face contacts.
  constexpr double kBetter = 0.05, kLeast = 1e-6, kParallel = 1e-3;
  const BoxAt a(first), b(second);
  const Vector3 between = b.position - a.position;
  double cosines[3][3], absolute[3][3], at_a[3], at_b[3];
  for (std::size_t i = 0; i < 3; ++i) {
    at_a[i] = Dot(between, a.axes[i]);
    at_b[i] = Dot(between, b.axes[i]);
    for (std::size_t j = 0; j < 3; ++j) {
      cosines[i][j] = Dot(a.axes[i], b.axes[j]);
      absolute[i][j] = std::abs(cosines[i][j]);
    }
  }
  double best = -1e300;
  int best_axis = 0;
  const auto offer = [&](double separation, int axis) {
    if (separation > best + kLeast) {
      best = separation;
      best_axis = axis;
    }
    return separation < margin;
  };
  for (std::size_t i = 0; i < 3; ++i) {
    const double reach =
        b.half[0] * absolute[i][0] + b.half[1] * absolute[i][1] + b.half[2] * absolute[i][2];
    if (!offer(std::abs(at_a[i]) - a.half[i] - reach, static_cast<int>(i))) return;
  }
  for (std::size_t j = 0; j < 3; ++j) {
    const double reach =
        a.half[0] * absolute[0][j] + a.half[1] * absolute[1][j] + a.half[2] * absolute[2][j];
    if (!offer(std::abs(at_b[j]) - b.half[j] - reach, static_cast<int>(3 + j))) return;
  }
  double best_edge = best + kBetter * std::abs(best) + kLeast;
  int edge = -1;
  Vector3 edge_normal;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3;
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      const double square = 1 - cosines[i][j] * cosines[i][j];
      if (square < kParallel * kParallel) continue;
      // The length of the projection of `between` on the cross product of edge i of box a and edge
      // j of box b, |between · (a_i × b_j)|.
      const double distance = std::abs(at_a[i2] * cosines[i1][j] - at_a[i1] * cosines[i2][j]);
      const double reach = a.half[i1] * absolute[i2][j] + a.half[i2] * absolute[i1][j] +
                           b.half[j1] * absolute[i][j2] + b.half[j2] * absolute[i][j1];
      const double separation = (distance - reach) / std::sqrt(square);
      if (!(separation < margin)) return;
      if (!(separation > best_edge)) continue;
      best_edge = separation;
      edge = static_cast<int>(3 * i + j);
      edge_normal = (1 / std::sqrt(square)) * Cross(a.axes[i], b.axes[j]);
    }
  }
  if (edge >= 0) {
    if (Dot(edge_normal, between) < 0) edge_normal = -edge_normal;
    AddEdgePoint(a, edge / 3, b, edge % 3, edge_normal, points);
  } else if (best_axis < 3) {
    const double sign = at_a[best_axis] < 0 ? -1 : 1;
    AddFacePoints(a, best_axis, sign, b, true, margin, points);
  } else {
    const double sign = at_b[best_axis - 3] < 0 ? 1 : -1;
    AddFacePoints(b, best_axis - 3, sign, a, false, margin, points);
  }
}

}  // namespace gsv::dynamics
