// What --drive says, put into a run.
#pragma once

#include <string>

#include "apps/gsv/running/run_options.h"
#include "gsv/base/error.h"
#include "gsv/formats/sdf_reader.h"

namespace gsv::app {

// Puts what --drive says into the scenario's robots, and reads `world` into the specification when a
// model of the world is to be a robot. kInvalidArgument when there is no robot of a name.
base::Status PrepareDrives(const std::string& world, formats::ModelLibrary& library,
                           RunOptions& options, base::Problems& problems);

}  // namespace gsv::app
