#include "gsv/services/sensor_servants.h"

#include <algorithm>
#include <map>

#include "gsv/base/base64.h"
#include "gsv/services/actuator_servants.h"
#include "idl/sensors.hh"

namespace gsv::services {
namespace {

using sensing::Reading;

sba::Vector VectorAt(const Reading& reading, std::size_t place) {
  return {reading.values.at(place), reading.values.at(place + 1), reading.values.at(place + 2)};
}

sba::Placement PlacementAt(const Reading& reading, std::size_t place) {
  const auto& v = reading.values;
  return {v.at(place),     v.at(place + 1), v.at(place + 2),
          v.at(place + 3), v.at(place + 4), v.at(place + 5)};
}

class SonarServant final : public SensorServant<POA_sba::Sonar> {
 public:
  using SensorServant::SensorServant;
  CORBA::Double range() override { return Read().values.at(0); }
  CORBA::Double max_range() override {
    return model::NumberOr(description().parameters, "max", 5.0);
  }
};

class LidarServant final : public SensorServant<POA_sba::Lidar> {
 public:
  using SensorServant::SensorServant;
  sba::Doubles* ranges() override {
    const Reading reading = Read();
    auto* ranges = new sba::Doubles;
    ranges->length(static_cast<CORBA::ULong>(reading.values.size()));
    std::copy(reading.values.begin(), reading.values.end(), ranges->get_buffer());
    return ranges;
  }
};

class CameraServant final : public SensorServant<POA_sba::Camera> {
 public:
  using SensorServant::SensorServant;
  sba::Picture* take_picture() override {
    const sba::Measurement measurement = ToIdl(description().name, Read());
    auto* picture = new sba::Picture;
    picture->width = measurement.image_width;
    picture->height = measurement.image_height;
    picture->rgb = measurement.image;
    picture->time_ns = measurement.time_ns;
    return picture;
  }
};

class PositioningServant final : public SensorServant<POA_sba::PositioningSystem> {
 public:
  using SensorServant::SensorServant;
  sba::Placement locate() override { return PlacementAt(Read(), 0); }
};

class ImuServant final : public SensorServant<POA_sba::Imu> {
 public:
  using SensorServant::SensorServant;
  sba::ImuReading feel() override {
    const Reading reading = Read();
    return {reading.time.count(), VectorAt(reading, 0), VectorAt(reading, 3)};
  }
};

class OdometerServant final : public SensorServant<POA_sba::Odometer> {
 public:
  using SensorServant::SensorServant;
  sba::OdometryReading reckon() override {
    const Reading reading = Read();
    const auto& v = reading.values;
    return {reading.time.count(), v.at(0), v.at(1), v.at(2), v.at(3), v.at(4)};
  }
};

class SatelliteReceiverServant final : public SensorServant<POA_sba::SatelliteReceiver> {
 public:
  using SensorServant::SensorServant;
  sba::SatelliteFix fix() override {
    const Reading reading = Read();
    const auto& v = reading.values;
    return {reading.time.count(), v.at(0), v.at(1), v.at(2), v.at(3), v.at(4), v.at(5)};
  }
};

class MagnetometerServant final : public SensorServant<POA_sba::Magnetometer> {
 public:
  using SensorServant::SensorServant;
  sba::Vector field_t() override { return VectorAt(Read(), 0); }
};

class AltimeterServant final : public SensorServant<POA_sba::Altimeter> {
 public:
  using SensorServant::SensorServant;
  sba::AltimeterReading height() override {
    const Reading reading = Read();
    const auto& v = reading.values;
    return {reading.time.count(), v.at(0), v.at(1), v.at(2)};
  }
};

class BumperServant final : public SensorServant<POA_sba::Bumper> {
 public:
  using SensorServant::SensorServant;
  CORBA::Boolean is_pressed() override { return !Read().values.empty(); }
  sba::TouchPoints* touches() override {
    const Reading reading = Read();
    sba::TouchPoints_var touches = new sba::TouchPoints;
    touches->length(static_cast<CORBA::ULong>(reading.values.size() / 8));
    for (CORBA::ULong i = 0; i < touches->length(); ++i) {
      sba::TouchPoint& touch = touches[i];
      touch.other = reading.labels->at(i).c_str();
      touch.point_m = VectorAt(reading, 8 * i);
      touch.normal = VectorAt(reading, 8 * i + 3);
      touch.depth_m = reading.values.at(8 * i + 6);
      touch.closing_speed_m_s = reading.values.at(8 * i + 7);
    }
    return touches._retn();
  }
};

class JointEncodersServant final : public SensorServant<POA_sba::JointEncoders> {
 public:
  using SensorServant::SensorServant;
  sba::EncoderReadings* joints() override {
    const Reading reading = Read();
    sba::EncoderReadings_var joints = new sba::EncoderReadings;
    joints->length(static_cast<CORBA::ULong>(reading.values.size() / 2));
    for (CORBA::ULong i = 0; i < joints->length(); ++i) {
      joints[i].joint = reading.labels->at(i).c_str();
      joints[i].position = reading.values.at(2 * i);
      joints[i].velocity = reading.values.at(2 * i + 1);
    }
    return joints._retn();
  }
};

class BatteryServant final : public SensorServant<POA_sba::Battery> {
 public:
  using SensorServant::SensorServant;
  sba::BatteryReading level() override {
    const Reading reading = Read();
    const auto& v = reading.values;
    return {reading.time.count(), v.at(0), v.at(1), v.at(2), v.at(3), v.at(4)};
  }
};

class LogicalCameraServant final : public SensorServant<POA_sba::LogicalCamera> {
 public:
  using SensorServant::SensorServant;
  sba::Sightings* look() override {
    const Reading reading = Read();
    sba::Sightings_var sightings = new sba::Sightings;
    sightings->length(static_cast<CORBA::ULong>(reading.values.size() / 6));
    for (CORBA::ULong i = 0; i < sightings->length(); ++i) {
      sightings[i].name = reading.labels->at(i).c_str();
      sightings[i].sensor_from_model = PlacementAt(reading, 6 * i);
    }
    return sightings._retn();
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
    const Reading reading = Read();
    sba::RadioMessages_var messages = new sba::RadioMessages;
    for (std::size_t i = 0; i < reading.values.size() / 3; ++i) {
      const auto number = static_cast<CORBA::ULongLong>(reading.values[3 * i]);
      if (number <= after) continue;
      messages->length(messages->length() + 1);
      sba::RadioMessage& message = messages[messages->length() - 1];
      message.sender = reading.labels->at(2 * i).c_str();
      message.number = number;
      message.sent_ns = base::FromSeconds(reading.values[3 * i + 1]).count();
      message.strength_dbm = reading.values[3 * i + 2];
      const auto content = base::FromBase64(reading.labels->at(2 * i + 1));
      message.content.length(static_cast<CORBA::ULong>(content->size()));
      std::copy(content->begin(), content->end(), message.content.get_buffer());
    }
    return messages._retn();
  }
};

class MicrophoneServant final : public SensorServant<POA_sba::Microphone> {
 public:
  using SensorServant::SensorServant;
  sba::Hearing* listen() override {
    const Reading reading = Read();
    sba::Hearing_var hearing = new sba::Hearing;
    hearing->time_ns = reading.time.count();
    hearing->level_db = reading.values.at(0);
    hearing->frequency_hz = reading.values.at(1);
    hearing->source = reading.labels->at(0).c_str();
    return hearing._retn();
  }
};

class DepthCameraServant final : public SensorServant<POA_sba::DepthCamera> {
 public:
  using SensorServant::SensorServant;
  sba::DepthPicture* take_depth() override {
    const Reading reading = Read();
    sba::DepthPicture_var picture = new sba::DepthPicture;
    picture->time_ns = reading.time.count();
    picture->width = static_cast<CORBA::ULong>(reading.values.at(0));
    picture->height = static_cast<CORBA::ULong>(reading.values.at(1));
    picture->depth_m.length(static_cast<CORBA::ULong>(reading.values.size() - 2));
    std::transform(reading.values.begin() + 2, reading.values.end(), picture->depth_m.get_buffer(),
                   [](double depth) { return static_cast<CORBA::Float>(depth); });
    return picture._retn();
  }
};

class SegmentationCameraServant final : public SensorServant<POA_sba::SegmentationCamera> {
 public:
  using SensorServant::SensorServant;
  sba::LabelPicture* segment() override {
    const Reading reading = Read();
    sba::LabelPicture_var picture = new sba::LabelPicture;
    picture->time_ns = reading.time.count();
    picture->width = static_cast<CORBA::ULong>(reading.values.at(0));
    picture->height = static_cast<CORBA::ULong>(reading.values.at(1));
    picture->labels.length(static_cast<CORBA::ULong>(reading.values.size() - 2));
    std::transform(reading.values.begin() + 2, reading.values.end(), picture->labels.get_buffer(),
                   [](double label) { return static_cast<CORBA::ULong>(label); });
    picture->names = ToIdl(description().name, reading).labels;
    return picture._retn();
  }
};

class BoundingBoxCameraServant final : public SensorServant<POA_sba::BoundingBoxCamera> {
 public:
  using SensorServant::SensorServant;
  sba::BoundingBoxes* detect() override {
    const Reading reading = Read();
    sba::BoundingBoxes_var boxes = new sba::BoundingBoxes;
    boxes->length(static_cast<CORBA::ULong>(reading.values.size() / 4));
    for (CORBA::ULong i = 0; i < boxes->length(); ++i) {
      const double* const v = &reading.values[4 * i];
      boxes[i].name = reading.labels->at(i).c_str();
      boxes[i].left_px = v[0], boxes[i].top_px = v[1];
      boxes[i].right_px = v[2], boxes[i].bottom_px = v[3];
    }
    return boxes._retn();
  }
};

std::map<std::string, SensorServantMaker>& Makers() {
  static std::map<std::string, SensorServantMaker> makers = {
      {"sonar", MakeSensorServant<SonarServant>},
      {"lidar", MakeSensorServant<LidarServant>},
      {"camera", MakeSensorServant<CameraServant>},
      {"wideangle_camera", MakeSensorServant<CameraServant>},
      {"positioning", MakeSensorServant<PositioningServant>},
      {"imu", MakeSensorServant<ImuServant>},
      {"odometry", MakeSensorServant<OdometerServant>},
      {"navsat", MakeSensorServant<SatelliteReceiverServant>},
      {"magnetometer", MakeSensorServant<MagnetometerServant>},
      {"altimeter", MakeSensorServant<AltimeterServant>},
      {"contact", MakeSensorServant<BumperServant>},
      {"joint_encoders", MakeSensorServant<JointEncodersServant>},
      {"battery", MakeSensorServant<BatteryServant>},
      {"logical_camera", MakeSensorServant<LogicalCameraServant>},
      {"radio", MakeSensorServant<RadioServant>},
      {"depth_camera", MakeSensorServant<DepthCameraServant>},
      {"segmentation_camera", MakeSensorServant<SegmentationCameraServant>},
      {"boundingbox_camera", MakeSensorServant<BoundingBoxCameraServant>},
      {"microphone", MakeSensorServant<MicrophoneServant>},
      {"gripper", MakeGripperServant},
      {"lamp", MakeLampServant},
      {"speaker", MakeSpeakerServant},
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
