#include "gsv/formats/meshes/polygon_triangulation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gsv/base/sorting.h"

namespace gsv::formats {
namespace {

using geometry::Vector2;

struct Corner {
  Vector2 point;
  std::uint32_t index;
};
using Ring = std::vector<Corner>;

// Returns twice the area of the triangle a b c; positive if it is counter-clockwise.
double Turn(const Vector2& a, const Vector2& b, const Vector2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

bool InTriangle(const Vector2& p, const Vector2& a, const Vector2& b, const Vector2& c) {
  return Turn(a, b, p) >= 0 && Turn(b, c, p) >= 0 && Turn(c, a, p) >= 0;
}

Ring ToRing(const Outline& outline, std::uint32_t first_index) {
  Ring ring;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    ring.push_back({outline[i], first_index + static_cast<std::uint32_t>(i)});
  }
  return ring;
}

std::size_t Rightmost(const Ring& ring) {
  return static_cast<std::size_t>(
      std::max_element(ring.begin(), ring.end(),
                       [](const Corner& a, const Corner& b) { return a.point.x < b.point.x; }) -
      ring.begin());
}

// Whether the segment from the ring's corner i to `p` starts inside the ring. The bridges of
// JoinHole() make several corners at the same point. This function finds the one that faces `p`.
bool Faces(const Ring& ring, std::size_t i, const Vector2& p) {
  const std::size_t n = ring.size();
  const Vector2 &before = ring[(i + n - 1) % n].point, &here = ring[i].point;
  const Vector2& after = ring[(i + 1) % n].point;
  const bool left_of_both = Turn(before, here, p) >= 0 && Turn(here, after, p) >= 0;
  const bool left_of_either = Turn(before, here, p) >= 0 || Turn(here, after, p) >= 0;
  return Turn(before, here, after) > 0 ? left_of_both : left_of_either;
}

// The first intersection of a ray with an edge of the ring, and the right end of this edge. The ray
// begins at `eye`, a point inside the ring, and has the direction +x.
struct Hit {
  double x = std::numeric_limits<double>::infinity();
  std::size_t corner = 0;
};
Hit FirstHit(const Ring& ring, const Vector2& eye) {
  Hit hit;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const std::size_t next = (i + 1) % ring.size();
    const Vector2 &a = ring[i].point, &b = ring[next].point;
    // The interior is to the left of an edge, so the ray leaves the interior through an edge
    // towards +y.
    if (!(a.y <= eye.y && b.y >= eye.y) || a.y == b.y) continue;
    const double x = a.x + (eye.y - a.y) / (b.y - a.y) * (b.x - a.x);
    if (x >= eye.x && x < hit.x) hit = {x, a.x > b.x ? i : next};
  }
  return hit;
}

// Returns a corner of `ring` that is visible from `eye`, or ring.size() if there is none. The
// corner is the right end of the edge that the ray hits, unless reflex corners are in between. Then
// it is the reflex corner with the smallest angle to the ray. If several corners have
// this angle, it is the nearest of them.
std::size_t VisibleCorner(const Ring& ring, const Vector2& eye) {
  const Hit hit = FirstHit(ring, eye);
  if (std::isinf(hit.x)) return ring.size();
  const Vector2 on_edge{hit.x, eye.y}, end = ring[hit.corner].point;
  std::size_t best = hit.corner;
  double best_slope = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vector2& p = ring[i].point;
    if (p == end || p.x < eye.x) continue;
    const bool between =
        end.y < eye.y ? InTriangle(p, eye, end, on_edge) : InTriangle(p, eye, on_edge, end);
    if (!between || !Faces(ring, i, eye)) continue;
    const double slope = std::abs(p.y - eye.y) / std::max(p.x - eye.x, 1e-300);
    if (slope < best_slope || (slope == best_slope && p.x < ring[best].point.x)) {
      best_slope = slope;
      best = i;
    }
  }
  return best;
}

// Inserts the hole into the ring, with a bridge from a visible corner. Returns false if no corner
// is visible.
bool JoinHole(Ring& ring, const Ring& hole) {
  const std::size_t start = Rightmost(hole);
  const std::size_t corner = VisibleCorner(ring, hole[start].point);
  if (corner == ring.size()) return false;
  Ring bridge;
  for (std::size_t i = 0; i <= hole.size(); ++i) bridge.push_back(hole[(start + i) % hole.size()]);
  bridge.push_back(ring[corner]);
  ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(corner) + 1, bridge.begin(), bridge.end());
  return true;
}

bool IsEar(const Ring& ring, std::size_t previous, std::size_t tip, std::size_t next) {
  const Vector2 &a = ring[previous].point, &b = ring[tip].point, &c = ring[next].point;
  if (Turn(a, b, c) <= 0) return false;
  for (const Corner& other : ring) {
    const Vector2& p = other.point;
    if (p == a || p == b || p == c) continue;
    if (InTriangle(p, a, b, c)) return false;
  }
  return true;
}

}  // namespace

double TwiceSignedArea(const Outline& outline) {
  double area = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vector2 &a = outline[i], &b = outline[(i + 1) % outline.size()];
    area += a.x * b.y - b.x * a.y;
  }
  return area;
}

base::Result<std::vector<std::array<std::uint32_t, 3>>> Triangulate(
    const Outline& outer, const std::vector<Outline>& holes) {
  const auto crossed = [] {
    return Fail(base::ErrorCode::kBadModel, "an outline crosses itself or another outline");
  };
  Ring ring = ToRing(outer, 0);
  std::vector<Ring> hole_rings;
  auto first = static_cast<std::uint32_t>(outer.size());
  for (const Outline& hole : holes) {
    hole_rings.push_back(ToRing(hole, first));
    first += static_cast<std::uint32_t>(hole.size());
  }
  // Sorts the holes from right to left. Then a corner of the outline, or of a hole that is already
  // joined, is visible from each hole.
  base::Sort(hole_rings, [](const Ring& a, const Ring& b) {
    return a[Rightmost(a)].point.x > b[Rightmost(b)].point.x;
  });
  for (const Ring& hole : hole_rings) {
    if (!JoinHole(ring, hole)) return crossed();
  }

  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::size_t tip = 0, refused = 0;
  while (ring.size() > 3) {
    const std::size_t n = ring.size();
    tip %= n;
    const std::size_t previous = (tip + n - 1) % n, next = (tip + 1) % n;
    const bool flat = Turn(ring[previous].point, ring[tip].point, ring[next].point) == 0;
    if (flat || IsEar(ring, previous, tip, next)) {
      if (!flat) triangles.push_back({ring[previous].index, ring[tip].index, ring[next].index});
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(tip));
      refused = 0;
    } else if (++refused > n) {
      return crossed();
    } else {
      ++tip;
    }
  }
  if (ring.size() == 3 && Turn(ring[0].point, ring[1].point, ring[2].point) > 0) {
    triangles.push_back({ring[0].index, ring[1].index, ring[2].index});
  }
  return triangles;
}

}  // namespace gsv::formats
