// A recording as rosbag2 keeps it: a folder NAME with NAME_0.mcap and a metadata.yaml.
//
// Source  rosbag2_storage, bag metadata version 5 (ROS 2 Humble and later). The YAML is JSON, which
//         YAML 1.2 contains.
#pragma once

#include <string>

#include "gsv/base/error.h"

namespace gsv::recording {

// Creates the folder; gives the recording's file in it. Fails when something of that name is there.
base::Result<std::string> MakeBagFolder(const std::string& folder);

// Writes metadata.yaml beside a recording that is complete.
base::Status WriteBagMetadata(const std::string& file);

// The recording that a user means: the file itself, or the first (by name) in a folder.
std::string RecordingFile(const std::string& path);

}  // namespace gsv::recording
