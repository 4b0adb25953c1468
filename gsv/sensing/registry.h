// The sensor types there are. A new type is one registration: how to make it, how its readings are
// written as a ROS 2 message, how they are drawn. Nothing else in the tree knows the types.
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
#include "gsv/sensing/sensor.h"

namespace gsv::sensing {

// What a viewer draws of a reading.
enum class Overlay { kNone, kLines, kPoints, kPicture };

// A line in the sensor's frame, from where the beam starts to where it ends.
struct Segment {
  geometry::Vector3 from, to;
};

// A message that goes with a reading and hangs on how the sensor is made, not on what it reads: how
// a camera's picture is to be understood. On the topic /ROBOT/SENSOR/`topic`, at the reading's
// instant.
struct Companion {
  std::string topic;
  const messages::Schema* schema = nullptr;
  std::function<std::vector<std::uint8_t>(const model::SensorDescription&, const Reading&,
                                          const std::string& frame_id)>
      encode;
};

struct SensorType {
  std::string name;                  // the service's and the recording's name: "lidar"
  std::vector<std::string> aliases;  // further names in model files: "ray", "gpu_lidar"

  // Refuses parameters that are out of range with a sentence that names them.
  std::function<base::Result<std::unique_ptr<Sensor>>(const model::SensorDescription&)> create;

  // The message that a reading becomes; `frame_id` is the sensor's frame.
  const messages::Schema* schema = nullptr;
  std::function<std::vector<std::uint8_t>(const model::SensorDescription&, const Reading&,
                                          const std::string& frame_id)>
      encode;

  std::optional<Companion> companion;  // of cameras alone, which have an optical frame as well

  Overlay overlay = Overlay::kNone;
  // kLines and kPoints: the beams of a reading (a point is drawn at each beam's end).
  std::function<std::vector<Segment>(const model::SensorDescription&, const Reading&)> beams;
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
