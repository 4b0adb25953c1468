// SROS2: the keys and permissions of an enclave, which DDS Security uses.
//
// ROS_SECURITY_ENABLE            true: with security
// ROS_SECURITY_KEYSTORE          the folder that `ros2 security create_keystore` made
// ROS_SECURITY_STRATEGY          if there are no keys: with Enforce, gsv does not start; with
//                                Permissive (default), gsv starts without security
// ROS_SECURITY_ENCLAVE_OVERRIDE  the enclave (default: /)
//
// Source   design.ros2.org/articles/ros2_dds_security.html.
#pragma once

#include "gsv/ros2/options.h"

namespace gsv::ros2 {

// The files that the folder of an enclave must contain.
inline constexpr const char* kEnclaveFiles[]{
    "identity_ca.cert.pem",    "cert.pem",       "key.pem",
    "permissions_ca.cert.pem", "governance.p7s", "permissions.p7s"};

// Sets the enclave of a participant. Fails with kInvalidArgument if a variable has an invalid
// value, or if required keys are missing.
base::Status UseSecurity(const Environment& environment, dds::ParticipantOptions& participant);

}  // namespace gsv::ros2
