// Converts the health of robots and the expectations of a run to messages.
#pragma once

#include "gsv/health/health.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/simulation/types.h"

namespace gsv::presentation {

// Makes the message. It lists only robots that do not move.
messages::gsv_msgs::Health HealthMessage(const health::Report& report);
// Returns true if `message` must be sent: if it differs from `sent`, the message that was sent
// last, in more than the time and the actual motion.
bool NeedsSending(const messages::gsv_msgs::Health& message,
                  const messages::gsv_msgs::Health& sent);

messages::gsv_msgs::Expectations ExpectationsMessage(
    base::SimTime time, const std::vector<simulation::ExpectationState>& states);

}  // namespace gsv::presentation
