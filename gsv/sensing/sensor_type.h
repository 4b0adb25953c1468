// What sensor types have in common in their making.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gsv/sensing/encoding.h"
#include "gsv/sensing/parameters.h"
#include "gsv/sensing/registry.h"

namespace gsv::sensing {

// Kind is a Sensor that turns a reading into a Message, all but its header, by
//   static Message ToMessage(const model::SensorDescription&, const Reading&,
//                            const std::string& frame_id)
// and is made by make(description, ParameterReader&), which refuses by the reader.
template <typename Kind, typename Message, typename Make>
SensorType MakeSensorTypeBy(std::string name, std::vector<std::string> aliases, Make make) {
  SensorType type;
  type.name = std::move(name);
  type.aliases = std::move(aliases);
  type.create =
      [make = std::move(make)](
          const model::SensorDescription& description) -> base::Result<std::unique_ptr<Sensor>> {
    ParameterReader reader(description);
    std::unique_ptr<Sensor> sensor = make(description, reader);
    if (!reader.status()) return base::Fail(reader.status().error());
    return sensor;
  };
  type.schema = &messages::SchemaOf<Message>();
  type.encode = [](const model::SensorDescription& description, const Reading& reading,
                   const std::string& frame_id) {
    Message message = Kind::ToMessage(description, reading, frame_id);
    message.header = HeaderOf(reading, frame_id);
    return Encoded(message);
  };
  return type;
}

// The same for a Kind that is made of (description, ParameterReader&).
template <typename Kind, typename Message>
SensorType MakeSensorType(std::string name, std::vector<std::string> aliases = {}) {
  return MakeSensorTypeBy<Kind, Message>(
      std::move(name), std::move(aliases),
      [](const model::SensorDescription& description, ParameterReader& reader) {
        return std::make_unique<Kind>(description, reader);
      });
}

}  // namespace gsv::sensing
