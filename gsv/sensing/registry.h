// The registry of sensor types. A new type needs only one registration, which MakeSensorType()
// makes from a class (sensor_type.h). No other code depends on the set of types.
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

// The way in which viewers draw a reading.
enum class Overlay { kNone, kLines, kPoints, kImage };

// A second message beside the message of a reading, with the same time, on the topic
// /ROBOT/SENSOR/`topic`. Sensor::EncodeCompanionOf() creates it.
struct Companion {
  std::string topic;                         // last part of the topic's name, such as "camera_info"
  const messages::Schema* schema = nullptr;  // never null
  // Whether this message depends on the reading (the points of a lidar), and not only on the
  // description (the lens of a camera).
  bool of_readings = false;
};

// The messages of a sensor. `schema` is the schema of Sensor::Encode(); null if there is no
// message.
struct SensorMessages {
  const messages::Schema* schema = nullptr;
  std::optional<Companion> companion;
};

// A sensor type: its name, how a sensor is created, and its readings and messages.
struct SensorType {
  std::string name;                  // name in services and recordings, such as "lidar"
  std::vector<std::string> aliases;  // other names in model files, such as "ray" and "gpu_lidar"

  // Creates a sensor. If a parameter is invalid, returns an error that names it.
  std::function<base::Result<std::unique_ptr<Sensor>>(const model::SensorDescription&)> create;

  // the schema of Sensor::Encode(); null if there is no message
  const messages::Schema* schema = nullptr;
  readings::Layout layout;             // layout of the readings; empty if it is unknown
  std::optional<Companion> companion;  // set for cameras, whose frames include an optical frame
  Overlay overlay = Overlay::kNone;    // how viewers draw the readings

  // Set only if the messages depend on the sensor's description. If it is empty, `schema` and
  // `companion` apply to all sensors of the type.
  std::function<SensorMessages(const model::SensorDescription&)> messages_of;

  // Returns the messages of a sensor with this description.
  SensorMessages MessagesOf(const model::SensorDescription& description) const {
    return messages_of ? messages_of(description) : SensorMessages{schema, companion};
  }
};

// The sensor types of this process, by name and alias.
class SensorRegistry {
 public:
  // Adds a type. Fails if its name or an alias is taken.
  base::Status Add(SensorType type);

  // Returns the type with this name or alias, or null. The pointer is valid during the registry's
  // lifetime.
  const SensorType* Find(std::string_view name) const;

  // The names of all types.
  std::vector<std::string> names() const;

 private:
  std::map<std::string, std::shared_ptr<const SensorType>, std::less<>> types_;
};

}  // namespace gsv::sensing
