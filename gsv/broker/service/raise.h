// Throws the trader's errors as the exceptions of the standard.
#pragma once

#include "gsv/broker/offers/trading_error.h"

namespace gsv::broker {

// Throws the exception of CosTrading or CosTradingRepos that belongs to `error.refusal`. Throws
// CORBA::IMP_LIMIT for kLimit, and CORBA::PERSIST_STORE for kNotStored.
[[noreturn]] void Raise(const TradingError& error);

// Returns the value of `traded`, or throws its error with Raise().
template <typename T>
T ValueOrRaise(TradingResult<T> traded) {
  if (!traded) Raise(traded.error());
  return std::move(*traded);
}

inline void ValueOrRaise(const TradingResult<void>& traded) {
  if (!traded) Raise(traded.error());
}

}  // namespace gsv::broker
