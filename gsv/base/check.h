// GSV_CHECK aborts with a message if its condition is false. It reports bugs, and is active in
// every build.
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
