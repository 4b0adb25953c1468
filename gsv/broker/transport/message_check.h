// Checks the messages of those operations of the trading service that need it, according to the
// IDL.
#pragma once

#include <string>
#include <string_view>

#include "gsv/orb/giop/message_check.h"

namespace gsv::broker {

// Generated from trading.idl.
const orb::Signatures& TradingSignatures();

// Calls orb::CheckRequest() with these signatures.
void CheckRequest(std::string& message);

// Whether `encapsulation` has a sequence of properties, or of policies.
bool IsPropertySequence(std::string_view encapsulation);

}  // namespace gsv::broker
