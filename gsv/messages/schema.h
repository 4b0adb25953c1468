// How a message type describes itself to those who read it later: in a recording, over the wire.
#pragma once

#include <string_view>

namespace gsv::messages {

// All views live as long as the program.
struct Schema {
  std::string_view name;      // "sensor_msgs/msg/Range"
  std::string_view encoding;  // "ros2msg"
  // The type's definition followed by those of all types it uses, each after a line of eighty
  // '=' and "MSG: package/Name": what rosbag2 and MCAP's readers expect.
  std::string_view text;
};

// The schema of a generated message type: SchemaOf<sensor_msgs::Range>().
template <typename Message>
const Schema& SchemaOf();

}  // namespace gsv::messages
