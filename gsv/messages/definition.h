// Decodes messages whose types are known only from the text of a schema, such as the messages in a
// recording that another program wrote.
//
// Input    untrusted: text and data come from a file. Nesting, lengths and the size of the result
//          are limited.
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

// A message type that was parsed from the text of a schema.
class Definition {
 public:
  // Parses a schema. `name` has the form "sensor_msgs/msg/Range". `text` is the definition of the
  // type and of the types that it uses, as in Schema::text.
  static base::Result<Definition> Parse(std::string_view name, std::string_view text);

  // Decodes a message as JSON, with its fields in order. Arrays of octets (images, point clouds)
  // become {"bytes": COUNT}, because nobody reads them as text.
  base::Result<nlohmann::ordered_json> Decode(std::span<const std::byte> cdr) const;

 private:
  friend class Decoder;

  enum class Kind { kBool, kInteger, kUnsigned, kFloat, kString, kStruct };
  // Whether a field is one value, an array of fixed length, or a sequence of any length.
  enum class Shape { kSingle, kArray, kSequence };
  struct Field {
    std::string name;
    Kind kind = Kind::kBool;
    std::size_t size = 1;     // size of a number in bytes
    std::string struct_type;  // for kStruct, as "package/Name"
    Shape shape = Shape::kSingle;
    std::size_t length = 0;  // for kArray
  };
  using Struct = std::vector<Field>;

  // Parses the definition of one type.
  base::Status AddStruct(const std::string& type, std::string_view text);
  base::Status Check() const;  // Checks that all types are defined and that none contains itself.

  std::string root_;                       // the type of the messages, as "package/Name"
  std::map<std::string, Struct> structs_;  // by "package/Name"
};

}  // namespace gsv::messages
