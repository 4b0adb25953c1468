// A CurveSource extracts the samples of one curve from the messages of a recording.
//
// Input  untrusted: invalid messages have no sample.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "gsv/base/error.h"
#include "gsv/gateway/recorded/recorded_scene.h"
#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::gateway::curves {

// Names a curve by one of these combinations:
//   topic, key     a number of the topic's messages, see field_value.h
//   robot, key     x, y, z (m), roll, pitch, yaw (rad), speed (m/s), turn_rate (rad/s) from the
//                  robot's poses; distance (m), collisions from the robot's status
//   key            real_time_factor or late_steps of the simulation
struct CurveRequest {
  std::string topic, robot, key;
  std::size_t max_points = 0;  // maximum number of points of the curve

  friend bool operator==(const CurveRequest&, const CurveRequest&) = default;
};

// Extracts the samples of one curve from messages.
class CurveSource {
 public:
  virtual ~CurveSource() = default;
  // Returns the sample in `message`, or nullopt if the message has no sample. Call it with the
  // messages in the order of time.
  virtual std::optional<double> SampleIn(const recording::MessageRecord& message) = 0;
};

// Makes the source of a curve. `reader` and `scene` must outlive the source. Fails with kNotFound
// if the recording has no such topic or robot, and with kInvalidArgument for another combination or
// an unknown key of a robot or the simulation. An unknown key of a topic has no samples.
base::Result<std::unique_ptr<CurveSource>> MakeCurveSource(const recording::McapReader& reader,
                                                           const RecordedScene& scene,
                                                           const CurveRequest& request);

}  // namespace gsv::gateway::curves
