// GSV_FOR_EACH_PROCESSOR, before a function, compiles the function twice: with and without AVX2.
// The dynamic loader selects the version that the processor supports.
#pragma once

#include "gsv/base/sanitizer.h"

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && !defined(GSV_SANITIZED)
#define GSV_FOR_EACH_PROCESSOR __attribute__((target_clones("avx2", "default")))
#else
#define GSV_FOR_EACH_PROCESSOR
#endif
