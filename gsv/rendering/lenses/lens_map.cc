#include "gsv/rendering/lenses/lens_map.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace gsv::rendering {
namespace {

using geometry::Quaternion;
using geometry::Vector3;

// The tangent of the maximum angle from the view axis that one pinhole image covers (72 degrees).
constexpr double kMaxFaceAngle = 3;
constexpr double kMaxMagnification = 4;
// The width of the margin around all sampled positions, in pixels. So interpolation has
// neighbouring pixels on all sides.
constexpr double kMargin = 2;

using Rays = std::vector<std::optional<Vector3>>;

Rays RaysOf(const Lens& lens) {
  Rays rays;
  rays.reserve(static_cast<std::size_t>(lens.width()) * static_cast<std::size_t>(lens.height()));
  for (int y = 0; y < lens.height(); ++y) {
    for (int x = 0; x < lens.width(); ++x) rays.push_back(lens.RayAt(x + 0.5, y + 0.5));
  }
  return rays;
}

// Returns the resolution of the lens at an image point, in pixels per radian; 0 if the lens shows
// nothing there.
double DensityAt(const Lens& lens, double u, double v) {
  double most = 0;
  for (const bool across : {true, false}) {
    const auto a = lens.RayAt(across ? u - 0.5 : u, across ? v : v - 0.5);
    const auto b = lens.RayAt(across ? u + 0.5 : u, across ? v : v + 0.5);
    if (a && b) most = std::max(most, 1 / std::max(Norm(*b - *a), 1e-6));
  }
  return most;
}

// Returns the largest resolution of the lens. It is limited to a multiple of the resolution at the
// centre.
double DensityOf(const Lens& lens) {
  constexpr int kPlaces = 16;  // samples along each side of the image
  const double middle = DensityAt(lens, 0.5 * lens.width(), 0.5 * lens.height());
  double most = middle;
  for (int i = 0; i <= kPlaces; ++i) {
    for (int j = 0; j <= kPlaces; ++j) {
      most = std::max(most, DensityAt(lens, i * lens.width() / static_cast<double>(kPlaces),
                                      j * lens.height() / static_cast<double>(kPlaces)));
    }
  }
  if (middle > 0) most = std::min(most, kMaxMagnification * middle);
  return most > 0 ? most : 0.5 * lens.width();
}

double FovOf(double tangent) { return 2 * std::atan(tangent); }

// Returns the pinhole camera of a face. `right` and `up` are the tangents of half its horizontal
// and of half its vertical angle of view. `density` is in pixels per radian.
CameraParameters FaceOf(const CameraParameters& camera, double density, double right, double up) {
  CameraParameters face = camera;
  const double most = 0.5 * kMaxImageSide - kMargin;
  const double scale = std::min({density, most / right, most / up});
  face.width = 2 * static_cast<int>(std::ceil(scale * right + kMargin));
  face.height = 2 * static_cast<int>(std::ceil(scale * up + kMargin));
  face.horizontal_fov = FovOf(0.5 * face.width / scale);
  return face;
}

// The views of a cube's faces: forward, left, back, right, up, down.
const Quaternion kCube[] = {
    {1, 0, 0, 0},
    geometry::FromAxisAngle({0, 0, 1}, std::numbers::pi / 2),
    geometry::FromAxisAngle({0, 0, 1}, std::numbers::pi),
    geometry::FromAxisAngle({0, 0, 1}, -std::numbers::pi / 2),
    geometry::FromAxisAngle({0, 1, 0}, -std::numbers::pi / 2),
    geometry::FromAxisAngle({0, 1, 0}, std::numbers::pi / 2),
};

constexpr int kMaxMixedSamples = 4;  // the maximum number of samples along a side of a pixel

using Light = std::array<float, 3>;  // encoded values of three channels, from 0 to 255

// Interpolates the encoded values at (u, v) between the four nearest pixel centres.
Light LightAt(const model::Image& from, float u, float v) {
  const float x = std::clamp(u - 0.5f, 0.0f, static_cast<float>(from.width - 1));
  const float y = std::clamp(v - 0.5f, 0.0f, static_cast<float>(from.height - 1));
  const int left = std::min(static_cast<int>(x), from.width - 2);
  const int top = std::min(static_cast<int>(y), from.height - 2);
  const float a = x - static_cast<float>(left), b = y - static_cast<float>(top);
  const std::size_t row = 3 * static_cast<std::size_t>(from.width);
  const std::uint8_t* at =
      &from.pixels[static_cast<std::size_t>(top) * row + 3 * static_cast<std::size_t>(left)];
  Light light;
  for (std::size_t c = 0; c < 3; ++c) {
    const float upper = static_cast<float>(at[c]) * (1 - a) + static_cast<float>(at[c + 3]) * a;
    const float lower =
        static_cast<float>(at[row + c]) * (1 - a) + static_cast<float>(at[row + c + 3]) * a;
    light[c] = upper * (1 - b) + lower * b;
  }
  return light;
}

int CubeFaceOf(const Vector3& ray) {
  const double x = std::abs(ray.x), y = std::abs(ray.y), z = std::abs(ray.z);
  if (x >= y && x >= z) return ray.x > 0 ? 0 : 2;
  if (y >= z) return ray.y > 0 ? 1 : 3;
  return ray.z > 0 ? 4 : 5;
}

}  // namespace

LensMap::LensMap(const Lens& lens, const CameraParameters& camera)
    : width_(lens.width()), height_(lens.height()) {
  const Rays rays = RaysOf(lens);
  const double density = DensityOf(lens);
  double right = 1e-3, up = 1e-3;  // the tangents of the outermost rays
  for (const auto& ray : rays) {
    if (!ray) continue;
    const double x = std::max(ray->x, 1e-9);
    right = std::max(right, std::abs(ray->y) / x);
    up = std::max(up, std::abs(ray->z) / x);
  }
  const bool is_cube = right > kMaxFaceAngle || up > kMaxFaceAngle;
  if (!is_cube) faces_.push_back({{}, FaceOf(camera, density, right, up)});
  int place[6];  // the index in faces_ of each face of the cube, or -1
  std::fill(std::begin(place), std::end(place), -1);
  const auto face_for = [&](const Vector3& ray) {
    if (!is_cube) return 0;
    const int face = CubeFaceOf(ray);
    if (place[face] < 0) {
      place[face] = static_cast<int>(faces_.size());
      faces_.push_back({kCube[face], FaceOf(camera, density, 1, 1)});
    }
    return place[face];
  };
  sources_.reserve(rays.size());
  for (const auto& ray : rays) {
    Source source;
    if (ray) {
      source.face = face_for(*ray);
      const Face& face = faces_[static_cast<std::size_t>(source.face)];
      const Vector3 in_face = Inverse(face.camera_from_face) * *ray;
      const double f = FocalLength(face.camera);
      source.u = static_cast<float>(0.5 * face.camera.width - f * in_face.y / in_face.x);
      source.v = static_cast<float>(0.5 * face.camera.height - f * in_face.z / in_face.x);
      // Depth is sampled at the nearest pixel of the face. So the scale is computed for the ray
      // through the centre of that pixel, and not for the ray through (u, v).
      const Vector3 nearest{1, -(std::floor(source.u) + 0.5 - 0.5 * face.camera.width) / f,
                            -(std::floor(source.v) + 0.5 - 0.5 * face.camera.height) / f};
      source.depth_scale = static_cast<float>((face.camera_from_face * nearest).x);
    }
    sources_.push_back(source);
  }
  FindReach();
}

// Computes `reach`: the distance between the positions in the face from which a pixel and its
// neighbour in the row are sampled. It stays 1 if they are sampled from different faces.
void LensMap::FindReach() {
  for (std::size_t i = 0; i < sources_.size(); ++i) {
    Source& here = sources_[i];
    const bool is_last = (i + 1) % static_cast<std::size_t>(width_) == 0;
    if (width_ < 2 || here.face < 0) continue;
    const Source& next = sources_[is_last ? i - 1 : i + 1];
    if (next.face == here.face) here.reach = std::hypot(next.u - here.u, next.v - here.v);
  }
}

std::optional<Vector3> LensMap::RayOfPixel(std::size_t pixel) const {
  const Source& source = sources_[pixel];
  if (source.face < 0) return std::nullopt;
  const Face& face = faces_[static_cast<std::size_t>(source.face)];
  const double f = FocalLength(face.camera);
  return Normalized(face.camera_from_face * Vector3{f, 0.5 * face.camera.width - source.u,
                                                    0.5 * face.camera.height - source.v});
}

std::vector<CameraView> LensMap::Views(const geometry::Pose& world_from_camera) const {
  std::vector<CameraView> views;
  for (const Face& face : faces_) {
    views.push_back(
        {{world_from_camera.position, world_from_camera.orientation * face.camera_from_face},
         face.camera});
  }
  return views;
}

model::Image LensMap::Join(std::span<const std::shared_ptr<const model::Image>> images) const {
  model::Image joined{width_, height_, 3, {}, {}};
  joined.pixels.reserve(3 * sources_.size());
  for (const Source& source : sources_) {
    Light light{};
    if (source.face >= 0) {
      const model::Image& from = *images[static_cast<std::size_t>(source.face)];
      // A pixel gets about one sample for each face pixel that it covers, but at most
      // kMaxMixedSamples² samples.
      const int side = std::clamp(static_cast<int>(std::lround(source.reach)), 1, kMaxMixedSamples);
      for (int i = 0; i < side * side; ++i) {
        const auto off = [&](int k) {
          return ((static_cast<float>(k) + 0.5f) / static_cast<float>(side) - 0.5f) * source.reach;
        };
        const Light place = LightAt(from, source.u + off(i % side), source.v + off(i / side));
        for (std::size_t c = 0; c < 3; ++c) light[c] += place[c] / static_cast<float>(side * side);
      }
    }
    for (const float value : light) {
      joined.pixels.push_back(static_cast<std::uint8_t>(value + 0.5f));
    }
  }
  return joined;
}

GroundTruth LensMap::Join(std::span<const std::shared_ptr<const GroundTruth>> truths) const {
  GroundTruth joined{width_, height_, {}, {}, {}};
  joined.depth.reserve(sources_.size());
  joined.body.reserve(sources_.size());
  joined.visual.reserve(sources_.size());
  for (const Source& source : sources_) {
    if (source.face < 0) {
      joined.depth.push_back(std::numeric_limits<float>::infinity());
      joined.body.push_back(-1);
      joined.visual.push_back(-1);
      continue;
    }
    const GroundTruth& from = *truths[static_cast<std::size_t>(source.face)];
    const int x = std::clamp(static_cast<int>(source.u), 0, from.width - 1);
    const int y = std::clamp(static_cast<int>(source.v), 0, from.height - 1);
    const std::size_t at = static_cast<std::size_t>(y) * static_cast<std::size_t>(from.width) +
                           static_cast<std::size_t>(x);
    // The scale is negative behind the camera. The depth of the background remains +infinity there.
    const bool is_something = std::isfinite(from.depth[at]);
    joined.depth.push_back(is_something ? from.depth[at] * source.depth_scale : from.depth[at]);
    joined.body.push_back(from.body[at]);
    joined.visual.push_back(from.visual[at]);
  }
  return joined;
}

}  // namespace gsv::rendering
