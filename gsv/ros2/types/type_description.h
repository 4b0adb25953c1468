// The description of a ROS 2 type, from which its hash is computed.
//
// Source  REP-2011, REP-2016; type_description_interfaces/msg/TypeDescription, FieldType.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/messages/schema.h"

namespace gsv::ros2 {

// type_description_interfaces/msg/FieldType.
struct FieldType {
  // The id of the element type. 48, 96 or 144 is added for arrays and sequences.
  std::uint8_t id = 0;
  std::uint64_t capacity = 0;         // size of a fixed array or maximum of a bounded sequence
  std::uint64_t string_capacity = 0;  // maximum length of a bounded string
  std::string nested_type;            // "geometry_msgs/msg/Vector3"
};

struct FieldDescription {
  std::string name;
  FieldType type;
};

using Fields = std::vector<FieldDescription>;

// A type, and all types that its fields use directly or indirectly.
struct TypeDescription {
  std::string name;  // "sensor_msgs/msg/LaserScan", "rcl_interfaces/srv/GetParameters"
  Fields fields;
  std::map<std::string, Fields> referenced;  // the other types, by name
};

// Reads a schema in the encoding "ros2msg". Constants and default values are left out. Fails with
// kCorrupt if the text is not a definition, or if it uses a type that it does not define.
[[nodiscard]] base::Result<TypeDescription> DescribeType(const messages::Schema& schema);

// Returns the description of a service, whose fields are its request, its response and its event.
// `name` is for example "rcl_interfaces/srv/GetParameters". The two schemas describe the request
// and the response.
[[nodiscard]] base::Result<TypeDescription> DescribeService(std::string_view name,
                                                            const messages::Schema& request,
                                                            const messages::Schema& response);

// Returns the text whose hash is computed: JSON in the format of Python's json.dumps, without
// default values.
std::string CanonicalJson(const TypeDescription& description);

}  // namespace gsv::ros2
