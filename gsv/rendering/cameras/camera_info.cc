#include "gsv/rendering/cameras/camera_info.h"

#include <cmath>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/sensing/encoding.h"
#include "gsv/sensing/frames.h"

namespace gsv::rendering {
namespace {

// tolerance for the position of the axis, as a fraction of the image's width
constexpr double kSamePlace = 1e-9;

bool IsAboutThePrincipalPoint(const Lens& lens) {
  const geometry::Vector2& centre = lens.distortion().centre;
  const Intrinsics& in = lens.intrinsics();
  return std::abs(centre.x * lens.width() - in.cx) <= kSamePlace * lens.width() &&
         std::abs(centre.y * lens.height() - in.cy) <= kSamePlace * lens.width();
}

messages::sensor_msgs::CameraInfo InfoOf(const Lens& lens) {
  const LensModel model = LensModelOf(lens);
  const Intrinsics& in = model.intrinsics;
  messages::sensor_msgs::CameraInfo info;
  info.width = static_cast<std::uint32_t>(lens.width());
  info.height = static_cast<std::uint32_t>(lens.height());
  info.distortion_model = model.name;
  info.d = model.coefficients;
  info.r = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  if (model.name.empty()) return info;
  info.k = {in.fx, in.skew, in.cx, 0, in.fy, in.cy, 0, 0, 1};
  info.p = {in.fx, in.skew, in.cx, 0, 0, in.fy, in.cy, 0, 0, 0, 1, 0};
  return info;
}

}  // namespace

LensModel LensModelOf(const Lens& lens) {
  if (const auto& wide = lens.wide_view()) {
    if (wide->function != WideView::Function::kIdentity || wide->c3 != 0) return {};
    const double f = 0.5 * lens.width() * wide->c1 * wide->f / wide->c2;
    return {"equidistant", {0, 0, 0, 0}, {f, f, 0.5 * lens.width(), 0.5 * lens.height(), 0}};
  }
  const Distortion& d = lens.distortion();
  if (!d.is_none() && !IsAboutThePrincipalPoint(lens)) return {};
  return {"plumb_bob", {d.k1, d.k2, d.p1, d.p2, d.k3}, lens.intrinsics()};
}

sensing::Companion CameraInfoCompanion() {
  return {"camera_info", &messages::SchemaOf<messages::sensor_msgs::CameraInfo>()};
}

sensing::Sensor::Bytes EncodeCameraInfo(const Lens& lens, base::SimTime time,
                                        const std::string& frame_id) {
  auto info = InfoOf(lens);
  info.header = sensing::HeaderOf(time, sensing::FrameOf(frame_id, sensing::kOpticalFrame));
  return sensing::Encoded(info);
}

}  // namespace gsv::rendering
