// Converts the exceptions of a broker to errors with a sentence.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include <omniORB4/CORBA.h>

#include "gsv/base/error.h"
#include "gsv/orb/errors.h"

namespace gsv::broker {

// Returns the error for the exception that is being handled. Call it in a catch block. `where` is
// the broker's address.
base::Error ErrorOfCurrentException(const std::string& where);

// Counts the calls to brokers that this process makes through Guarded() and GuardedRepeatable().
// Other calls are not counted.
//
// Threads  any.
struct CallCounts {
  // The number of calls, and the number of calls that threw an exception of CORBA. `made` includes
  // the failed calls. A call that GuardedRepeatable() repeats adds 2 to `made`.
  std::atomic<std::uint64_t> made{0}, failed{0};
};
// Returns the counts of this process.
CallCounts& ProcessCallCounts();

// Calls `call` and converts an exception to an error. Returns the errors of `call` unchanged.
template <typename Call>
auto Guarded(const std::string& where, const Call& call) -> decltype(call()) {
  ++ProcessCallCounts().made;
  orb::ForgetConnectionFailure();
  try {
    return call();
  } catch (const CORBA::Exception&) {
    return base::Fail(ErrorOfCurrentException(where));
  }
}

// Like Guarded(), but repeats the call once if it fails with a lost connection. After a restart of
// the broker, the first call over the old connection fails. `call` must be safe to repeat.
template <typename Call>
auto GuardedRepeatable(const std::string& where, const Call& call) -> decltype(call()) {
  ++ProcessCallCounts().made;
  orb::ForgetConnectionFailure();
  try {
    return call();
  } catch (const CORBA::COMM_FAILURE&) {
    return Guarded(where, call);
  } catch (const CORBA::Exception&) {
    return base::Fail(ErrorOfCurrentException(where));
  }
}

}  // namespace gsv::broker
