// The source of a curve's samples: messages of a recording, and the value of each.
//
// Input  untrusted: invalid messages give no sample.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "gsv/base/error.h"
#include "gsv/gateway/recorded/recorded_scene.h"
#include "gsv/recording/mcap/mcap_reader.h"

namespace gsv::gateway::curves {

// One of these:
//   topic, key     a number of the topic's messages, see field_value.h
//   robot, key     x, y, z (m), roll, pitch, yaw (rad), speed (m/s), turn_rate (rad/s) of its
//                  poses, and distance (m), collisions of its status
//   key            real_time_factor or late_steps of the simulation
struct CurveRequest {
  std::string topic, robot, key;
  std::size_t max_points = 0;

  friend bool operator==(const CurveRequest&, const CurveRequest&) = default;
};

class CurveSource {
 public:
  virtual ~CurveSource() = default;
  // Returns the sample of the next message, in the order of time; nothing if the message has none.
  virtual std::optional<double> SampleIn(const recording::MessageRecord& message) = 0;
};

// `reader` and `scene` must outlive the source. kNotFound: the recording has no such topic or
// robot; kInvalidArgument: there is no such value. Each with a sentence.
base::Result<std::unique_ptr<CurveSource>> MakeCurveSource(const recording::McapReader& reader,
                                                           const RecordedScene& scene,
                                                           const CurveRequest& request);

}  // namespace gsv::gateway::curves
