// Constants for the sanitizer that this program was compiled with.
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

// These sanitizers reserve terabytes of address space, so a limit on address space would make the
// program fail.
inline constexpr bool kReservesAddressSpace = kHasAddressSanitizer || kHasThreadSanitizer;

// The factor by which time limits are extended: sanitizers slow programs down by two to ten times.
// The build defines GSV_SANITIZED, because GCC 12 has no macro for UndefinedBehaviorSanitizer.
#if defined(GSV_SANITIZED)
inline constexpr int kSlowdown = 5;
#else
inline constexpr int kSlowdown = 1;
#endif

}  // namespace gsv::base
