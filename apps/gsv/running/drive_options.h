// Applies --drive to a run.
#pragma once

#include <string>

#include "apps/gsv/running/run_options.h"
#include "gsv/base/error.h"
#include "gsv/formats/sdf_reader.h"

namespace gsv::app {

// Gives the scenario's robots the drives that --drive sets. If --drive names a model of the world,
// reads `world` into the specification, and the model becomes a robot. Returns kInvalidArgument if
// --drive names neither a robot nor a model of the world.
base::Status PrepareDrives(const std::string& world, formats::ModelLibrary& library,
                           RunOptions& options, base::Problems& problems);

}  // namespace gsv::app
