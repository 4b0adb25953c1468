#include "gsv/services/sensor_servants.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "gsv/base/base64.h"
#include "gsv/services/actuator_servants.h"
#include "idl/sensors.hh"

namespace gsv::services {
namespace {

using sensing::Reading;

sba::Vector VectorToIdl(const readings::Vector& v) { return {v.x, v.y, v.z}; }

sba::Placement PlacementToIdl(const readings::Placement& p) {
  return {p.x, p.y, p.z, p.roll, p.pitch, p.yaw};
}

// Sets `to`, a sequence of an IDL module, to the results of `convert` for each element of `from`.
template <typename Sequence, typename List, typename Convert>
Sequence* ToSequence(const List& from, Convert convert) {
  auto* const sequence = new Sequence;
  sequence->length(static_cast<CORBA::ULong>(from.size()));
  CORBA::ULong i = 0;
  for (const auto& each : from) convert(each, (*sequence)[i++]);
  return sequence;
}

class SonarServant final : public SensorServant<POA_sba::Sonar> {
 public:
  using SensorServant::SensorServant;
  CORBA::Double range() override { return In<readings::Sonar>(Read()).range; }
  CORBA::Double max_range() override {
    return model::NumberOr(description().parameters, "max", 5.0);
  }
};

class LidarServant final : public SensorServant<POA_sba::IntensityLidar> {
 public:
  using SensorServant::SensorServant;
  sba::Doubles* ranges() override {
    const Reading reading = Read();
    return ToDoubles(ScanIn(reading).ranges);
  }
  sba::LidarScan* read() override {
    const Reading reading = Read();
    const readings::Lidar scan = ScanIn(reading);
    sba::LidarScan_var reply = new sba::LidarScan;
    reply->time_ns = reading.time.count();
    reply->ranges_m = *sba::Doubles_var(ToDoubles(scan.ranges)).operator->();
    reply->intensities = *sba::Doubles_var(ToDoubles(scan.intensities)).operator->();
    return reply._retn();
  }

 private:
  static sba::Doubles* ToDoubles(std::span<const double> from) {
    return ToSequence<sba::Doubles>(from, [](double value, CORBA::Double& to) { to = value; });
  }
  readings::Lidar ScanIn(const Reading& reading) const {
    const auto scan = In<readings::Lidar>(reading);
    const bool has_intensities =
        model::NumberOr(description().parameters, readings::Lidar::kIntensityParameter, 0.0) > 0;
    return has_intensities ? scan.WithIntensities() : scan;
  }
};

class CameraServant final : public SensorServant<POA_sba::Camera> {
 public:
  using SensorServant::SensorServant;
  sba::Picture* take_picture() override {
    const sba::Measurement measurement = services::ToIdl(description().name, Read());
    auto* reply = new sba::Picture;
    reply->width = measurement.image_width;
    reply->height = measurement.image_height;
    reply->rgb = measurement.image;
    reply->time_ns = measurement.time_ns;
    return reply;
  }
};

class PositioningServant final : public SensorServant<POA_sba::PositioningSystem> {
 public:
  using SensorServant::SensorServant;
  sba::Placement locate() override {
    return PlacementToIdl(In<readings::Positioning>(Read()).world_from_sensor);
  }
};

class ImuServant final : public SensorServant<POA_sba::Imu> {
 public:
  using SensorServant::SensorServant;
  sba::ImuReading feel() override {
    const Reading reading = Read();
    const auto motion = In<readings::Imu>(reading);
    return {reading.time.count(), VectorToIdl(motion.angular_velocity),
            VectorToIdl(motion.specific_force)};
  }
  sba::OrientedImuReading read() override {
    const Reading reading = Read();
    const auto motion = In<readings::Imu>(reading);
    const readings::Quaternion q =
        motion.world_from_sensor.value_or(readings::Quaternion{.w = 1, .x = 0, .y = 0, .z = 0});
    return {reading.time.count(),
            VectorToIdl(motion.angular_velocity),
            VectorToIdl(motion.specific_force),
            motion.world_from_sensor.has_value(),
            {q.w, q.x, q.y, q.z}};
  }
};

class OdometerServant final : public SensorServant<POA_sba::Odometer> {
 public:
  using SensorServant::SensorServant;
  sba::OdometryReading reckon() override {
    const sba::PlanarOdometryReading r = read();
    return {r.time_ns, r.x_m, r.y_m, r.yaw_rad, r.linear_m_s, r.angular_rad_s};
  }
  sba::PlanarOdometryReading read() override {
    const Reading reading = Read();
    const auto o = In<readings::Odometry>(reading);
    return {reading.time.count(), o.x, o.y, o.yaw, o.linear, o.lateral, o.angular};
  }
};

class SatelliteReceiverServant final : public SensorServant<POA_sba::SatelliteReceiver> {
 public:
  using SensorServant::SensorServant;
  sba::SatelliteFix fix() override {
    const Reading reading = Read();
    const auto f = In<readings::Navsat>(reading);
    return {
        reading.time.count(), f.latitude_deg, f.longitude_deg, f.altitude, f.east, f.north, f.up};
  }
};

class MagnetometerServant final : public SensorServant<POA_sba::Magnetometer> {
 public:
  using SensorServant::SensorServant;
  sba::Vector field_t() override { return VectorToIdl(In<readings::Magnetometer>(Read()).field); }
};

class AltimeterServant final : public SensorServant<POA_sba::Altimeter> {
 public:
  using SensorServant::SensorServant;
  sba::AltimeterReading height() override {
    const Reading reading = Read();
    const auto h = In<readings::Altimeter>(reading);
    return {reading.time.count(), h.position, h.velocity, h.reference};
  }
};

class BumperServant final : public SensorServant<POA_sba::Bumper> {
 public:
  using SensorServant::SensorServant;
  CORBA::Boolean is_pressed() override { return !In<readings::Contact>(Read()).touches.empty(); }
  sba::TouchPoints* touches() override {
    return ToSequence<sba::TouchPoints>(In<readings::Contact>(Read()).touches,
                                        [](const readings::Touch& touch, sba::TouchPoint& to) {
                                          to.other = touch.other.c_str();
                                          to.point_m = VectorToIdl(touch.point);
                                          to.normal = VectorToIdl(touch.normal);
                                          to.depth_m = touch.depth;
                                          to.closing_speed_m_s = touch.closing_speed;
                                        });
  }
  sba::PressedPoints* presses() override {
    return ToSequence<sba::PressedPoints>(In<readings::Contact>(Read()).touches,
                                          [](const readings::Touch& touch, sba::PressedPoint& to) {
                                            to.other = touch.other.c_str();
                                            to.point_m = VectorToIdl(touch.point);
                                            to.normal = VectorToIdl(touch.normal);
                                            to.depth_m = touch.depth;
                                            to.closing_speed_m_s = touch.closing_speed;
                                            to.force_n = VectorToIdl(touch.force);
                                          });
  }
};

class ForceTorqueServant final : public SensorServant<POA_sba::ForceTorque> {
 public:
  using SensorServant::SensorServant;
  sba::ForceTorqueReading wrench() override {
    const Reading reading = Read();
    const auto of_joint = In<readings::ForceTorque>(reading);
    return {reading.time.count(), VectorToIdl(of_joint.force), VectorToIdl(of_joint.torque)};
  }
};

class JointEncodersServant final : public SensorServant<POA_sba::JointEncoders> {
 public:
  using SensorServant::SensorServant;
  sba::EncoderReadings* joints() override {
    return ToSequence<sba::EncoderReadings>(
        In<readings::JointEncoders>(Read()).joints,
        [](const readings::EncodedJoint& joint, sba::EncoderReading& to) {
          to.joint = joint.name.c_str();
          to.position = joint.position;
          to.velocity = joint.velocity;
        });
  }
};

class BatteryServant final : public SensorServant<POA_sba::Battery> {
 public:
  using SensorServant::SensorServant;
  sba::BatteryReading level() override {
    const Reading reading = Read();
    const auto b = In<readings::Battery>(reading);
    return {reading.time.count(), b.voltage, b.current, b.charge, b.capacity, b.fraction};
  }
};

class LogicalCameraServant final : public SensorServant<POA_sba::LogicalCamera> {
 public:
  using SensorServant::SensorServant;
  sba::Sightings* look() override {
    return ToSequence<sba::Sightings>(In<readings::LogicalCamera>(Read()).sightings,
                                      [](const readings::Sighting& from, sba::Sighting& to) {
                                        to.name = from.name.c_str();
                                        to.sensor_from_model =
                                            PlacementToIdl(from.sensor_from_model);
                                      });
  }
};

class RadioServant final : public SensorServant<POA_sba::Radio> {
 public:
  using SensorServant::SensorServant;
  void send(const char* receiver, const sba::Octets& content) override {
    const auto* const bytes = reinterpret_cast<const char*>(content.get_buffer());
    orb::ValueOrThrow(
        agent().Send(description().name, receiver, std::string(bytes, content.length())));
  }
  sba::RadioMessages* receive(CORBA::ULongLong after) override {
    auto heard = In<readings::Radio>(Read());
    std::erase_if(heard.messages, [&](const auto& message) { return message.number <= after; });
    return ToSequence<sba::RadioMessages>(
        heard.messages, [](const readings::HeardMessage& from, sba::RadioMessage& to) {
          to.sender = from.sender.c_str();
          to.number = from.number;
          to.sent_ns = base::FromSeconds(from.sent).count();
          to.strength_dbm = from.strength;
          const auto content = base::FromBase64(from.content_base64);
          to.content.length(static_cast<CORBA::ULong>(content->size()));
          std::copy(content->begin(), content->end(), to.content.get_buffer());
        });
  }
};

class RangingServant final : public SensorServant<POA_sba::Ranging> {
 public:
  using SensorServant::SensorServant;
  sba::RangingReading read() override {
    const Reading reading = Read();
    return {reading.time.count(), In<readings::Ranging>(reading).distance};
  }
};

class MicrophoneServant final : public SensorServant<POA_sba::Microphone> {
 public:
  using SensorServant::SensorServant;
  sba::Hearing* listen() override {
    const Reading reading = Read();
    const auto heard = In<readings::Microphone>(reading);
    sba::Hearing_var hearing = new sba::Hearing;
    hearing->time_ns = reading.time.count();
    hearing->level_db = heard.level;
    hearing->frequency_hz = heard.frequency;
    hearing->source = heard.source.c_str();
    return hearing._retn();
  }
};

class DepthCameraServant final : public SensorServant<POA_sba::DepthCamera> {
 public:
  using SensorServant::SensorServant;
  sba::DepthPicture* take_depth() override {
    const Reading reading = Read();
    const auto image = In<readings::DepthImage>(reading);
    sba::DepthPicture_var reply = new sba::DepthPicture;
    reply->time_ns = reading.time.count();
    reply->width = static_cast<CORBA::ULong>(image.width);
    reply->height = static_cast<CORBA::ULong>(image.height);
    reply->depth_m.length(static_cast<CORBA::ULong>(image.depth.size()));
    std::transform(image.depth.begin(), image.depth.end(), reply->depth_m.get_buffer(),
                   [](double depth) { return static_cast<CORBA::Float>(depth); });
    return reply._retn();
  }
};

class SegmentationCameraServant final : public SensorServant<POA_sba::SegmentationCamera> {
 public:
  using SensorServant::SensorServant;
  sba::LabelPicture* segment() override {
    const Reading reading = Read();
    const auto image = In<readings::SegmentedImage>(reading);
    sba::LabelPicture_var reply = new sba::LabelPicture;
    reply->time_ns = reading.time.count();
    reply->width = static_cast<CORBA::ULong>(image.width);
    reply->height = static_cast<CORBA::ULong>(image.height);
    reply->labels.length(static_cast<CORBA::ULong>(image.pixels.size()));
    std::transform(image.pixels.begin(), image.pixels.end(), reply->labels.get_buffer(),
                   [](double label) { return static_cast<CORBA::ULong>(label); });
    reply->names = services::ToIdl(description().name, reading).labels;
    return reply._retn();
  }
};

class ThermalCameraServant final : public SensorServant<POA_sba::ThermalCamera> {
 public:
  using SensorServant::SensorServant;
  sba::ThermalImage* take_temperatures() override {
    const Reading reading = Read();
    const auto image = In<readings::ThermalImage>(reading);
    sba::ThermalImage_var reply = new sba::ThermalImage;
    reply->time_ns = reading.time.count();
    reply->width = static_cast<CORBA::ULong>(image.width);
    reply->height = static_cast<CORBA::ULong>(image.height);
    reply->resolution_k = image.resolution;
    reply->pixels.length(static_cast<CORBA::ULong>(image.temperature.size()));
    std::transform(image.temperature.begin(), image.temperature.end(), reply->pixels.get_buffer(),
                   [&](double kelvin) {
                     return static_cast<CORBA::UShort>(std::lround(kelvin / image.resolution));
                   });
    return reply._retn();
  }
};

class NormalsCameraServant final : public SensorServant<POA_sba::NormalsCamera> {
 public:
  using SensorServant::SensorServant;
  sba::NormalImage* take_normals() override {
    const Reading reading = Read();
    const auto values = In<readings::NormalImage>(reading);
    sba::NormalImage_var image = new sba::NormalImage;
    image->time_ns = reading.time.count();
    image->width = static_cast<CORBA::ULong>(values.width);
    image->height = static_cast<CORBA::ULong>(values.height);
    image->normals.length(static_cast<CORBA::ULong>(values.normals.size()));
    std::transform(values.normals.begin(), values.normals.end(), image->normals.get_buffer(),
                   [](double component) { return static_cast<CORBA::Float>(component); });
    return image._retn();
  }
};

class BoundingBoxCameraServant final : public SensorServant<POA_sba::BoundingBoxCamera> {
 public:
  using SensorServant::SensorServant;
  sba::BoundingBoxes* detect() override {
    return ToSequence<sba::BoundingBoxes>(
        In<readings::BoundingBoxes>(Read()).boxes,
        [](const readings::BoundingBox& box, sba::BoundingBox& to) {
          to.name = box.name.c_str();
          to.left_px = box.left, to.top_px = box.top;
          to.right_px = box.right, to.bottom_px = box.bottom;
        });
  }
};

std::map<std::string, SensorServantMaker>& Makers() {
  static std::map<std::string, SensorServantMaker> makers = {
      {readings::Sonar::kType, MakeSensorServant<SonarServant>},
      {readings::Lidar::kType, MakeSensorServant<LidarServant>},
      {readings::Camera::kType, MakeSensorServant<CameraServant>},
      {readings::Camera::kWideAngleType, MakeSensorServant<CameraServant>},
      {readings::Positioning::kType, MakeSensorServant<PositioningServant>},
      {readings::Imu::kType, MakeSensorServant<ImuServant>},
      {readings::Odometry::kType, MakeSensorServant<OdometerServant>},
      {readings::Navsat::kType, MakeSensorServant<SatelliteReceiverServant>},
      {readings::Magnetometer::kType, MakeSensorServant<MagnetometerServant>},
      {readings::Altimeter::kType, MakeSensorServant<AltimeterServant>},
      {readings::Contact::kType, MakeSensorServant<BumperServant>},
      {readings::ForceTorque::kType, MakeSensorServant<ForceTorqueServant>},
      {readings::JointEncoders::kType, MakeSensorServant<JointEncodersServant>},
      {readings::Battery::kType, MakeSensorServant<BatteryServant>},
      {readings::LogicalCamera::kType, MakeSensorServant<LogicalCameraServant>},
      {readings::Radio::kType, MakeSensorServant<RadioServant>},
      {readings::Ranging::kType, MakeSensorServant<RangingServant>},
      {readings::DepthImage::kType, MakeSensorServant<DepthCameraServant>},
      {readings::SegmentedImage::kType, MakeSensorServant<SegmentationCameraServant>},
      {readings::BoundingBoxes::kType, MakeSensorServant<BoundingBoxCameraServant>},
      {readings::ThermalImage::kType, MakeSensorServant<ThermalCameraServant>},
      {readings::NormalImage::kType, MakeSensorServant<NormalsCameraServant>},
      {readings::Microphone::kType, MakeSensorServant<MicrophoneServant>},
      {readings::Gripper::kType, MakeGripperServant},
      {readings::Lamp::kType, MakeLampServant},
      {readings::Speaker::kType, MakeSpeakerServant},
  };
  return makers;
}

}  // namespace

void SensorServants::Register(const std::string& type, SensorServantMaker maker) {
  Makers()[type] = maker;
}

SensorServantMaker SensorServants::For(const std::string& type, bool takes_commands) {
  const auto it = Makers().find(type);
  if (it != Makers().end()) return it->second;
  return takes_commands ? MakeSensorServant<ActuatorServant<POA_sba::Actuator>>
                        : MakeSensorServant<SensorServant<POA_sba::Sensor>>;
}

}  // namespace gsv::services
