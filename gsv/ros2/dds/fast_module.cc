#include "gsv/ros2/dds/fast_participant.h"
#include "gsv/ros2/dds/module.h"

extern "C" const gsv::ros2::dds::Module* gsv_ros2_module() {
  static const gsv::ros2::dds::Module kModule{.library = "Fast DDS 2.9",
                                              .make = &gsv::ros2::dds::MakeFastParticipant};
  return &kModule;
}
