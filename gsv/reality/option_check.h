// Checks the preset and the parameters of a comparison against the devices of the log.
#pragma once

#include "gsv/base/error.h"
#include "gsv/reality/comparison.h"

namespace gsv::reality {

// Whether the log has poses with headings, and motion that an odometer can be compared with.
bool HasOdometry(const Log& log);
// Whether the log has scans with poses.
bool HasScans(const Log& log);

// kInvalidArgument if no device of the log has the preset, or if none has one of the parameters.
base::Status CheckOptions(const Log& log, const CompareOptions& options);

}  // namespace gsv::reality
