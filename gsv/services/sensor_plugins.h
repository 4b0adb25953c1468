// Sensor types in shared libraries, see sensing/module.h. A library that is loaded stays loaded,
// and is trusted: its faults are this process's.
//
// Threads  one, before the first simulation.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/sensing/registry.h"

namespace gsv::services {

// The libraries gsv-sensor-*.so in these folders, separated by colons; by folder, then by name.
// Folders that are not there hold none.
std::vector<std::filesystem::path> FindSensorPlugins(std::string_view folders);

// Adds the library's types. Fails when the file is no library, no sensor module, or built against
// another version of gsv, and when a type's name is taken.
base::Status LoadSensorPlugin(const std::filesystem::path& file, sensing::SensorRegistry& registry);

}  // namespace gsv::services
