// The hashes by which ROS 2 nodes see whether they mean the same type.
//
// Source  REP-2011, REP-2016 (RIHS01): SHA-256 of the type's description in canonical JSON. Endpoints carry
//         it in their USER_DATA since Iron.
// Threads any.
#pragma once

#include <string>
#include <string_view>

#include "gsv/ros2/types/type_description.h"

namespace gsv::ros2 {

// "RIHS01_" and 64 lower-case hexadecimal digits.
std::string TypeHash(const TypeDescription& description);

// The hash of a message that gsv/messages defines ("sensor_msgs/msg/LaserScan"), or of a service both
// halves of which it defines ("rcl_interfaces/srv/GetParameters"). Empty for all others. Computed once.
std::string TypeHashOf(std::string_view type);

// The USER_DATA of an endpoint of that type: "typehash=RIHS01_…;". Both topics of a service carry
// the hash of the service, so "pkg/srv/Name_Request" and "…_Response" stand for "pkg/srv/Name". Empty where
// there is no hash.
std::string TypeHashUserData(std::string_view type);

// The hash in an endpoint's USER_DATA; empty where there is none. `user_data` is untrusted input.
std::string_view TypeHashIn(std::string_view user_data);

}  // namespace gsv::ros2
