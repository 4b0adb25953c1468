// The loops over the pixels of an image, with vectors of eight or of sixteen pixels.
//
// Determinism  both give the same bits.
// Threads      one thread at a time.
#pragma once

#include <memory>
#include <span>

#include "gsv/rendering/raster/rasteriser.h"
#include "gsv/rendering/scene/frame_block.h"

namespace gsv::rendering::raster {

class SunShadow;

inline constexpr int kMaxLanes = 16;  // pixels of the longest vector
inline constexpr int kTileWidth = 32, kTileHeight = 16;

// An image that is being drawn.
struct ImageInProgress {
  int width = 0, height = 0;
  // Pixels in a row of `inverse_w` and `nearest`: at least width + kMaxLanes. Both have one row more
  // than the image, in which `nearest` is 0.
  int stride = 0;
  float* inverse_w = nullptr;  // 1/w of the nearest surface, by pixel
  std::uint32_t* nearest =
      nullptr;  // number of the nearest triangle, by pixel, from 1; 0 is the sky
  // The colours, `width` pixels in a row, with the number of the opaque surface as alpha. kMaxLanes
  // elements follow the last pixel.
  std::uint32_t* rgba = nullptr;
  std::uint8_t* is_blended =
      nullptr;  // by tile, row by row: whether a transparent item was blended
  // The ray through the centre of pixel (x, y) has the direction forward + x right + y down.
  Float4 forward, right, down;
  float nearest_inverse_w = 0;  // 1/w of the nearest surfaces that are drawn
};

// The visible triangles of an image. Element i of `triangles` is triangle number i + 1.
struct VisibleTriangles {
  std::span<const Triangle> triangles;
  std::span<const Drawn> drawn;  // the items; Triangle::drawn is an index in this list
};

// A part of an image: pixels [x0, x1) of rows [y0, y1), and a box around its visible points in the
// frame of FrustumOf().
struct TileToShade {
  int x0, y0, x1, y1;
  bool is_empty;  // whether no point is visible; the box is then not set
  geometry::Vector3 min, max;
};

// The loops over pixels. The members of `image` must stay valid and unchanged, except for what its
// pointers refer to, until the next call of Begin().
class PixelLoops {
 public:
  virtual ~PixelLoops() = default;
  virtual void Begin(const ImageInProgress& image) = 0;

  // Makes an opaque triangle the nearest one where nothing nearer is drawn yet. `id` is its number.
  // 1/w is multiplied by `back`. Returns false if it is hidden everywhere.
  virtual bool Cover(const Drawn& drawn, const Triangle& triangle, const Box& box,
                     bool crosses_near, std::uint32_t id, float back) = 0;

  // Begins the shading of an image. `block` must include the shadow parameters. If `shadow` is null,
  // there are no shadows. All arguments must stay valid until the last call of Shade() and Blend()
  // for this image.
  virtual void BeginShading(const VisibleTriangles& visible, const FrameBlock& block,
                            const SunShadow* shadow) = 0;
  // Returns the tile of pixels [x0, x1) of rows [y0, y1), with the box around its visible points.
  virtual TileToShade TileAt(int x0, int y0, int x1, int y1) const = 0;
  // Shades the opaque pixels of a tile.
  virtual void Shade(const TileToShade& tile) = 0;

  // Begins to blend a transparent item with a bounding sphere, in the frame of FrustumOf().
  virtual void BeginBlending(const Drawn& drawn, const geometry::Vector3& centre,
                             double radius) = 0;
  // Blends a triangle of the item.
  virtual void Blend(const Triangle& triangle, const Box& box) = 0;
};

// Whether the processor has the parts of AVX-512 that MakePixelLoops16() needs.
bool HasSixteenLanes();
std::unique_ptr<PixelLoops> MakePixelLoops8();
std::unique_ptr<PixelLoops> MakePixelLoops16();
// Returns the faster ones of those that this processor can execute.
std::unique_ptr<PixelLoops> MakePixelLoops();

}  // namespace gsv::rendering::raster
