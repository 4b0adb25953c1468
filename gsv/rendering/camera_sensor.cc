#include "gsv/rendering/camera_sensor.h"

#include <utility>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/rendering/camera_parameters.h"
#include "gsv/rendering/jpeg.h"
#include "gsv/sensing/encoding.h"

namespace gsv::rendering {
namespace {

using base::Fail;
using base::Result;

constexpr int kJpegQuality = 80;

Result<CameraParameters> ReadParameters(const model::SensorDescription& description) {
  sensing::ParameterReader reader(description);
  const CameraParameters camera = ReadCameraParameters(reader);
  if (!reader.status()) return Fail(reader.status().error());
  return camera;
}

class Camera final : public sensing::Sensor {
 public:
  Camera(const model::SensorDescription& description, const CameraParameters& parameters,
         Result<std::shared_ptr<Renderer>> renderer)
      : Sensor(description), parameters_(parameters), renderer_(std::move(renderer)) {}

  Result<sensing::Reading> Sample(const sensing::Sampling& sampling) const override {
    if (!renderer_) return Fail(renderer_.error());
    auto picture =
        (*renderer_)
            ->Draw(sampling.snapshot(), {sampling.WorldFromSensor(description()), parameters_});
    if (!picture) return Fail(picture.error());
    sensing::Reading reading = sampling.Stamped();
    reading.values = {static_cast<double>(parameters_.width),
                      static_cast<double>(parameters_.height)};
    reading.picture = std::move(*picture);
    return reading;
  }
  bool TakesLong() const override { return true; }

 private:
  CameraParameters parameters_;
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
  sensing::SensorType type;
  type.name = "camera";
  type.create =
      [renderer = std::move(renderer)](
          const model::SensorDescription& description) -> Result<std::unique_ptr<sensing::Sensor>> {
    const auto parameters = ReadParameters(description);
    if (!parameters) return Fail(parameters.error());
    return std::make_unique<Camera>(description, *parameters, renderer);
  };
  type.schema = &messages::SchemaOf<messages::sensor_msgs::CompressedImage>();
  type.encode = Encode;
  type.overlay = sensing::Overlay::kPicture;
  return registry.Add(std::move(type));
}

}  // namespace gsv::rendering
