// What a broker raises, as sentences.
#pragma once

#include <atomic>
#include <cstdint>
#include <string>

#include <omniORB4/CORBA.h>

#include "gsv/base/error.h"
#include "gsv/orb/errors.h"

namespace gsv::broker {

// For the exception that is being handled; call it in a catch block.
// `where` is the broker's address.
base::Error ErrorOfCurrentException(const std::string& where);

// Calls made by this process so far, and how many of them failed. Any thread.
struct CallCounts {
  std::atomic<std::uint64_t> made{0}, failed{0};
};
CallCounts& ProcessCallCounts();

// Runs `call` and turns what it throws into an error. Errors that it returns pass.
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

// As Guarded, for a call that may be made twice: an ORB learns that a broker was restarted only
// when it uses the old connection, which fails once.
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
