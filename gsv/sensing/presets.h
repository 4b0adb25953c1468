// Named parameter sets of commercial or measured devices.
//
// A sensor selects a preset with the parameter "preset" (<gsv:preset>hc_sr04</gsv:preset>).
// Parameters of the sensor itself override the parameters of the preset. A sensor without a preset
// is not changed.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/sensor_description.h"

namespace gsv::sensing {

// A named set of sensor parameters.
struct Preset {
  std::string type, name;        // sensor type; name of the preset
  std::string source;            // a sentence with the source of the numbers
  model::Parameters parameters;  // used unless the sensor's description sets them
};

// All presets, ordered by type and then by name.
const std::vector<Preset>& Presets();

// Returns the description with the parameters of its preset added. `type` is the sensor type's own
// name, not an alias. An unknown preset is a kInvalidArgument error that lists the known presets.
base::Result<model::SensorDescription> WithPreset(const std::string& type,
                                                  const model::SensorDescription& description);

}  // namespace gsv::sensing
