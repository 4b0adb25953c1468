#include "gsv/rendering/lenses/lens.h"

#include <cmath>

#include "gsv/base/named.h"

namespace gsv::rendering {
namespace {

using geometry::Vector2;
using geometry::Vector3;

// Newton's method stops when its step is smaller than this length in the normalized image plane
// (focal length 1). This is far less than a pixel, because an image has at most 4,096 pixels per
// side.
constexpr double kCloseEnough = 1e-12;
constexpr int kMaxSteps = 50;

double Apply(WideView::Function function, double angle) {
  switch (function) {
    case WideView::Function::kSine:
      return std::sin(angle);
    case WideView::Function::kTangent:
      return std::tan(angle);
    case WideView::Function::kIdentity:
      break;
  }
  return angle;
}

// Solves function(x) = value. Returns NaN if there is no solution.
double Invert(WideView::Function function, double value) {
  switch (function) {
    case WideView::Function::kSine:
      return std::asin(value);
    case WideView::Function::kTangent:
      return std::atan(value);
    case WideView::Function::kIdentity:
      break;
  }
  return value;
}

double RadiusAt(const WideView& view, double angle) {
  return view.c1 * view.f * Apply(view.function, angle / view.c2 + view.c3);
}

Intrinsics IntrinsicsOf(const CameraParameters& camera) {
  const double f = FocalLength(camera);
  return {f, f, 0.5 * camera.width, 0.5 * camera.height, 0};
}

}  // namespace

base::Result<WideView> WideViewNamed(const std::string& type) {
  using F = WideView::Function;
  static constexpr base::Named<WideView> kKnown[] = {
      {"gnomonical", {F::kTangent, 1, 1}},   {"stereographic", {F::kTangent, 2, 2}},
      {"equidistant", {F::kIdentity, 1, 1}}, {"equisolid_angle", {F::kSine, 2, 2}},
      {"orthographic", {F::kSine, 1, 1}},    {"solid_angle", {F::kSine, 2, 2}},  // Gazebo Classic
  };
  if (const WideView* known = base::FindNamed(kKnown, type)) return *known;
  return base::Fail(base::ErrorCode::kInvalidArgument,
                    "there is no lens.type \"" + type +
                        "\": it is gnomonical, stereographic, equidistant, "
                        "equisolid_angle, orthographic or custom");
}

Lens::Lens(const CameraParameters& camera) : Lens(camera, IntrinsicsOf(camera), {}) {}

Lens::Lens(const CameraParameters& camera, const Intrinsics& intrinsics,
           const Distortion& distortion)
    : width_(camera.width),
      height_(camera.height),
      intrinsics_(intrinsics),
      distortion_(distortion) {
  const Intrinsics plain = IntrinsicsOf(camera);
  is_plain_ = distortion.is_none() && intrinsics.fx == plain.fx && intrinsics.fy == plain.fy &&
              intrinsics.cx == plain.cx && intrinsics.cy == plain.cy && intrinsics.skew == 0;
  centre_.y = (distortion.centre.y * height_ - intrinsics.cy) / intrinsics.fy;
  centre_.x =
      (distortion.centre.x * width_ - intrinsics.cx - intrinsics.skew * centre_.y) / intrinsics.fx;
}

base::Result<Lens> Lens::Wide(const CameraParameters& camera, WideView view,
                              double horizontal_fov) {
  Lens lens(camera);
  if (horizontal_fov > 0) {
    view.f = 1;
    const double edge = RadiusAt(view, 0.5 * horizontal_fov);
    const double little_less = RadiusAt(view, 0.499 * horizontal_fov);
    if (!(edge > 1e-6 && edge > little_less && edge < 1e3)) {
      return base::Fail(base::ErrorCode::kInvalidArgument,
                        "a lens of this type cannot span a horizontal_fov of " +
                            std::to_string(horizontal_fov) + " rad");
    }
    view.f = 1 / edge;
  }
  lens.wide_ = view;
  lens.is_plain_ = false;
  return lens;
}

Vector2 Lens::Distorted(const Vector2& p) const {
  const Distortion& d = distortion_;
  const double x = p.x - centre_.x, y = p.y - centre_.y, r2 = x * x + y * y;
  const double radial = 1 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
  return {centre_.x + x * radial + 2 * d.p1 * x * y + d.p2 * (r2 + 2 * x * x),
          centre_.y + y * radial + d.p1 * (r2 + 2 * y * y) + 2 * d.p2 * x * y};
}

std::optional<Vector2> Lens::Undistorted(const Vector2& p) const {
  if (distortion_.is_none()) return p;
  const Distortion& d = distortion_;
  // Several p can be distorted to the same point. The search starts at the centre and goes outwards
  // in kStations steps, so that it finds the solution nearest to the centre.
  Vector2 at = centre_;
  const Vector2 whole = p - centre_;
  constexpr int kStations = 4;
  for (int station = 1; station <= kStations; ++station) {
    const Vector2 goal = centre_ + (static_cast<double>(station) / kStations) * whole;
    double length = 1;
    for (int step = 0; step < kMaxSteps && length > kCloseEnough; ++step) {
      const double x = at.x - centre_.x, y = at.y - centre_.y, r2 = x * x + y * y;
      const double radial = 1 + r2 * (d.k1 + r2 * (d.k2 + r2 * d.k3));
      const double slope = 2 * (d.k1 + r2 * (2 * d.k2 + 3 * r2 * d.k3));
      const double xx = radial + x * x * slope + 2 * d.p1 * y + 6 * d.p2 * x;
      const double xy = x * y * slope + 2 * d.p1 * x + 2 * d.p2 * y;
      const double yy = radial + y * y * slope + 6 * d.p1 * y + 2 * d.p2 * x;
      const double determinant = xx * yy - xy * xy;
      // Where the determinant is not positive, points farther out are distorted to the same image
      // points again: the image is folded.
      if (!(determinant > 1e-9 && xx + yy > 0)) return std::nullopt;
      const Vector2 off = goal - Distorted(at);
      const Vector2 move{(yy * off.x - xy * off.y) / determinant,
                         (xx * off.y - xy * off.x) / determinant};
      at = at + move;
      length = std::hypot(move.x, move.y);
    }
    if (!(length <= kCloseEnough)) return std::nullopt;
  }
  return at;
}

std::optional<Vector3> Lens::RayAt(double u, double v) const {
  if (wide_) {
    const double x = (u - 0.5 * width_) / (0.5 * width_), y = (v - 0.5 * height_) / (0.5 * width_);
    const double r = std::hypot(x, y);
    if (r == 0) return Vector3{1, 0, 0};
    const double angle =
        wide_->c2 * (Invert(wide_->function, r / (wide_->c1 * wide_->f)) - wide_->c3);
    if (!(angle >= 0 && angle <= wide_->cutoff_angle)) return std::nullopt;
    const double sine = std::sin(angle) / r;
    return Vector3{std::cos(angle), -sine * x, -sine * y};
  }
  const double y = (v - intrinsics_.cy) / intrinsics_.fy;
  const double x = (u - intrinsics_.cx - intrinsics_.skew * y) / intrinsics_.fx;
  const auto at = Undistorted({x, y});
  if (!at) return std::nullopt;
  return geometry::Normalized(Vector3{1, -at->x, -at->y});
}

std::optional<Vector2> Lens::Project(const Vector3& point) const {
  if (wide_) {
    const double across = std::hypot(point.y, point.z);
    const double angle = std::atan2(across, point.x);
    if (!(angle <= wide_->cutoff_angle)) return std::nullopt;
    if (across == 0) return Vector2{0.5 * width_, 0.5 * height_};
    const double r = RadiusAt(*wide_, angle) / across * 0.5 * width_;
    return Vector2{0.5 * width_ - r * point.y, 0.5 * height_ - r * point.z};
  }
  if (!(point.x > 0)) return std::nullopt;
  const Vector2 p{-point.y / point.x, -point.z / point.x};
  const Vector2 at = Distorted(p);
  if (!distortion_.is_none()) {
    // If the image is folded (see Undistorted()), several points have the same image point. Only
    // the innermost one is shown.
    const auto back = Undistorted(at);
    if (!back || std::hypot(back->x - p.x, back->y - p.y) > 1e-6) return std::nullopt;
  }
  return Vector2{intrinsics_.fx * at.x + intrinsics_.skew * at.y + intrinsics_.cx,
                 intrinsics_.fy * at.y + intrinsics_.cy};
}

}  // namespace gsv::rendering
