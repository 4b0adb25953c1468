// Computes the pixels that the triangles of an item cover, and their depths.
//
// Method   edge functions divided by depth (Olano and Greer, 1997). For each corner i of a
//          triangle, q_i = (weight of the corner) / w is a linear function of the pixel position,
//          where w is the distance along the view. The triangle covers the pixels where no q_i is
//          negative. The sum of all q_i is 1/w. Triangles that reach behind the camera need no
//          clipping.
// Threads  one thread at a time.
#pragma once

#include <vector>

#include "gsv/rendering/raster/raster_mesh.h"
#include "gsv/rendering/raster/simd.h"
#include "gsv/rendering/raster/triangle.h"
#include "gsv/rendering/scene/frame_block.h"
#include "gsv/rendering/scene/render_list.h"

namespace gsv::rendering::raster {

// A mesh to draw in the view of one camera.
struct Drawn {
  const RasterMesh* mesh = nullptr;
  const Level* level = nullptr;
  const DrawGroup* group = nullptr;
  const SurfaceFactors* factors = nullptr;  // colours and roughness of the item's material
  float rows[3][4];                         // relative_from_mesh
  // The columns of the matrix that transforms the mesh's normals, which then do not have unit length.
  // Elements 3 to 5 of each are the column, and the others are 0.
  float normal[3][8];
};

// Returns an item of a render list at this level of detail. `origin` is the camera's position.
Drawn DrawnItem(const RenderList& render_list, std::size_t item, const Level& level,
                const geometry::Vector3& origin);

// Finds the triangles of an item that may cover pixels.
class Rasteriser {
 public:
  enum class Rows { kDownwards, kUpwards };
  // Sets the mapping from the frame of FrustumOf() to pixels. w is 1 for orthographic views.
  void Begin(int width, int height, double near, const std::array<float, 16>& clip_from_relative,
             Rows rows);

  // Calls visit(triangle, box, crosses_near) for each triangle that faces the camera and may cover
  // a pixel.
  template <class Visit>
  void ForEachTriangle(const Drawn& drawn, std::uint32_t number, bool both_sides, Visit&& visit) {
    Project(drawn);
    for (std::uint32_t t = 0; t < drawn.level->triangle_count; t += 8) {
      int crossing = 0;
      for (int kept = SetUp(drawn, number, t, both_sides, crossing); kept != 0; kept &= kept - 1) {
        const int lane = __builtin_ctz(static_cast<unsigned>(kept));
        visit(triangles_[lane], boxes_[lane], false);
      }
      for (; crossing != 0; crossing &= crossing - 1) {
        const int lane = __builtin_ctz(static_cast<unsigned>(crossing));
        Triangle triangle;
        if (SetUpCrossing(drawn, number, t + static_cast<std::uint32_t>(lane), both_sides,
                          triangle)) {
          visit(triangle, Box{0, 0, width_ - 1, height_ - 1}, true);
        }
      }
    }
  }

 private:
  // Projects all vertices of the mesh.
  void Project(const Drawn& drawn);
  // Sets up eight triangles from `first` on. Returns the mask of those that may cover a pixel.
  // `crossing` becomes the mask of those that cross the near plane.
  int SetUp(const Drawn& drawn, std::uint32_t number, std::uint32_t first, bool both_sides,
            int& crossing);
  // Sets up a triangle that crosses the near plane. Returns false if it covers no pixel.
  bool SetUpCrossing(const Drawn& drawn, std::uint32_t number, std::uint32_t index, bool both_sides,
                     Triangle& triangle) const;

  int width_ = 0, height_ = 0;
  float near_ = 0;  // surfaces nearer to the camera are not drawn, m
  bool rows_upwards_ = false;
  // Maps the frame of FrustumOf() to homogeneous pixel coordinates (x w, y w, w)
  float to_pixels_[3][4];
  float from_mesh_[3][4];  // the same mapping from the current item's mesh
  // inverse_w_ is 1/w, or 0 for vertices nearer than the near plane
  std::vector<float> x_, y_, inverse_w_;
  Triangle triangles_[8];
  Box boxes_[8];
};

}  // namespace gsv::rendering::raster
