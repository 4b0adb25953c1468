// Checks the messages of the trading service's operations that need it, according to its IDL.
#pragma once

#include <string>
#include <string_view>

#include "gsv/orb/giop/message_check.h"

namespace gsv::broker {

// Generated from trading.idl.
const orb::Signatures& TradingSignatures();

// Calls orb::CheckRequest() with them.
void CheckRequest(std::string& message);

// Whether `encapsulation` holds a sequence of properties, or of policies.
bool IsPropertySequence(std::string_view encapsulation);

}  // namespace gsv::broker
