// Compiles the function behind
// GSV_FOR_EACH_PROCESSOR with and without AVX2; the
// loader chooses.
#pragma once

#include "gsv/base/sanitizer.h"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(GSV_SANITIZED)
#define GSV_FOR_EACH_PROCESSOR __attribute__((target_clones("avx2", "default")))
#else
#define GSV_FOR_EACH_PROCESSOR
#endif
