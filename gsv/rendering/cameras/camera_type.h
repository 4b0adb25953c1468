// The base class of all camera sensors. A camera has a lens and a renderer, sends a CameraInfo
// message with each reading, and caches its readings.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gsv/rendering/cameras/camera_info.h"
#include "gsv/rendering/cameras/optics.h"
#include "gsv/sensing/sensor_type.h"
#include "gsv/sensing/shared_readings.h"

namespace gsv::rendering {

// The result of Renderer::Start(), which may be a failure.
using RendererResult = base::Result<std::shared_ptr<Renderer>>;

// Base class of camera sensors with these values and this message.
template <typename Values, typename Message>
class CameraOf : public sensing::SensorOf<Values, Message> {
 public:
  // `lens_type` is the lens of cameras whose parameters do not name a lens.
  CameraOf(const model::SensorDescription& description, sensing::ParameterReader& reader,
           RendererResult renderer, const std::string& lens_type = "gnomonical")
      : sensing::SensorOf<Values, Message>(description),
        optics_(Optics::Read(reader, lens_type)),
        renderer_(std::move(renderer)) {}

  bool TakesLong() const override { return true; }
  std::optional<sensing::Frustum> frustum() const override { return optics_.frustum(); }
  sensing::Sensor::Bytes EncodeCompanion(base::SimTime time,
                                         const std::string& frame_id) const override {
    return EncodeCameraInfo(optics_.lens(), time, frame_id);
  }

 protected:
  const Optics& optics() const { return optics_; }
  const RendererResult& renderer() const { return renderer_; }

 private:
  const Optics optics_;
  const RendererResult renderer_;
};

// Makes the sensor type of the class `Kind`, which derives from CameraOf. Without a renderer,
// sensors of this type can be created, but reading them fails.
template <typename Kind, typename... Context>
sensing::SensorType MakeCameraType(std::string name, std::vector<std::string> aliases,
                                   sensing::Overlay overlay,
                                   std::shared_ptr<sensing::SharedReadings> readings,
                                   RendererResult renderer, Context... context) {
  if (renderer && *renderer == nullptr) {
    renderer = base::Fail(base::ErrorCode::kUnavailable,
                          "no renderer was started, so there are no images");
  }
  auto type = sensing::MakeSensorType<Kind>(std::move(name), std::move(aliases), overlay,
                                            std::move(renderer), std::move(context)...);
  sensing::Share(type, std::move(readings));
  type.companion = CameraInfoCompanion();
  return type;
}

}  // namespace gsv::rendering
