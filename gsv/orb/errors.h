// The one place where the ORB's and our IDL's exceptions become errors, and errors exceptions.
#pragma once

#include <type_traits>

#include <omniORB4/CORBA.h>

#include "gsv/base/error.h"
#include "idl/types.hh"

namespace gsv::orb {

// What a remote call's exception means, as a sentence about the peer at `where`.
base::Error ToError(const CORBA::SystemException& exception, const std::string& where);
base::Error ToError(const CORBA::UserException& exception, const std::string& where);

// Why this process and the peer cannot connect if certificates are the reason, as a sentence about
// the peer; else empty. To be asked once, by the thread that has called.
std::string WhyNotConnected(const CORBA::SystemException& exception);
// To be called before a call, by the same thread: reasons from before are another call's.
void ForgetConnectionFailure();

// Whether the exception says that the peer is certainly gone: its port refuses connections, or the
// object no longer exists there. A time-out does not say so.
bool MeansGone(const CORBA::SystemException& exception);

// Calls `call` and turns what it throws into an error about `where`.
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

// The exceptions that an operation declares.
enum Raises : unsigned { kRefused = 1, kNotRunning = 2, kEnded = 4, kFailed = 8, kAll = 15 };

// Throws the exception of our IDL that fits the error best among those that are declared.
[[noreturn]] void Throw(const base::Error& error, unsigned raises = kAll);

template <typename T>
T ValueOrThrow(base::Result<T> result, unsigned raises = kAll) {
  if (!result) Throw(result.error(), raises);
  if constexpr (!std::is_void_v<T>) return *std::move(result);
}

}  // namespace gsv::orb
