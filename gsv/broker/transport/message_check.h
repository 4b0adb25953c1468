// Checks the messages of the Trading Service before omniORB reads them. Only operations that pass
// an `any` or a TypeCode are checked (orb/giop/message_check.h). trading.idl defines their types.
#pragma once

#include <string>
#include <string_view>

#include "gsv/orb/giop/message_check.h"

namespace gsv::broker {

// Generated from trading.idl.
const orb::Signatures& TradingSignatures();

// Calls orb::CheckRequest() with the signatures of the operations in trading.idl.
void CheckRequest(std::string& message);

// Whether `encapsulation` contains a sequence of properties, or of policies.
bool IsPropertySequence(std::string_view encapsulation);

}  // namespace gsv::broker
