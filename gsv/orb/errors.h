// Converts exceptions of the ORB and of GSV's IDL to errors, and errors to exceptions.
#pragma once

#include <type_traits>

#include <omniORB4/CORBA.h>

#include "gsv/base/error.h"
#include "idl/types.hh"

namespace gsv::orb {

// Returns the error for an exception of a remote call to the peer at `where`.
base::Error ToError(const CORBA::SystemException& exception, const std::string& where);
base::Error ToError(const CORBA::UserException& exception, const std::string& where);

// Returns why the last call got no TLS connection, or an empty text if TLS was not the reason.
// Call it once, on the thread that made the call.
std::string WhyNotConnected(const CORBA::SystemException& exception);
// Deletes the stored reason of an earlier failed connection, so that WhyNotConnected() describes
// the next call only. Call this before a remote call, on the same thread.
void ForgetConnectionFailure();

// Returns whether the exception proves that the peer has ended: its port refuses connections, or
// the object no longer exists. A time-out does not prove it.
bool MeansGone(const CORBA::SystemException& exception);

// Calls `call` and converts its exceptions to an error about `where`.
template <typename Function>
auto Call(const std::string& where, Function call) -> base::Result<decltype(call())> {
  ForgetConnectionFailure();
  try {
    if constexpr (std::is_void_v<decltype(call())>) {
      call();
      return {};
    } else {
      return call();
    }
  } catch (const CORBA::SystemException& exception) {
    return base::Fail(ToError(exception, where));
  } catch (const CORBA::UserException& exception) {
    return base::Fail(ToError(exception, where));
  }
}

// The exceptions that an IDL operation declares, as bits.
enum Raises : unsigned { kRefused = 1, kNotRunning = 2, kEnded = 4, kFailed = 8, kAll = 15 };

// Throws the declared exception that fits the error best.
[[noreturn]] void Throw(const base::Error& error, unsigned raises = kAll);

// Returns the value of `result`. If it is an error, throws the exception of Throw().
template <typename T>
T ValueOrThrow(base::Result<T> result, unsigned raises = kAll) {
  if (!result) Throw(result.error(), raises);
  if constexpr (!std::is_void_v<T>) return *std::move(result);
}

}  // namespace gsv::orb
