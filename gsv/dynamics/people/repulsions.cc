// Implements Repulsions. This file is compiled without errno and floating-point traps, so that the
// compiler vectorises loops with square roots and divisions. The results are the same.
#include "gsv/dynamics/people/repulsions.h"

#include <cmath>

#include "gsv/base/each_processor.h"
#include "gsv/dynamics/people/social_force_constants.h"

namespace gsv::dynamics {
namespace {

using geometry::Vector2;

// Computes Apart(), and the part of RepulsionByOther() before its exponential.
GSV_FOR_EACH_PROCESSOR
void FindEllipses(std::size_t count, double* __restrict x, double* __restrict y,
                  const double* __restrict radii, const double* __restrict velocity_x,
                  const double* __restrict velocity_y, double* __restrict direction_x,
                  double* __restrict direction_y, double* __restrict sum_of,
                  double* __restrict b_of, double* __restrict exponent) {
  for (std::size_t i = 0; i < count; ++i) {
    const double length = std::sqrt(x[i] * x[i] + y[i] * y[i]);
    const double thicker = radii[i] - 2 * kPaperRadius;
    const double shorter = length - thicker;
    const double wanted = kClosest < shorter ? shorter : kClosest;
    const double scale = wanted / length;
    const double apart_x = length > 0 ? scale * x[i] : wanted;
    const double apart_y = length > 0 ? scale * y[i] : 0;

    const double stride_x = kStride * velocity_x[i], stride_y = kStride * velocity_y[i];
    const double beyond_x = apart_x - stride_x, beyond_y = apart_y - stride_y;
    const double near = std::sqrt(apart_x * apart_x + apart_y * apart_y);
    const double far = std::sqrt(beyond_x * beyond_x + beyond_y * beyond_y);
    const double step = std::sqrt(stride_x * stride_x + stride_y * stride_y);
    const double sum = near + far;
    const double square = sum * sum - step * step;
    const double b = 0.5 * std::sqrt(square < kMinSquare ? kMinSquare : square);
    const double per_near = 1 / near, per_far = 1 / far;
    const double ahead_x = per_near * apart_x, ahead_y = per_near * apart_y;
    const double both_x = ahead_x + per_far * beyond_x, both_y = ahead_y + per_far * beyond_y;
    direction_x[i] = far > kNoLength ? both_x : ahead_x;
    direction_y[i] = far > kNoLength ? both_y : ahead_y;
    sum_of[i] = sum;
    b_of[i] = b;
    exponent[i] = -b / kOtherRange;
  }
}

// Computes the part of RepulsionByOther() after its exponential, and AsSeen(). The forces replace
// the directions.
GSV_FOR_EACH_PROCESSOR
void FindForces(std::size_t count, const double* __restrict power, const double* __restrict sum,
                const double* __restrict b, const double* __restrict wanted_x,
                const double* __restrict wanted_y, double cosine, double sine, double sight,
                double* __restrict x, double* __restrict y) {
  for (std::size_t i = 0; i < count; ++i) {
    const double strength = kOtherStrength / kOtherRange * power[i] * sum[i] / (4 * b[i]);
    const double straight_x = strength * x[i], straight_y = strength * y[i];
    const double force_x = cosine * straight_x - sine * straight_y;
    const double force_y = sine * straight_x + cosine * straight_y;
    const double ahead = -(force_x * wanted_x[i] + force_y * wanted_y[i]);
    const double length = std::sqrt(force_x * force_x + force_y * force_y);
    const bool is_seen = ahead >= sight * length;
    x[i] = is_seen ? force_x : kUnseen * force_x;
    y[i] = is_seen ? force_y : kUnseen * force_y;
  }
}

}  // namespace

void Repulsions::Finish(std::span<Vector2> forces) {
  FindEllipses(count_, x_.data(), y_.data(), radii_.data(), velocity_x_.data(), velocity_y_.data(),
               direction_x_.data(), direction_y_.data(), sum_.data(), b_.data(), exponent_.data());
  for (std::size_t i = 0; i < count_; ++i) exponent_[i] = std::exp(exponent_[i]);
  static const double cosine = std::cos(kAside), sine = std::sin(kAside);
  static const double sight = std::cos(kHalfSight);
  FindForces(count_, exponent_.data(), sum_.data(), b_.data(), wanted_x_.data(), wanted_y_.data(),
             cosine, sine, sight, direction_x_.data(), direction_y_.data());
  for (std::size_t i = 0; i < count_; ++i) {
    Vector2& force = forces[walker_[i]];
    force = force + Vector2{direction_x_[i], direction_y_[i]};
  }
  count_ = 0;
}

}  // namespace gsv::dynamics
