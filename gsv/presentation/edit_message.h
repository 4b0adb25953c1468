// Converts edits to messages and messages to edits, for recording and resimulation.
#pragma once

#include "gsv/base/error.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/simulation/edit.h"

namespace gsv::presentation {

messages::gsv_msgs::Edit EditMessage(const simulation::Edit& edit);

// Returns the edit that a message describes. Fails if the message is invalid, for example because
// of an unknown kind or a pose that is not finite.
base::Result<simulation::Edit> EditFrom(const messages::gsv_msgs::Edit& message);

}  // namespace gsv::presentation
