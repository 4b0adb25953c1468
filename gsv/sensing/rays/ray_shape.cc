#include "gsv/sensing/rays/ray_shape.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "gsv/base/check.h"
#include "gsv/geometry/constants.h"

namespace gsv::sensing {
namespace {

using geometry::Vector3;

using geometry::kInfinity;

// Adjacent triangles overlap by this fraction of their edges, so that no ray passes between them.
constexpr double kSeam = 1e-12;

// The interval of a line inside a convex solid.
struct Span {
  double enter = -kInfinity, leave = kInfinity;

  Span() = default;
  Span(double from, double to) : enter(from), leave(to) {}
  // Constructed like a Chord; the normals are ignored.
  Span(double from, double to, const Vector3&, const Vector3&) : enter(from), leave(to) {}
  bool empty() const { return !(enter <= leave); }
};

// A span with the outward normals at both ends. They may have any length.
struct Chord : Span {
  Vector3 enter_normal, leave_normal;

  Chord() = default;
  Chord(double from, double to, const Vector3& from_normal, const Vector3& to_normal)
      : Span(from, to), enter_normal(from_normal), leave_normal(to_normal) {}
};

// The functions below are templates. They return a Span or a Chord (type C). Usually only the
// distance is needed, and a Span is sufficient.

template <class C>
C Nothing() {
  return {kInfinity, -kInfinity, {}, {}};
}

// Returns the span from the start of `from` to the end of `to`.
Span Joined(const Span& from, const Span& to) { return {from.enter, to.leave}; }
Chord Joined(const Chord& from, const Chord& to) {
  return {from.enter, to.leave, from.enter_normal, to.leave_normal};
}

template <class C>
C Intersection(const C& a, const C& b) {
  return Joined(a.enter >= b.enter ? a : b, a.leave <= b.leave ? a : b);
}

// The union of two chords through solids whose union is convex.
template <class C>
C ConvexUnion(const C& a, const C& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return Joined(a.enter <= b.enter ? a : b, a.leave >= b.leave ? a : b);
}

// Returns the chord between the planes at ±half along one axis.
template <class C>
C Slab(double origin, double direction, double half, const Vector3& axis) {
  if (direction == 0) return std::abs(origin) <= half ? C{} : Nothing<C>();
  const double to_low = (-half - origin) / direction, to_high = (half - origin) / direction;
  if (direction > 0) return {to_low, to_high, -axis, axis};
  return {to_high, to_low, axis, -axis};
}

template <class C>
C Along(const Ray& ray, const geometry::Box& box) {
  const Vector3 half = 0.5 * box.size;
  return Intersection(Intersection(Slab<C>(ray.origin.x, ray.direction.x, half.x, {1, 0, 0}),
                                   Slab<C>(ray.origin.y, ray.direction.y, half.y, {0, 1, 0})),
                      Slab<C>(ray.origin.z, ray.direction.z, half.z, {0, 0, 1}));
}

template <class C>
C BallChord(const Ray& ray, const Vector3& centre, double radius) {
  const Vector3 from_centre = ray.origin - centre;
  const double middle = -Dot(from_centre, ray.direction);
  const Vector3 nearest = from_centre + middle * ray.direction;
  const double squared = radius * radius - Dot(nearest, nearest);
  if (squared < 0) return Nothing<C>();
  const double half = std::sqrt(squared);
  return {middle - half, middle + half, nearest - half * ray.direction,
          nearest + half * ray.direction};
}

template <class C>
C Along(const Ray& ray, const geometry::Sphere& sphere) {
  return BallChord<C>(ray, {}, sphere.radius);
}

// Returns the chord through the infinite cylinder about z.
template <class C>
C PipeChord(const Ray& ray, double radius) {
  const Vector3 flat{ray.direction.x, ray.direction.y, 0};
  const Vector3 origin{ray.origin.x, ray.origin.y, 0};
  const double speed = Dot(flat, flat);
  if (speed == 0) return Dot(origin, origin) <= radius * radius ? C{} : Nothing<C>();
  const double middle = -Dot(origin, flat) / speed;
  const Vector3 nearest = origin + middle * flat;
  const double squared = radius * radius - Dot(nearest, nearest);
  if (squared < 0) return Nothing<C>();
  const double half = std::sqrt(squared / speed);
  return {middle - half, middle + half, nearest - half * flat, nearest + half * flat};
}

template <class C>
C Along(const Ray& ray, const geometry::Cylinder& cylinder) {
  return Intersection(PipeChord<C>(ray, cylinder.radius),
                      Slab<C>(ray.origin.z, ray.direction.z, cylinder.length / 2, {0, 0, 1}));
}

template <class C>
C Along(const Ray& ray, const geometry::Capsule& capsule) {
  const double half = capsule.length / 2;
  const C body = Intersection(PipeChord<C>(ray, capsule.radius),
                              Slab<C>(ray.origin.z, ray.direction.z, half, {0, 0, 1}));
  return ConvexUnion(body, ConvexUnion(BallChord<C>(ray, {0, 0, half}, capsule.radius),
                                       BallChord<C>(ray, {0, 0, -half}, capsule.radius)));
}

template <class C>
C Along(const Ray& ray, const geometry::Ellipsoid& ellipsoid) {
  // The coordinates are scaled such that the ellipsoid is the unit sphere. The parameter along the
  // ray stays the same.
  const Vector3 shrink{1 / ellipsoid.radii.x, 1 / ellipsoid.radii.y, 1 / ellipsoid.radii.z};
  const Vector3 origin = Scaled(ray.origin, shrink), direction = Scaled(ray.direction, shrink);
  const double speed = Dot(direction, direction);
  const double middle = -Dot(origin, direction) / speed;
  const Vector3 nearest = origin + middle * direction;
  const double squared = 1 - Dot(nearest, nearest);
  if (squared < 0) return Nothing<C>();
  const double half = std::sqrt(squared / speed);
  return {middle - half, middle + half, Scaled(nearest - half * direction, shrink),
          Scaled(nearest + half * direction, shrink)};
}

// The chord inside the cone. The apex is at +length/2. With the depth w below the apex and the
// slope k, a point is inside if x² + y² <= k² w². For points of the ray, this is A t² + 2 B t + C
// <= 0.
template <class C>
C Along(const Ray& ray, const geometry::Cone& cone) {
  const double k = cone.radius / cone.length;
  const Vector3& d = ray.direction;
  const Vector3 o{ray.origin.x, ray.origin.y, ray.origin.z - cone.length / 2};
  const C slab = Slab<C>(ray.origin.z, ray.direction.z, cone.length / 2, {0, 0, 1});
  const double a = d.x * d.x + d.y * d.y - k * k * d.z * d.z;
  const double b = o.x * d.x + o.y * d.y - k * k * o.z * d.z;
  const double c = o.x * o.x + o.y * o.y - k * k * o.z * o.z;
  const auto side = [&](double from, double to) {
    const auto normal = [&](double t) {
      const Vector3 p = o + t * d;
      return std::isfinite(t) ? Vector3{p.x, p.y, -k * k * p.z} : Vector3{};
    };
    return Intersection(slab, C{from, to, normal(from), normal(to)});
  };
  if (std::abs(a) < 1e-14) {  // the ray is parallel to the side and crosses the side once
    if (b == 0) return c <= 0 ? slab : Nothing<C>();
    const double t = -c / (2 * b);
    return b > 0 ? side(-kInfinity, t) : side(t, kInfinity);
  }
  const double squared = b * b - a * c;
  if (squared < 0) return a > 0 ? Nothing<C>() : slab;
  const double q = -(b + std::copysign(std::sqrt(squared), b));
  double first = q / a, second = q != 0 ? c / q : first;
  if (first > second) std::swap(first, second);
  if (a > 0) return side(first, second);
  // The ray is steeper than the side: it is inside one half of the double cone before the first
  // crossing, and inside the other half after the last crossing.
  const C before = side(-kInfinity, first);
  return before.empty() ? side(second, kInfinity) : before;
}

Vector3 Against(const Vector3& normal, const Vector3& direction) {
  const Vector3 unit = Normalized(normal);
  return Dot(unit, direction) > 0 ? -unit : unit;
}

// Whether a crossing at this distance is on the ray.
bool Counts(double distance, const Ray& ray) {
  return distance >= 0 && distance <= ray.max_distance;
}

std::optional<double> DistanceTo(const geometry::Plane& plane, const Ray& ray) {
  const double approach = Dot(plane.normal, ray.direction);
  if (approach == 0) return std::nullopt;
  const double distance = -Dot(plane.normal, ray.origin) / approach;
  if (!Counts(distance, ray)) return std::nullopt;
  return distance;
}

struct DistanceCaster {
  const Ray& ray;

  template <typename Convex>
  std::optional<double> operator()(const Convex& shape) const {
    const Span span = Along<Span>(ray, shape);
    if (span.empty()) return std::nullopt;
    const double distance = span.enter >= 0 ? span.enter : span.leave;
    if (!Counts(distance, ray)) return std::nullopt;
    return distance;
  }
  std::optional<double> operator()(const geometry::Plane& plane) const {
    return DistanceTo(plane, ray);
  }
  std::optional<double> operator()(const geometry::Mesh&) const {
    GSV_CHECK(!"a mesh is cast at triangle by triangle");
    return std::nullopt;
  }
};

struct NormalCaster {
  const Ray& ray;

  template <typename Convex>
  Vector3 operator()(const Convex& shape) const {
    const Chord chord = Along<Chord>(ray, shape);
    return chord.enter >= 0 ? chord.enter_normal : chord.leave_normal;
  }
  Vector3 operator()(const geometry::Plane& plane) const { return plane.normal; }
  Vector3 operator()(const geometry::Mesh&) const { return {}; }
};

}  // namespace

// Source  T. Möller, B. Trumbore, "Fast, minimum storage ray-triangle intersection", 1997.
std::optional<double> DistanceToTriangle(const Ray& ray, const Triangle& triangle) {
  const Vector3 p = Cross(ray.direction, triangle.edge2);
  const double determinant = Dot(triangle.edge1, p);
  if (determinant == 0) return std::nullopt;
  const double inverse = 1 / determinant;
  const Vector3 from_corner = ray.origin - triangle.corner;
  const double u = Dot(from_corner, p) * inverse;
  if (!(u >= -kSeam && u <= 1 + kSeam)) return std::nullopt;
  const Vector3 q = Cross(from_corner, triangle.edge1);
  const double v = Dot(ray.direction, q) * inverse;
  if (!(v >= -kSeam && u + v <= 1 + kSeam)) return std::nullopt;
  const double distance = Dot(triangle.edge2, q) * inverse;
  if (!Counts(distance, ray)) return std::nullopt;
  return distance;
}

Vector3 NormalOfTriangle(const Ray& ray, const Triangle& triangle) {
  return Against(Cross(triangle.edge1, triangle.edge2), ray.direction);
}

// Most shapes are cylinders and boxes. For these, all calls are worth inlining.
[[gnu::flatten]] std::optional<double> DistanceToShape(const Ray& ray,
                                                       const geometry::Shape& shape) {
  const DistanceCaster caster{ray};
  if (const auto* const cylinder = std::get_if<geometry::Cylinder>(&shape))
    return caster(*cylinder);
  if (const auto* const box = std::get_if<geometry::Box>(&shape)) return caster(*box);
  return std::visit(DistanceCaster{ray}, shape);
}

Vector3 NormalOfShape(const Ray& ray, const geometry::Shape& shape) {
  return Against(std::visit(NormalCaster{ray}, shape), ray.direction);
}

}  // namespace gsv::sensing
