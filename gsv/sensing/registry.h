// The sensor types there are. A new type is one registration, which MakeSensorType() makes of a
// class (sensor_type.h). Nothing else in the tree knows the types.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/messages/schema.h"
#include "gsv/readings/layout.h"
#include "gsv/sensing/sensor.h"

namespace gsv::sensing {

// What a viewer draws of a reading.
enum class Overlay { kNone, kLines, kPoints, kPicture };

// A second message that goes with a reading, at the reading's instant, on the topic
// /ROBOT/SENSOR/`topic`. Sensor::EncodeCompanionOf() makes it.
struct Companion {
  std::string topic;
  const messages::Schema* schema = nullptr;
  // It depends on what was read (the points of a lidar), not only on how the sensor is made (the
  // lens of a camera).
  bool of_readings = false;
};

// What a sensor sends. `schema` is that of Sensor::Encode(); null: there is no message.
struct SensorMessages {
  const messages::Schema* schema = nullptr;
  std::optional<Companion> companion;
};

struct SensorType {
  std::string name;                  // the service's and the recording's name: "lidar"
  std::vector<std::string> aliases;  // further names in model files: "ray", "gpu_lidar"

  // Refuses parameters that are out of range with a sentence that names them.
  std::function<base::Result<std::unique_ptr<Sensor>>(const model::SensorDescription&)> create;

  const messages::Schema* schema = nullptr;  // of Sensor::Encode(); null: there is no message
  readings::Layout layout;                   // of the readings; empty: nobody says
  std::optional<Companion> companion;  // of cameras alone, which have an optical frame as well
  Overlay overlay = Overlay::kNone;

  // Of a type whose messages depend on the sensor's description; empty: they are those above.
  std::function<SensorMessages(const model::SensorDescription&)> messages_of;

  SensorMessages MessagesOf(const model::SensorDescription& description) const {
    return messages_of ? messages_of(description) : SensorMessages{schema, companion};
  }
};

class SensorRegistry {
 public:
  // Fails when the name or an alias is taken.
  base::Status Add(SensorType type);

  // By name or alias; null if there is none. Valid as long as the registry.
  const SensorType* Find(std::string_view name) const;

  std::vector<std::string> names() const;

 private:
  std::map<std::string, std::shared_ptr<const SensorType>, std::less<>> types_;
};

}  // namespace gsv::sensing
