// Messages whose types are only known from a schema's text: those of a recording, whoever wrote it.
//
// Input    hostile: text and data come from a file. Nesting, lengths and the size of what is
//          decoded are bounded.
// Sources  ROS 2 interface definition (design.ros2.org/articles/legacy_interface_definition.html);
//          CDR as in OMG DDSI-RTPS, little and big endian, plain (XCDR1).
#pragma once

#include <cstddef>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "gsv/base/error.h"

namespace gsv::messages {

class Definition {
 public:
  // `name` as in a schema, "sensor_msgs/msg/Range"; `text` is the type's definition and those of
  // the types it uses, as in Schema::text.
  static base::Result<Definition> Parse(std::string_view name, std::string_view text);

  // A message as JSON, with its fields in order. Octets (images, point clouds) become
  // {"bytes": COUNT}, as nobody reads them as text.
  base::Result<nlohmann::ordered_json> Decode(std::span<const std::byte> cdr) const;

 private:
  friend class Decoder;

  enum class Kind { kBool, kInteger, kUnsigned, kFloat, kString, kStruct };
  enum class Shape { kSingle, kArray, kSequence };
  struct Field {
    std::string name;
    Kind kind = Kind::kBool;
    std::size_t size = 1;     // bytes of a number
    std::string struct_type;  // kStruct: "package/Name"
    Shape shape = Shape::kSingle;
    std::size_t length = 0;  // kArray
  };
  using Struct = std::vector<Field>;

  base::Status AddStruct(const std::string& type, std::string_view text);
  base::Status Check() const;  // all types are there, and none holds itself

  std::string root_;
  std::map<std::string, Struct> structs_;  // by "package/Name"
};

}  // namespace gsv::messages
