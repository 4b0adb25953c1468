// GSV_FOR_EACH_PROCESSOR before a function: it is compiled for processors with and without AVX2, and
// the loader chooses the version for the processor it finds. Sanitizers cannot start before it does.
// Both versions give the same bits, since nothing is contracted or reassociated.
#pragma once

#include "gsv/base/sanitizer.h"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(GSV_SANITIZED)
#define GSV_FOR_EACH_PROCESSOR __attribute__((target_clones("avx2", "default")))
#else
#define GSV_FOR_EACH_PROCESSOR
#endif
