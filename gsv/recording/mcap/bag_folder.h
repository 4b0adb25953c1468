// Makes recordings in the format of rosbag2: a folder NAME with the files NAME_0.mcap and
// metadata.yaml.
//
// Source  rosbag2_storage, bag metadata version 5 (ROS 2 Humble and later). The file is written as
//         JSON, which is valid YAML 1.2.
#pragma once

#include <string>

#include "gsv/base/error.h"

namespace gsv::recording {

// Creates the folder and returns the path of the recording in it. Fails if the folder exists.
base::Result<std::string> MakeBagFolder(const std::string& folder);

// Writes metadata.yaml beside a complete recording.
base::Status WriteBagMetadata(const std::string& file);

// Returns the file of the recording at `path`: the file itself, or the first .mcap file (by name)
// of a folder.
std::string RecordingFile(const std::string& path);

}  // namespace gsv::recording
