#include "gsv/formats/meshes/terrain_texture.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace gsv::formats {
namespace {

using Rgb = std::array<double, 3>;

constexpr double kGreyLevel = 128;
// A pixel of the result is the mean of at most kMaxSamples x kMaxSamples samples of a layer.
constexpr int kMaxSamples = 8;

// Interpolates the heights of a mesh whose vertices are a grid, row by row.
class GridHeights {
 public:
  explicit GridHeights(const geometry::TriangleMesh& mesh) : mesh_(mesh) {
    const auto& p = mesh.positions;
    while (columns_ < p.size() && p[columns_].y == p[0].y) ++columns_;
    rows_ = p.size() / columns_;
  }

  // Returns the height at (u, v): u from the left and v from the top, in [0, 1].
  double At(double u, double v) const {
    const double x = u * static_cast<double>(columns_ - 1);
    const double y = v * static_cast<double>(rows_ - 1);
    const auto x0 = static_cast<std::size_t>(x), y0 = static_cast<std::size_t>(y);
    const std::size_t x1 = std::min(x0 + 1, columns_ - 1), y1 = std::min(y0 + 1, rows_ - 1);
    const double a = x - static_cast<double>(x0), b = y - static_cast<double>(y0);
    const auto z = [&](std::size_t column, std::size_t row) {
      return mesh_.positions[row * columns_ + column].z;
    };
    return (1 - b) * ((1 - a) * z(x0, y0) + a * z(x1, y0)) +
           b * ((1 - a) * z(x0, y1) + a * z(x1, y1));
  }

 private:
  const geometry::TriangleMesh& mesh_;
  std::size_t columns_ = 1, rows_ = 1;
};

double Fraction(double value) { return value - std::floor(value); }

// Returns the colour at a point, in metres from the terrain's lower left corner.
Rgb PixelAt(const TerrainLayer& layer, double x, double y) {
  if (layer.image == nullptr) return {kGreyLevel, kGreyLevel, kGreyLevel};
  const model::Image& image = *layer.image;
  const auto index = [](double fraction, int count) {
    return static_cast<std::size_t>(std::min(static_cast<int>(fraction * count), count - 1));
  };
  const std::size_t column = index(Fraction(x / layer.tile), image.width);
  const std::size_t row = index(1 - Fraction(y / layer.tile), image.height);
  const std::uint8_t* pixel = &image.pixels[(row * static_cast<std::size_t>(image.width) + column) *
                                            static_cast<std::size_t>(image.channels)];
  return {static_cast<double>(pixel[0]), static_cast<double>(pixel[1]),
          static_cast<double>(pixel[2])};
}

// Returns the mean colour of a square about a point. Its side is in metres.
Rgb MeanAt(const TerrainLayer& layer, double x, double y, double side) {
  const double pixels =
      layer.image == nullptr ? 1 : side / layer.tile * static_cast<double>(layer.image->width);
  const int samples = std::clamp(static_cast<int>(std::lround(pixels)), 1, kMaxSamples);
  Rgb sum{};
  for (int i = 0; i < samples; ++i) {
    for (int j = 0; j < samples; ++j) {
      const auto offset = [&](int k) { return side * ((k + 0.5) / samples - 0.5); };
      const Rgb pixel = PixelAt(layer, x + offset(i), y + offset(j));
      for (std::size_t c = 0; c < 3; ++c) sum[c] += pixel[c];
    }
  }
  for (double& c : sum) c /= samples * samples;
  return sum;
}

// Returns the fraction of the surface that a layer covers at a height.
double CoverageAt(const TerrainLayer& layer, double height) {
  if (height < layer.min_height) return 0;
  if (!(layer.fade_distance > 0)) return 1;
  return std::min((height - layer.min_height) / layer.fade_distance, 1.0);
}

// Returns the side of the image in pixels: enough to keep each pixel of the tiles, up to the limit.
int SideFor(geometry::Vector2 size, const std::vector<TerrainLayer>& layers) {
  double side = 1;
  for (const TerrainLayer& layer : layers) {
    const double pixels =
        layer.image == nullptr ? 1 : std::max(layer.image->width, layer.image->height);
    side = std::max(side, std::max(size.x, size.y) / layer.tile * pixels);
  }
  return static_cast<int>(std::clamp(std::ceil(side), 64.0, double{kTerrainTextureSide}));
}

}  // namespace

model::Image TerrainTexture(const geometry::TriangleMesh& mesh, geometry::Vector2 size,
                            const std::vector<TerrainLayer>& layers) {
  const int side = SideFor(size, layers);
  const GridHeights heights(mesh);
  model::Image image{side, side, 3, {}, "terrain"};
  image.pixels.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side) * 3);
  const double pixel_side = std::max(size.x, size.y) / side;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const double u = (column + 0.5) / side, v = (row + 0.5) / side;
      const double x = u * size.x, y = (1 - v) * size.y;
      const double height = heights.At(u, v);
      Rgb colour = MeanAt(layers[0], x, y, pixel_side);
      for (std::size_t l = 1; l < layers.size(); ++l) {
        const double share = CoverageAt(layers[l], height);
        if (share == 0) continue;
        const Rgb over = MeanAt(layers[l], x, y, pixel_side);
        for (std::size_t c = 0; c < 3; ++c) colour[c] += share * (over[c] - colour[c]);
      }
      for (const double c : colour) {
        image.pixels.push_back(static_cast<std::uint8_t>(std::lround(std::clamp(c, 0.0, 255.0))));
      }
    }
  }
  return image;
}

}  // namespace gsv::formats
