// Named parameter sets of devices that are sold or that were measured.
//
// A sensor asks for one with the parameter "preset" (<gsv:preset>hc_sr04</gsv:preset>). Parameters
// that the sensor has itself win over those of the preset. A sensor without a preset is not changed.
#pragma once

#include <string>
#include <vector>

#include "gsv/base/error.h"
#include "gsv/model/sensor_description.h"

namespace gsv::sensing {

struct Preset {
  std::string type, name;
  std::string source;  // a sentence: where the numbers come from
  model::Parameters parameters;
};

// By type, then name.
const std::vector<Preset>& Presets();

// The description with its preset's parameters filled in. `type` is the sensor type's own name, not
// an alias. kInvalidArgument, naming those that there are, for an unknown preset.
base::Result<model::SensorDescription> WithPreset(const std::string& type,
                                                  const model::SensorDescription& description);

}  // namespace gsv::sensing
