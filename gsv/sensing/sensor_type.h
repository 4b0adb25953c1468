// Makes a sensor type from a class: the layout of its readings, its message and its registration.
//
//   class Battery final : public SensorOf<readings::Battery, messages::sensor_msgs::BatteryState> {
//    public:
//     Battery(const model::SensorDescription& description, ParameterReader& reader);
//     base::Result<Reading> Sample(const Sampling& sampling) const override;
//
//    private:
//     Message ToMessage(const Values& battery, const Reading&, const std::string&) const override;
//   };
//   SensorType BatteryType() { return MakeSensorType<Battery>("battery"); }
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gsv/readings/catalogue.h"
#include "gsv/sensing/encoding.h"
#include "gsv/sensing/parameters.h"
#include "gsv/sensing/presets.h"
#include "gsv/sensing/registry.h"

namespace gsv::sensing {

// A sensor whose readings have the struct ValuesType (gsv/readings) and the message MessageType.
// Base is Sensor, Device or Actuator.
template <typename ValuesType, typename MessageType, typename Base = Sensor>
class SensorOf : public Base {
 public:
  using Values = ValuesType;
  using Message = MessageType;
  using Base::Base;

  base::Status AppendMessage(const Reading& reading, const std::string& frame_id,
                             messages::Bytes& out) const final {
    const auto values = ValuesOf<Values>(reading, this->description().name);
    if (!values) return base::Fail(values.error());
    Message message = ToMessage(*values, reading, frame_id);
    if (message.header.frame_id.empty()) message.header = HeaderOf(reading, frame_id);
    messages::Encode(message, out);
    return {};
  }
  std::vector<Segment> Beams(const Reading& reading) const final {
    const auto values = ValuesOf<Values>(reading, this->description().name);
    return values ? BeamsOf(*values) : std::vector<Segment>();
  }

 private:
  // Converts a reading to a message. The header may be left empty if its frame is the sensor's
  // frame.
  virtual Message ToMessage(const Values& values, const Reading& reading,
                            const std::string& frame_id) const = 0;
  // Returns the beams of a reading for viewers; see Sensor::Beams().
  virtual std::vector<Segment> BeamsOf(const Values& /*values*/) const { return {}; }
};

// Makes the type of a class that derives from SensorOf and has the constructor (description,
// ParameterReader&, context…). The constructor reports invalid parameters to the reader.
template <typename Kind, typename... Context>
SensorType MakeSensorType(std::string name, std::vector<std::string> aliases = {},
                          Overlay overlay = Overlay::kNone, Context... context) {
  SensorType type;
  type.name = std::move(name);
  type.aliases = std::move(aliases);
  type.create =
      [name = type.name,
       context...](const model::SensorDescription& given) -> base::Result<std::unique_ptr<Sensor>> {
    const auto description = WithPreset(name, given);
    if (!description) return base::Fail(description.error());
    ParameterReader reader(*description);
    auto sensor = std::make_unique<Kind>(*description, reader, context...);
    if (!reader.status()) return base::Fail(reader.status().error());
    return sensor;
  };
  type.schema = &messages::SchemaOf<typename Kind::Message>();
  type.layout = readings::LayoutOf<typename Kind::Values>();
  type.overlay = overlay;
  return type;
}

}  // namespace gsv::sensing
