#include "gsv/rendering/raster/pixel_loops.h"

namespace gsv::rendering::raster {

bool HasSixteenLanes() {
  return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vl");
}

std::unique_ptr<PixelLoops> MakePixelLoops() {
  return HasSixteenLanes() ? MakePixelLoops16() : MakePixelLoops8();
}

}  // namespace gsv::rendering::raster
