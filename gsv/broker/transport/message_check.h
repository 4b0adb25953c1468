// Which of the trading service's operations need a check of their messages, as its IDL says.
#pragma once

#include <string>
#include <string_view>

#include "gsv/orb/giop/message_check.h"

namespace gsv::broker {

// Made from trading.idl.
const orb::Signatures& TradingSignatures();

// orb::CheckRequest() with them.
void CheckRequest(std::string& message);

// Whether `encapsulation` is one of a sequence of properties, or policies.
bool IsPropertySequence(std::string_view encapsulation);

}  // namespace gsv::broker
