// Makes std::timed_mutex work with ThreadSanitizer of GCC 12, in programs that are built with it.
#include <pthread.h>
#include <time.h>

namespace {

constexpr long kSecond = 1'000'000'000;  // ns

timespec Now(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return now;
}

}  // namespace

// Replaces the function of the C library that std::timed_mutex calls. ThreadSanitizer of GCC 12
// does not intercept that function, but it intercepts pthread_mutex_timedlock(), which is called
// here.
extern "C" int pthread_mutex_clocklock(pthread_mutex_t* mutex, clockid_t clock,
                                       const timespec* until) {
  const timespec here = Now(clock);
  timespec real = Now(CLOCK_REALTIME);
  const long ns = real.tv_nsec + until->tv_nsec - here.tv_nsec;  // more than -1 s, less than 2 s
  real.tv_sec += until->tv_sec - here.tv_sec + (ns < 0 ? -1 : ns / kSecond);
  real.tv_nsec = (ns + kSecond) % kSecond;
  return pthread_mutex_timedlock(mutex, &real);
}
