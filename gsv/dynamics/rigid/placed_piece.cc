#include "gsv/dynamics/rigid/placed_piece.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "gsv/dynamics/rigid/triangle_surface.h"

namespace gsv::dynamics {
namespace {

using geometry::Vector3;
using PieceKind = Piece::Kind;

Vector3 Abs(const Vector3& v) { return {std::abs(v.x), std::abs(v.y), std::abs(v.z)}; }

// Half of the size of the bounding box, and the vector from the piece's origin to the box's centre.
Vector3 ExtentOf(const Piece& piece, const Matrix3& rotation, Vector3& middle) {
  const Vector3& axis = rotation.z;
  const double radius = piece.half.x, half = piece.half.z;
  switch (piece.kind) {
    case PieceKind::kSphere:
      return {radius, radius, radius};
    case PieceKind::kCapsule:
      return half * Abs(axis) + Vector3{radius, radius, radius};
    case PieceKind::kCylinder: {
      const auto across = [&](double a) { return radius * std::sqrt(std::max(0.0, 1 - a * a)); };
      return half * Abs(axis) + Vector3{across(axis.x), across(axis.y), across(axis.z)};
    }
    case PieceKind::kPlane: {
      constexpr double kNoEnd = std::numeric_limits<double>::infinity();
      return {kNoEnd, kNoEnd, kNoEnd};
    }
    default:
      middle = rotation * piece.middle;
      return piece.box.x * Abs(rotation.x) + piece.box.y * Abs(rotation.y) +
             piece.box.z * Abs(rotation.z);
  }
}

void AddSphereOnSphere(const Vector3& first, double first_radius, const Vector3& second,
                       double second_radius, double margin, std::vector<TouchPoint>& points) {
  const Vector3 between = first - second;
  const double length = Norm(between), distance = length - first_radius - second_radius;
  if (!(distance < margin)) return;
  const Vector3 normal = length > 1e-12 ? (1 / length) * between : Vector3{0, 0, 1};
  points.push_back({second + second_radius * normal, normal, distance});
}

// Finds the points at which a piece touches a plane. The solid side of the plane is opposite to its
// normal.
class OnPlane {
 public:
  OnPlane(const PlacedPiece& piece, const PlacedPiece& plane, double margin,
          std::vector<TouchPoint>& points)
      : piece_(piece),
        normal_(plane.rotation * plane.piece->normal),
        height_(Dot(normal_, piece.position - plane.position)),
        margin_(margin),
        points_(points) {}

  void AddSphere() { Add({}, piece_.piece->half.x); }
  void AddCapsule() {
    for (const double sign : {-1.0, 1.0}) {
      Add(sign * piece_.piece->half.z * piece_.rotation.z, piece_.piece->half.x);
    }
  }
  void AddBox() {
    const Vector3 half = piece_.piece->half;
    const Vector3 x = half.x * piece_.rotation.x, y = half.y * piece_.rotation.y;
    const Vector3 z = half.z * piece_.rotation.z;
    for (const double i : {-1.0, 1.0}) {
      for (const double j : {-1.0, 1.0}) {
        for (const double k : {-1.0, 1.0}) Add(i * x + j * y + k * z, 0);
      }
    }
  }

  void AddCylinder() {
    std::array<Vector3, 4> lowest;
    const int count = LowestOfCylinder(piece_, normal_, lowest);
    for (int i = 0; i < count; ++i) Add(lowest[static_cast<std::size_t>(i)], 0);
  }

 private:
  // Adds the contact of a sphere with the plane. `from_middle` is the vector from the middle of the
  // piece to the sphere's centre.
  void Add(const Vector3& from_middle, double radius) {
    const double height = height_ + Dot(normal_, from_middle);
    if (!(height - radius < margin_)) return;
    points_.push_back({piece_.position + from_middle - height * normal_, normal_, height - radius});
  }

  const PlacedPiece& piece_;
  const Vector3 normal_;
  const double height_;
  const double margin_;
  std::vector<TouchPoint>& points_;
};

bool AddOnPlane(const PlacedPiece& piece, const PlacedPiece& plane, double margin,
                std::vector<TouchPoint>& points) {
  OnPlane on_plane(piece, plane, margin, points);
  switch (piece.piece->kind) {
    case PieceKind::kSphere:
      on_plane.AddSphere();
      return true;
    case PieceKind::kCapsule:
      on_plane.AddCapsule();
      return true;
    case PieceKind::kBox:
      on_plane.AddBox();
      return true;
    case PieceKind::kCylinder:
      on_plane.AddCylinder();
      return true;
    default:
      return false;
  }
}

void AddSphereOnBox(const PlacedPiece& sphere, const PlacedPiece& box, double margin,
                    std::vector<TouchPoint>& points) {
  const double radius = sphere.piece->half.x;
  const Vector3& half = box.piece->half;
  const Vector3 at = TransposeTimes(box.rotation, sphere.position - box.position);
  const Vector3 nearest{std::clamp(at.x, -half.x, half.x), std::clamp(at.y, -half.y, half.y),
                        std::clamp(at.z, -half.z, half.z)};
  const Vector3 out = at - nearest;
  const double length = Norm(out);
  if (length > 1e-12) {
    if (!(length - radius < margin)) return;
    points.push_back({box.position + box.rotation * nearest, box.rotation * ((1 / length) * out),
                      length - radius});
    return;
  }
  // The sphere's centre is inside the box, so the nearest face is used.
  const double rooms[] = {half.x - std::abs(at.x), half.y - std::abs(at.y),
                          half.z - std::abs(at.z)};
  const auto axis = std::min_element(std::begin(rooms), std::end(rooms)) - std::begin(rooms);
  Vector3 normal, surface = at;
  if (axis == 0) {
    normal.x = at.x < 0 ? -1 : 1;
    surface.x = normal.x * half.x;
  } else if (axis == 1) {
    normal.y = at.y < 0 ? -1 : 1;
    surface.y = normal.y * half.y;
  } else {
    normal.z = at.z < 0 ? -1 : 1;
    surface.z = normal.z * half.z;
  }
  points.push_back(
      {box.position + box.rotation * surface, box.rotation * normal, -rooms[axis] - radius});
}

bool AddInOrder(const PlacedPiece& first, const PlacedPiece& second, double margin,
                std::vector<TouchPoint>& points) {
  const PieceKind a = first.piece->kind, b = second.piece->kind;
  if (b == PieceKind::kPlane) return AddOnPlane(first, second, margin, points);
  if (b == PieceKind::kMesh)
    return second.piece->triangles->AddPoints(first, second, margin, points);
  if (a == PieceKind::kSphere && b == PieceKind::kSphere) {
    AddSphereOnSphere(first.position, first.piece->half.x, second.position, second.piece->half.x,
                      margin, points);
    return true;
  }
  if (a == PieceKind::kSphere && b == PieceKind::kBox) {
    AddSphereOnBox(first, second, margin, points);
    return true;
  }
  if (a == PieceKind::kSphere && b == PieceKind::kCapsule) {
    const double half = second.piece->half.z;
    const double at =
        std::clamp(Dot(second.rotation.z, first.position - second.position), -half, half);
    AddSphereOnSphere(first.position, first.piece->half.x, second.position + at * second.rotation.z,
                      second.piece->half.x, margin, points);
    return true;
  }
  if (a == PieceKind::kBox && b == PieceKind::kBox) {
    AddBoxPoints(first, second, margin, points);
    return true;
  }
  return false;
}

}  // namespace

// A cylinder stands on its lower rim if its axis is within about 45° of the normal. It counts as
// upright if the angle is below a milliradian.
int LowestOfCylinder(const PlacedPiece& cylinder, const Vector3& normal,
                     std::array<Vector3, 4>& lowest) {
  constexpr double kLies = 0.7, kStandsUpright = 1e-3;
  const double radius = cylinder.piece->half.x, half = cylinder.piece->half.z;
  const Vector3& axis = cylinder.rotation.z;
  const double up = Dot(normal, axis);
  const Vector3 lower = axis * (up > 0 ? -half : half);
  Vector3 down = axis * up - normal, aside;
  if (Norm(down) > kStandsUpright) {
    down = Normalized(down);
    aside = Cross(axis, down);
  } else {
    // If the cylinder is nearly upright, these points do not depend on the direction in which it
    // leans.
    down = cylinder.rotation.x;
    aside = cylinder.rotation.y;
  }
  lowest[0] = lower + radius * down;
  if (std::abs(up) < kLies) {
    lowest[1] = radius * down - lower;
    return 2;
  }
  lowest[1] = lower - radius * down;
  lowest[2] = lower + radius * aside;
  lowest[3] = lower - radius * aside;
  return 4;
}

PlacedPiece Place(const Piece& piece, const Vector3& position, const Matrix3& rotation) {
  PlacedPiece placed;
  placed.piece = &piece;
  placed.rotation = rotation * piece.rotation;
  placed.position = position + rotation * piece.solid_from_piece.position;
  SetBoundsOf(placed);
  return placed;
}

void SetBoundsOf(PlacedPiece& placed) {
  Vector3 middle;
  const Vector3 half = ExtentOf(*placed.piece, placed.rotation, middle);
  placed.low = placed.position + middle - half;
  placed.high = placed.position + middle + half;
}

bool AddTouchPoints(const PlacedPiece& first, const PlacedPiece& second, double margin,
                    std::vector<TouchPoint>& points) {
  if (AddInOrder(first, second, margin, points)) return true;
  const std::size_t begin = points.size();
  if (!AddInOrder(second, first, margin, points)) return false;
  for (std::size_t i = begin; i < points.size(); ++i) {
    points[i].on_second += points[i].distance * points[i].normal;
    points[i].normal = -points[i].normal;
  }
  return true;
}

}  // namespace gsv::dynamics
