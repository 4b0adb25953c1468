// This source is compiled with AVX2. It is called only if CanRasterise() returns true.
#include "gsv/rendering/raster/vector_pixel_loops.h"

namespace gsv::rendering::raster {

std::unique_ptr<PixelLoops> MakePixelLoops8() { return std::make_unique<VectorPixelLoops<F8>>(); }

}  // namespace gsv::rendering::raster
