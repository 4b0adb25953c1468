// This source is compiled with AVX-512. It is called only if HasSixteenLanes() returns true.
#include "gsv/rendering/raster/vector_pixel_loops.h"

namespace gsv::rendering::raster {

std::unique_ptr<PixelLoops> MakePixelLoops16() { return std::make_unique<VectorPixelLoops<F16>>(); }

}  // namespace gsv::rendering::raster
