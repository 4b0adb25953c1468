// Checks the preset and the parameters of a comparison against the devices of the log.
#pragma once

#include "gsv/base/error.h"
#include "gsv/reality/comparison.h"

namespace gsv::reality {

// Whether the log contains poses with headings, and motion data that an odometer can be compared
// with.
bool HasOdometry(const Log& log);
// Whether the log contains scans with poses.
bool HasScans(const Log& log);

// Fails with kInvalidArgument if the preset fits no device of the log, or if no device has one of
// the parameters.
base::Status CheckOptions(const Log& log, const CompareOptions& options);

}  // namespace gsv::reality
