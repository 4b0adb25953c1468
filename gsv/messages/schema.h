// Describes a message type for programs that read its messages later, from a recording or over a
// network.
#pragma once

#include <string_view>

namespace gsv::messages {

// All string views are valid until the program ends.
struct Schema {
  std::string_view name;      // such as "sensor_msgs/msg/Range"
  std::string_view encoding;  // always "ros2msg"
  // The definition of the type, followed by the definitions of all types that it uses. In front of
  // each of these are a line of eighty '=' and the line "MSG: package/Name". Readers of rosbag2 and
  // MCAP expect this form.
  std::string_view text;
};

// Returns the schema of a generated message type: SchemaOf<sensor_msgs::Range>().
template <typename Message>
const Schema& SchemaOf();

}  // namespace gsv::messages
