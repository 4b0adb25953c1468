// Loads lib/gsv/gsv-ros2.so, the plug-in that contains the DDS library.
#pragma once

#include <memory>
#include <string>

#include "gsv/ros2/dds/participant.h"

namespace gsv::ros2::dds {

// The version of the plug-in's interface. Increase it with each change of participant.h.
inline constexpr int kModuleInterface = 4;
// Name of the plug-in's function that returns its Module.
inline constexpr const char* kModuleSymbol = "gsv_ros2_module";
inline constexpr const char* kModuleFile = "gsv-ros2.so";

// The interface of a loaded plug-in.
struct Module {
  int interface_version = kModuleInterface;
  const char* library = "";  // such as "Fast DDS 2.9.1"
  // Makes a participant.
  base::Result<std::unique_ptr<Participant>> (*make)(const ParticipantOptions& options) = nullptr;
};

// Finds the plug-in in one of `folders`, without loading it. Fails with kUnavailable if no folder
// contains it.
base::Result<std::string> FindModule(const std::vector<std::string>& folders);

// Loads the plug-in from one of `folders`; the plug-in stays loaded. Fails with kUnavailable if no
// folder contains it.
base::Result<const Module*> LoadModule(const std::vector<std::string>& folders);

}  // namespace gsv::ros2::dds
