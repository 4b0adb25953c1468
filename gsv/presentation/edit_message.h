// Converts edits to messages and back, for resimulation.
#pragma once

#include "gsv/base/error.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/simulation/edit.h"

namespace gsv::presentation {

messages::gsv_msgs::Edit EditMessage(const simulation::Edit& edit);

// Returns the edit in a message. Fails for an invalid edit, such as an unknown kind or a pose that
// is not finite.
base::Result<simulation::Edit> EditFrom(const messages::gsv_msgs::Edit& message);

}  // namespace gsv::presentation
