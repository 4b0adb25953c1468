// The hashes by which ROS 2 nodes check whether their definitions of a type are equal.
//
// Source  REP-2011, REP-2016 (RIHS01): SHA-256 of the type's description in canonical JSON. Since
//         Iron, endpoints contain the hash in their USER_DATA.
// Threads any.
#pragma once

#include <string>
#include <string_view>

#include "gsv/ros2/types/type_description.h"

namespace gsv::ros2 {

// Returns "RIHS01_" and 64 lower-case hexadecimal digits.
std::string TypeHash(const TypeDescription& description);

// Returns the hash of a message ("sensor_msgs/msg/LaserScan") or service
// ("rcl_interfaces/srv/GetParameters") of gsv/messages; empty for all other types. Each hash is
// computed only once.
std::string TypeHashOf(std::string_view type);

// Returns the USER_DATA of an endpoint with the type `type`: "typehash=RIHS01_…;". Empty if the
// type has no hash. Both topics of a service contain the hash of the service. So for
// "pkg/srv/Name_Request" and "pkg/srv/Name_Response", it is the hash of "pkg/srv/Name".
std::string TypeHashUserData(std::string_view type);

// Returns the hash in an endpoint's USER_DATA, or an empty text. `user_data` is untrusted input.
std::string_view TypeHashIn(std::string_view user_data);

}  // namespace gsv::ros2
