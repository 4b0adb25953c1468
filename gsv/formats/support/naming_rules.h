// SDFormat's rules of names and references, checked in the XML of one file.
//
// The reader repairs or leaves out what breaks them, with a warning, so that the rest can run. A
// check of the file calls it invalid all the same: other programs refuse it.
//
// Rules     links, collisions, visuals, joints, frames and models have names; those beside each
//           other in a model or world differ, of whatever kind; names of the form __name__ are
//           reserved. Joints, frames, poses and canonical links refer to names that are there, not
//           to themselves and not in circles. A model has a link.
//           http://sdformat.org/tutorials?tut=pose_frame_semantics
// Includes  what they bring is not looked at: a name that they may bring is taken for there.
#pragma once

#include "gsv/base/error.h"
#include "gsv/formats/support/element_audit.h"

namespace gsv::formats {

// Adds an error for each broken rule, at most kMostFindings. Says nothing of URDF.
void CheckNamingRules(const AuditedFile& file, base::Problems& problems);

}  // namespace gsv::formats
