#include <emmintrin.h>

#include <gtest/gtest.h>

namespace gsv {
namespace {

// Tests are compiled without optimisation. If the precompiled header defines __OPTIMIZE__ all the
// same (see cmake/precompiled_library.h), the preset dev does not compile, because <emmintrin.h>
// then defines functions instead of macros.
TEST(PrecompiledHeader, DoesNotDefineThatCodeIsOptimised) {
#ifdef __OPTIMIZE__
  FAIL() << "__OPTIMIZE__ is defined";
#endif
  const __m128i shifted = _mm_slli_si128(_mm_set1_epi8(1), 15);
  EXPECT_EQ(_mm_movemask_epi8(_mm_cmpeq_epi8(shifted, _mm_setzero_si128())), 0x7fff);
}

}  // namespace
}  // namespace gsv
