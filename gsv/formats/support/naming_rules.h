// Checks the XML of one file by SDFormat's rules on names and references.
//
// The reader repairs or leaves out elements that break the rules, with a warning, so that the world
// can run. A check of the file (ReadOptions::check_rules) still reports these elements as errors,
// because other programs refuse the file.
//
// Rules     links, collisions, visuals, joints, frames and models have names. Siblings in a model
//           or world have different names, of whatever kind they are. Names of the form __name__
//           are reserved. Joints, frames, poses and canonical links refer to existing names, not to
//           themselves and not in cycles. A model has a link.
//           http://sdformat.org/tutorials?tut=pose_frame_semantics
// Includes  are not read: a name that they may define counts as defined.
#pragma once

#include "gsv/base/error.h"
#include "gsv/formats/support/element_audit.h"

namespace gsv::formats {

// Adds an error for each broken rule, at most kMaxFindings. Adds none for URDF.
void CheckNamingRules(const AuditedFile& file, base::Problems& problems);

}  // namespace gsv::formats
