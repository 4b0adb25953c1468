#include "gsv/sensing/surroundings.h"

namespace gsv::sensing {
namespace {

// Single precision errs by 6e-8 of a coordinate, and the gap between ray and centre takes a dozen
// operations.
constexpr double kRounding = 4e-6;

}  // namespace

void Surroundings::Add(const geometry::Vector3& centre, double radius, std::uint32_t number) {
  if (count_ == kMost) {
    is_overfull_ = true;
    return;
  }
  if (count_ % 4 == 0) {
    for (std::size_t i = count_; i < count_ + 4; ++i) {
      x_[i] = y_[i] = z_[i] = 0;
      squared_radius_[i] = -1;
    }
  }
  const geometry::Vector3 from_place = centre - place_;
  const double grown = radius + kRounding * (Norm(from_place) + radius + reach_);
  x_[count_] = static_cast<float>(from_place.x);
  y_[count_] = static_cast<float>(from_place.y);
  z_[count_] = static_cast<float>(from_place.z);
  squared_radius_[count_] = static_cast<float>(grown * grown);
  numbers_[count_++] = number;
}

}  // namespace gsv::sensing
