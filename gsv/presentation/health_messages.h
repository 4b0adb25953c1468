// Converts the health of robots and the expectations of a run to messages.
#pragma once

#include "gsv/health/health.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/simulation/types.h"

namespace gsv::presentation {

// Makes the message. It lists only robots that do not move.
messages::gsv_msgs::Health HealthMessage(const health::Report& report);
// Returns true if `message` must be sent: if a count, or a robot's state, level, `since`, contact,
// limit_value or reason differs from `sent`, the message that was sent last.
bool NeedsSending(const messages::gsv_msgs::Health& message,
                  const messages::gsv_msgs::Health& sent);

messages::gsv_msgs::Expectations ExpectationsMessage(
    base::SimTime time, const std::vector<simulation::ExpectationState>& states);

}  // namespace gsv::presentation
