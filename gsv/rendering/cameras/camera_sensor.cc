#include "gsv/rendering/cameras/camera_sensor.h"

#include <utility>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/rendering/cameras/camera_info.h"
#include "gsv/rendering/cameras/exposure.h"
#include "gsv/rendering/cameras/optics.h"
#include "gsv/rendering/cameras/shutter.h"
#include "gsv/rendering/images/jpeg.h"
#include "gsv/sensing/encoding.h"
#include "gsv/sensing/shared_readings.h"

namespace gsv::rendering {
namespace {

using base::Fail;
using base::Result;

constexpr int kJpegQuality = 80;
constexpr std::size_t kSharedBytes = 64 << 20;  // some 290 pictures of 320 by 240

class Camera final : public sensing::Sensor {
 public:
  Camera(const model::SensorDescription& description, sensing::ParameterReader& reader,
         const std::string& lens_type, Result<std::shared_ptr<Renderer>> renderer)
      : Sensor(description),
        optics_(Optics::Read(reader, lens_type)),
        shutter_(reader),
        exposure_(reader),
        renderer_(std::move(renderer)) {}

  Result<sensing::Reading> Sample(const sensing::Sampling& sampling) const override {
    if (!renderer_) return Fail(renderer_.error());
    auto picture = shutter_.Take(sampling.snapshot(), [&](const auto& snapshot) {
      const geometry::Pose world_from_link =
          world::LinkPose(*snapshot, sampling.body(), description().link);
      return optics_.Draw(**renderer_, snapshot, world_from_link * description().link_from_sensor);
    });
    if (!picture) return Fail(picture.error());
    sensing::Reading reading = sampling.Stamped();
    reading.values = {static_cast<double>((*picture)->width),
                      static_cast<double>((*picture)->height)};
    reading.picture = std::move(*picture);
    if (!exposure_.is_neutral()) {
      auto exposed = std::make_shared<model::Image>(*reading.picture);
      exposure_.Apply(sampling, description(), *exposed);
      reading.picture = std::move(exposed);
    }
    return reading;
  }
  bool TakesLong() const override { return true; }

 private:
  Optics optics_;
  Shutter shutter_;
  Exposure exposure_;
  Result<std::shared_ptr<Renderer>> renderer_;
};

std::vector<std::uint8_t> Encode(const model::SensorDescription&, const sensing::Reading& reading,
                                 const std::string& frame_id) {
  messages::sensor_msgs::CompressedImage message;
  message.header = sensing::HeaderOf(reading, frame_id);
  message.format = "jpeg";
  // A reading without a picture becomes a message without data.
  if (reading.picture != nullptr) {
    if (auto jpeg = EncodeJpeg(*reading.picture, kJpegQuality)) message.data = std::move(*jpeg);
  }
  return sensing::Encoded(message);
}

}  // namespace

base::Status AddCameraSensor(sensing::SensorRegistry& registry,
                             Result<std::shared_ptr<Renderer>> renderer) {
  if (renderer && *renderer == nullptr) {
    renderer =
        Fail(base::ErrorCode::kUnavailable, "no renderer was started, so there are no pictures");
  }
  const auto readings = std::make_shared<sensing::SharedReadings>(kSharedBytes);
  // The lens of a wide-angle camera is what SDFormat says it is without a <lens>.
  const std::pair<const char*, const char*> kinds[] = {{"camera", "gnomonical"},
                                                       {"wideangle_camera", "stereographic"}};
  for (const auto& [name, lens_type] : kinds) {
    sensing::SensorType type;
    type.name = name;
    if (type.name != "camera") type.aliases = {"wideanglecamera", "wide_angle_camera"};
    type.create = [renderer,
                   lens = std::string(lens_type)](const model::SensorDescription& description)
        -> Result<std::unique_ptr<sensing::Sensor>> {
      sensing::ParameterReader reader(description);
      auto camera = std::make_unique<Camera>(description, reader, lens, renderer);
      if (!reader.status()) return Fail(reader.status().error());
      return camera;
    };
    sensing::Share(type, readings);
    type.schema = &messages::SchemaOf<messages::sensor_msgs::CompressedImage>();
    type.encode = Encode;
    type.companion = CameraInfoCompanion(lens_type);
    type.overlay = sensing::Overlay::kPicture;
    if (auto added = registry.Add(std::move(type)); !added) return added;
  }
  return {};
}

}  // namespace gsv::rendering
