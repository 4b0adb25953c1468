#include "gsv/broker/transport/message_check.h"

namespace gsv::broker {

void CheckRequest(std::string& message) { orb::CheckRequest(TradingSignatures(), message); }

bool IsPropertySequence(std::string_view encapsulation) {
  return orb::HasTypes(encapsulation, "[sa]");
}

}  // namespace gsv::broker
