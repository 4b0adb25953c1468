// Turns the exceptions of a broker into errors with a sentence.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include <omniORB4/CORBA.h>

#include "gsv/base/error.h"
#include "gsv/orb/errors.h"

namespace gsv::broker {

// The error for the exception that is being handled. Call it in a catch block.
// `where` is the broker's address.
base::Error ErrorOfCurrentException(const std::string& where);

// Calls made by this process so far, and how many of them failed. Any thread.
struct CallCounts {
  std::atomic<std::uint64_t> made{0}, failed{0};
};
CallCounts& ProcessCallCounts();

// Runs `call` and turns an exception into an error. Returns the errors of `call` unchanged.
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

// The same for a call that may be repeated. After a restart of the broker, the first call over the
// old connection fails, so that it is made again.
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
