// Applies --drive to a run.
#pragma once

#include <string>

#include "apps/gsv/running/run_options.h"
#include "gsv/base/error.h"
#include "gsv/formats/sdf_reader.h"

namespace gsv::app {

// Sets the drives of --drive in the scenario's robots. If --drive names a model of the world, reads
// `world` into the specification, and the model becomes a robot. Returns kInvalidArgument if there
// is no robot with a given name.
base::Status PrepareDrives(const std::string& world, formats::ModelLibrary& library,
                           RunOptions& options, base::Problems& problems);

}  // namespace gsv::app
