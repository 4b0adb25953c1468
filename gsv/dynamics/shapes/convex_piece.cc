#include "gsv/dynamics/shapes/convex_piece.h"

#include <algorithm>
#include <numbers>

#include "gsv/base/check.h"
#include "gsv/geometry/constants.h"

namespace gsv::dynamics {
namespace {

using geometry::kInfinity;

// A hull omits corners that are closer than this to the line between their neighbours.
constexpr double kFlat = 1e-9;

// Factor that exceeds the rounding errors of compared squared distances.
constexpr double kClearly = 1 + 1e-6;

// The closest pair of points of two sets of vertices and edges that do not overlap.
struct ClosestPoints {
  double squared = kInfinity;
  Vector2 on_a, on_b;
  // The vector along the edge on which one of the two points lies; (0, 0) if both are vertices.
  Vector2 edge;
};

// Compares each vertex with each edge. If `swapped` is true, the vertices are those of b.
void CompareVerticesWithEdges(std::span<const Vector2> vertices, std::span<const Vector2> polygon,
                              bool swapped, ClosestPoints& best) {
  const std::size_t edges = polygon.size() == 2 ? 1 : polygon.size();
  for (std::size_t k = 0; k < edges; ++k) {
    const Vector2 from = polygon[k];
    const Vector2 edge = polygon[k + 1 == polygon.size() ? 0 : k + 1] - from;
    const double squared_length = Dot(edge, edge);
    for (const Vector2 vertex : vertices) {
      // Most vertices are further from the edge's line than the best distance so far. This test
      // avoids the division for them.
      const double across = Cross(edge, vertex - from);
      if (across * across > kClearly * best.squared * squared_length) continue;
      const double along = Dot(vertex - from, edge);
      const double t = along <= 0 ? 0 : along >= squared_length ? 1 : along / squared_length;
      const Vector2 foot = from + t * edge;
      const Vector2 gap = vertex - foot;
      const double squared = Dot(gap, gap);
      if (squared >= best.squared) continue;
      best.squared = squared;
      best.on_a = swapped ? foot : vertex;
      best.on_b = swapped ? vertex : foot;
      best.edge = t > 0 && t < 1 ? edge : Vector2{};
    }
  }
}

ClosestPoints FindClosestPoints(const ConvexPiece& a, const ConvexPiece& b) {
  ClosestPoints best;
  CompareVerticesWithEdges(a.points(), b.points(), false, best);
  if (a.vertex_count > 1) CompareVerticesWithEdges(b.points(), a.points(), true, best);
  return best;
}

double Highest(const ConvexPiece& piece, Vector2 direction) {
  double highest = -kInfinity;
  for (const Vector2 v : piece.points()) highest = std::max(highest, Dot(v, direction));
  return highest;
}

double Lowest(const ConvexPiece& piece, Vector2 direction) {
  double lowest = kInfinity;
  for (const Vector2 v : piece.points()) lowest = std::min(lowest, Dot(v, direction));
  return lowest;
}

// Finds the axis with the smallest overlap among the outward normals of all edges of `from`. For a
// segment, the directions of its ends are also tried.
void TryAxes(const ConvexPiece& from, const ConvexPiece& other, double sign, double& distance,
             Vector2& normal) {
  const auto try_axis = [&](Vector2 axis, double top) {
    const double separation = Lowest(other, axis) - top;
    if (separation <= distance) return;
    distance = separation;
    normal = sign * axis;
  };
  for (int k = 0; k < from.vertex_count; ++k) {
    const Vector2 start = from.vertices[k];
    const Vector2 edge = from.vertices[k + 1 == from.vertex_count ? 0 : k + 1] - start;
    const double length = std::sqrt(Dot(edge, edge));
    if (!(length > 0)) continue;
    const Vector2 outward{edge.y / length, -edge.x / length};
    try_axis(outward, Dot(start, outward));
    if (from.vertex_count == 2) {
      const Vector2 back{-edge.x / length, -edge.y / length};
      try_axis(back, Dot(start, back));
    }
  }
}

Separation SeparateOverlapping(const ConvexPiece& a, const ConvexPiece& b,
                               const ClosestPoints& closest) {
  Separation result;
  result.distance = -kInfinity;
  TryAxes(a, b, 1, result.distance, result.normal);
  TryAxes(b, a, -1, result.distance, result.normal);
  if (result.distance == -kInfinity) {  // both pieces are discs with the same centre
    result.distance = 0;
    result.normal = {1, 0};
  }
  result.point = 0.5 * (closest.on_a + closest.on_b);
  return result;
}

// The unit vector from the closest point on a to the closest point on b. If one of these points
// lies on an edge, the vector is the edge's normal, because the direction of a short gap is less
// exact.
Vector2 GapDirection(const ClosestPoints& closest, double gap) {
  const Vector2 difference = closest.on_b - closest.on_a;
  if (closest.edge == Vector2{}) return {difference.x / gap, difference.y / gap};
  const double length = std::sqrt(Dot(closest.edge, closest.edge));
  const Vector2 normal{closest.edge.y / length, -closest.edge.x / length};
  return Dot(normal, difference) < 0 ? -1.0 * normal : normal;
}

}  // namespace

ConvexPiece Disc(Vector2 centre, double radius) {
  ConvexPiece disc;
  disc.radius = radius;
  disc.vertex_count = 1;
  disc.vertices[0] = centre;
  return disc;
}

void Place(const ConvexPiece& piece, double x, double y, double cosine, double sine,
           ConvexPiece& placed) {
  placed.radius = piece.radius;
  placed.vertex_count = piece.vertex_count;
  for (int i = 0; i < piece.vertex_count; ++i) {
    const Vector2 v = piece.vertices[i];
    placed.vertices[i] = {x + (cosine * v.x - sine * v.y), y + (sine * v.x + cosine * v.y)};
  }
}

Separation Separate(const ConvexPiece& a, const ConvexPiece& b) {
  const ClosestPoints closest = FindClosestPoints(a, b);
  Separation result;
  const double gap = std::sqrt(closest.squared);
  bool apart = gap > 0;
  if (apart) {
    result.normal = GapDirection(closest, gap);
    // If the pieces overlap, the gap between the closest vertex and edge is positive too. So the
    // pieces are apart only if they do not overlap in the direction of the gap.
    apart = (a.vertex_count == 1 && b.vertex_count <= 2) ||
            Lowest(b, result.normal) - Highest(a, result.normal) > 0;
    result.distance = gap;
    result.point = 0.5 * (closest.on_a + closest.on_b);
  }
  if (!apart) result = SeparateOverlapping(a, b, closest);
  result.distance -= a.radius + b.radius;
  result.point = result.point + (0.5 * (a.radius - b.radius)) * result.normal;
  return result;
}

double DistanceTo(const ConvexPiece& piece, Vector2 point) {
  const int n = piece.vertex_count;
  double nearest = kInfinity;
  bool inside = n > 2;
  Vector2 from = piece.vertices[n - 1];
  for (int k = 0; k < n; ++k) {
    const Vector2 to = piece.vertices[k], edge = to - from, offset = point - from;
    const double squared_length = Dot(edge, edge), along = Dot(offset, edge);
    inside = inside && Cross(edge, offset) >= 0;
    double squared;
    if (along <= 0) {
      squared = Dot(offset, offset);
    } else if (along >= squared_length) {
      squared = Dot(point - to, point - to);
    } else {
      const double across = Cross(edge, offset);
      squared = across * across / squared_length;
    }
    nearest = std::min(nearest, squared);
    from = to;
  }
  return inside ? 0 : std::max(0.0, std::sqrt(nearest) - piece.radius);
}

bool Contains(const ConvexPiece& outer, const ConvexPiece& inner, double tolerance) {
  if (outer.vertex_count == 1) {
    return std::all_of(inner.points().begin(), inner.points().end(), [&](Vector2 v) {
      const Vector2 d = v - outer.vertices[0];
      return std::sqrt(Dot(d, d)) + inner.radius <= outer.radius + tolerance;
    });
  }
  for (int k = 0; k < outer.vertex_count; ++k) {
    const Vector2 start = outer.vertices[k];
    const Vector2 edge = outer.vertices[k + 1 == outer.vertex_count ? 0 : k + 1] - start;
    const double length = std::sqrt(Dot(edge, edge));
    const Vector2 outward{edge.y / length, -edge.x / length};
    if (Highest(inner, outward) + inner.radius > Dot(start, outward) + tolerance) return false;
  }
  return outer.vertex_count > 2;
}

ConvexPiece BoundingDisc(const ConvexPiece& piece) {
  Vector2 centre;
  for (const Vector2 v : piece.points()) centre = centre + v;
  centre = (1.0 / piece.vertex_count) * centre;
  double radius = 0;
  for (const Vector2 v : piece.points()) {
    radius = std::max(radius, std::sqrt(Dot(v - centre, v - centre)));
  }
  return Disc(centre, radius + piece.radius);
}

namespace {

// Computes the hull by Andrew's monotone chain: counter-clockwise, without corners that are flatter
// than kFlat.
std::vector<Vector2> HullCorners(std::vector<Vector2> points) {
  std::sort(points.begin(), points.end(),
            [](Vector2 a, Vector2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  const auto turns_left = [](Vector2 a, Vector2 b, Vector2 c) {
    const Vector2 base = c - a;
    const double length = std::sqrt(Dot(base, base));
    return Cross(b - a, c - b) > kFlat * length;
  };
  std::vector<Vector2> hull;
  const auto add_chain = [&](auto begin, auto end) {
    const std::size_t bottom = hull.size();
    for (auto it = begin; it != end; ++it) {
      while (hull.size() >= bottom + 2 && !turns_left(hull[hull.size() - 2], hull.back(), *it)) {
        hull.pop_back();
      }
      hull.push_back(*it);
    }
    hull.pop_back();  // the next chain starts with this point
  };
  add_chain(points.begin(), points.end());
  add_chain(points.rbegin(), points.rend());
  return hull;
}

}  // namespace

ConvexPiece PolygonAround(const std::function<double(Vector2)>& support, double angle) {
  constexpr int kSides = ConvexPiece::kMaxVertices;
  std::array<Vector2, kSides> direction;
  std::array<double, kSides> reach;
  for (int k = 0; k < kSides; ++k) {
    const double a = angle + 2 * std::numbers::pi * k / kSides;
    direction[k] = {std::cos(a), std::sin(a)};
    reach[k] = support(direction[k]);
  }
  std::vector<Vector2> corners;
  for (int k = 0; k < kSides; ++k) {
    // The corner is the intersection of the lines direction·p = reach of two adjacent edges.
    const Vector2 d = direction[k], e = direction[(k + 1) % kSides];
    const double determinant = Cross(d, e);
    const double p = reach[k], q = reach[(k + 1) % kSides];
    corners.push_back({(p * e.y - q * d.y) / determinant, (d.x * q - e.x * p) / determinant});
  }
  corners = HullCorners(std::move(corners));
  ConvexPiece piece;
  piece.vertex_count = static_cast<int>(corners.size());
  std::copy(corners.begin(), corners.end(), piece.vertices.begin());
  return piece;
}

ConvexPiece Hull(std::vector<Vector2> points) {
  GSV_CHECK(!points.empty());
  const std::vector<Vector2> corners = HullCorners(std::move(points));
  if (corners.size() > ConvexPiece::kMaxVertices) {
    return PolygonAround(
        [&](Vector2 direction) {
          double highest = -kInfinity;
          for (const Vector2 v : corners) highest = std::max(highest, Dot(v, direction));
          return highest;
        },
        0);
  }
  ConvexPiece piece;
  piece.vertex_count = static_cast<int>(corners.size());
  std::copy(corners.begin(), corners.end(), piece.vertices.begin());
  return piece;
}

}  // namespace gsv::dynamics
