// A sensor that forwards all calls except beam() to another sensor; a base class for decorators.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gsv/sensing/sensor.h"

namespace gsv::sensing {

// Base class of sensors that change the behaviour of another sensor.
class ForwardingSensor : public Sensor {
 public:
  explicit ForwardingSensor(std::unique_ptr<Sensor> sensor)
      : Sensor(sensor->description()), sensor_(std::move(sensor)) {}

  base::Result<Reading> Sample(const Sampling& sampling) const override {
    return sensor_->Sample(sampling);
  }
  bool TakesLong() const override { return sensor_->TakesLong(); }
  bool CastsRays() const override { return sensor_->CastsRays(); }
  base::Status AppendMessage(const Reading& reading, const std::string& frame_id,
                             messages::Bytes& out) const override {
    return sensor_->AppendMessage(reading, frame_id, out);
  }
  Bytes EncodeCompanion(base::SimTime time, const std::string& frame_id) const override {
    return sensor_->EncodeCompanion(time, frame_id);
  }
  Bytes EncodeCompanionOf(const Reading& reading, const std::string& frame_id) const override {
    return sensor_->EncodeCompanionOf(reading, frame_id);
  }
  std::vector<Segment> Beams(const Reading& reading) const override {
    return sensor_->Beams(reading);
  }
  std::optional<Frustum> frustum() const override { return sensor_->frustum(); }
  const Device* device() const override { return sensor_->device(); }

 protected:
  const Sensor& sensor() const { return *sensor_; }  // the other sensor

 private:
  const std::unique_ptr<Sensor> sensor_;
};

}  // namespace gsv::sensing
