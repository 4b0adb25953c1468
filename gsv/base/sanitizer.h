// Which sanitizer the program was compiled with, for the few who must know.
#pragma once

namespace gsv::base {

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kHasAddressSanitizer = true;
#else
inline constexpr bool kHasAddressSanitizer = false;
#endif

#if defined(__SANITIZE_THREAD__)
inline constexpr bool kHasThreadSanitizer = true;
#else
inline constexpr bool kHasThreadSanitizer = false;
#endif

// They reserve terabytes of addresses, and use little of them: a bound on addresses cannot hold.
inline constexpr bool kReservesAddressSpace = kHasAddressSanitizer || kHasThreadSanitizer;

// How much longer than usual to wait for a program: it takes two to ten times as long. (GCC 12 does
// not say that UndefinedBehaviorSanitizer is there, so the build does.)
#if defined(GSV_SANITIZED)
inline constexpr int kSlowdown = 5;
#else
inline constexpr int kSlowdown = 1;
#endif

}  // namespace gsv::base
