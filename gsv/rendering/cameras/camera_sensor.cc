#include "gsv/rendering/cameras/camera_sensor.h"

#include <utility>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/rendering/cameras/camera_type.h"
#include "gsv/rendering/cameras/exposure.h"
#include "gsv/rendering/cameras/shutter.h"
#include "gsv/rendering/images/jpeg.h"

namespace gsv::rendering {
namespace {

using base::Fail;
using base::Result;

constexpr int kJpegQuality = 80;
constexpr std::size_t kSharedBytes = 64 << 20;  // enough for about 290 images of 320 by 240 pixels

class Camera final : public CameraOf<readings::Camera, messages::sensor_msgs::CompressedImage> {
 public:
  Camera(const model::SensorDescription& description, sensing::ParameterReader& reader,
         RendererResult renderer, const std::string& lens_type)
      : CameraOf(description, reader, std::move(renderer), lens_type),
        shutter_(reader),
        exposure_(reader) {}

  Result<sensing::Reading> Sample(const sensing::Sampling& sampling) const override {
    if (!renderer()) return Fail(renderer().error());
    auto image = shutter_.Take(sampling.snapshot(), [&](const auto& snapshot) {
      const geometry::Pose world_from_link =
          world::LinkPose(*snapshot, sampling.body(), description().link);
      return optics().Draw(**renderer(), snapshot,
                           world_from_link * description().link_from_sensor);
    });
    if (!image) return Fail(image.error());
    sensing::Reading reading = sampling.Stamped();
    Fill(Values{(*image)->width, (*image)->height}, reading);
    reading.image = std::move(*image);
    if (!exposure_.is_neutral()) {
      auto exposed = std::make_shared<model::Image>(*reading.image);
      exposure_.Apply(sampling, description(), *exposed);
      reading.image = std::move(exposed);
    }
    return reading;
  }

 private:
  // Makes the message of a reading. A reading without an image becomes a message without data.
  Message ToMessage(const Values&, const sensing::Reading& reading,
                    const std::string&) const override {
    Message message;
    message.format = "jpeg";
    if (reading.image == nullptr) return message;
    if (auto jpeg = EncodeJpeg(*reading.image, kJpegQuality)) message.data = std::move(*jpeg);
    return message;
  }

  const Shutter shutter_;
  const Exposure exposure_;
};

}  // namespace

base::Status AddCameraSensor(sensing::SensorRegistry& registry,
                             Result<std::shared_ptr<Renderer>> renderer) {
  const auto shared = std::make_shared<sensing::SharedReadings>(kSharedBytes);
  auto added =
      registry.Add(MakeCameraType<Camera>(readings::Camera::kType, {}, sensing::Overlay::kImage,
                                          shared, renderer, std::string("gnomonical")));
  if (!added) return added;
  // A wide-angle camera has the default lens of SDFormat.
  return registry.Add(MakeCameraType<Camera>(
      readings::Camera::kWideAngleType, {"wideanglecamera", "wide_angle_camera"},
      sensing::Overlay::kImage, shared, renderer, std::string("stereographic")));
}

}  // namespace gsv::rendering
