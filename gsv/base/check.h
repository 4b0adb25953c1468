// GSV_CHECK: a condition that only a bug can break. It is always on, and aborts with a message.
#pragma once

#include <cstdio>
#include <cstdlib>

#define GSV_CHECK(condition)                                                             \
  do {                                                                                   \
    if (!(condition)) {                                                                  \
      std::fprintf(stderr, "%s:%d: check failed: %s\n", __FILE__, __LINE__, #condition); \
      std::abort();                                                                      \
    }                                                                                    \
  } while (false)
