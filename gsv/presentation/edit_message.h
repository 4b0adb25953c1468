// Edits as messages, and back: a run is made once more by them.
#pragma once

#include "gsv/base/error.h"
#include "gsv/messages/gsv_msgs.h"
#include "gsv/simulation/edit.h"

namespace gsv::presentation {

messages::gsv_msgs::Edit EditMessage(const simulation::Edit& edit);

// The edit that a message tells of. Fails when nobody can have made it: a kind that is none, a pose
// that is not finite.
base::Result<simulation::Edit> EditFrom(const messages::gsv_msgs::Edit& message);

}  // namespace gsv::presentation
