// Loads sensor types from shared libraries, see sensing/module.h. A library stays loaded and is
// trusted: a fault in it affects this process.
//
// Threads  one, before the first simulation.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/sensing/registry.h"

namespace gsv::services {

// Returns the libraries gsv-sensor-*.so in these folders, which are separated by colons, ordered by
// folder and then by name. Missing folders are ignored.
std::vector<std::filesystem::path> FindSensorPlugins(std::string_view folders);

// Adds the library's types. Fails if the file is not a library, not a sensor module, or built for
// another version of gsv, or if a type's name is taken.
base::Status LoadSensorPlugin(const std::filesystem::path& file, sensing::SensorRegistry& registry);

}  // namespace gsv::services
