#include "gsv/rendering/cameras/survey_sensors.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <utility>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/messages/vision_msgs.h"
#include "gsv/rendering/cameras/camera_info.h"
#include "gsv/rendering/cameras/optics.h"
#include "gsv/rendering/images/png.h"
#include "gsv/sensing/noise.h"
#include "gsv/sensing/sensor_type.h"
#include "gsv/sensing/shared_readings.h"

namespace gsv::rendering {
namespace {

using base::Fail;
using base::Result;
using geometry::Vector3;
using sensing::Reading;
using sensing::Segment;
using RendererResult = Result<std::shared_ptr<Renderer>>;

constexpr std::size_t kHead = 2;  // values before the pixels': width and height
constexpr std::size_t kSharedSurveyBytes = 64 << 20;
constexpr std::size_t kMostDrawn = 2000;  // points of a cloud in the viewer

// For one metre along the view; nothing where the lens shows nothing, or what lies straight beside
// the camera.
std::optional<Vector3> OneMetreOn(const std::optional<Vector3>& ray) {
  if (!ray || std::abs(ray->x) < 1e-6) return std::nullopt;
  return (1 / ray->x) * *ray;
}

Optics OpticsOf(const model::SensorDescription& description) {
  sensing::ParameterReader reader(description);
  return Optics::Read(reader);
}

class SurveySensor : public sensing::Sensor {
 public:
  SurveySensor(const model::SensorDescription& description, sensing::ParameterReader& reader,
               RendererResult renderer)
      : Sensor(description), optics_(Optics::Read(reader)), renderer_(std::move(renderer)) {}

  Result<Reading> Sample(const sensing::Sampling& sampling) const override {
    if (!renderer_) return Fail(renderer_.error());
    const auto truth =
        optics_.Survey(**renderer_, sampling.snapshot(), sampling.WorldFromSensor(description()));
    if (!truth) return Fail(truth.error());
    return Read(sampling, **truth);
  }
  bool TakesLong() const override { return true; }

 private:
  virtual Reading Read(const sensing::Sampling& sampling, const GroundTruth& truth) const = 0;

  Optics optics_;
  RendererResult renderer_;
};

Reading WithSize(const sensing::Sampling& sampling, const GroundTruth& truth) {
  Reading reading = sampling.Stamped();
  reading.values.reserve(kHead + truth.depth.size());
  reading.values.push_back(truth.width);
  reading.values.push_back(truth.height);
  return reading;
}

class DepthCamera final : public SurveySensor {
 public:
  DepthCamera(const model::SensorDescription& description, sensing::ParameterReader& reader,
              RendererResult renderer)
      : SurveySensor(description, reader, std::move(renderer)),
        noise_(ReadNoise(reader, "noise", 1e3)) {}

  static messages::sensor_msgs::PointCloud2 ToMessage(const model::SensorDescription& description,
                                                      const Reading& reading, const std::string&) {
    using messages::sensor_msgs::PointField;
    messages::sensor_msgs::PointCloud2 cloud;
    const char* const names[] = {"x", "y", "z"};
    for (std::uint32_t i = 0; i < 3; ++i) {
      cloud.fields.push_back({names[i], 4 * i, PointField::kFloat32, 1});
    }
    cloud.point_step = 12;
    if (reading.values.size() < kHead) return cloud;
    const Optics optics = OpticsOf(description);
    cloud.width = static_cast<std::uint32_t>(reading.values[0]);
    cloud.height = static_cast<std::uint32_t>(reading.values[1]);
    cloud.row_step = cloud.point_step * cloud.width;
    cloud.data.resize(std::size_t{cloud.row_step} * cloud.height);
    for (std::size_t i = 0; i + kHead < reading.values.size(); ++i) {
      const double depth = reading.values[kHead + i];
      const auto ray = OneMetreOn(optics.RayOfPixel(i));
      const Vector3 point = ray && std::isfinite(depth)
                                ? depth * *ray
                                : Vector3{1, 1, 1} * std::numeric_limits<double>::quiet_NaN();
      const float xyz[] = {static_cast<float>(point.x), static_cast<float>(point.y),
                           static_cast<float>(point.z)};
      std::memcpy(&cloud.data[12 * i], xyz, sizeof xyz);
    }
    return cloud;
  }

 private:
  Reading Read(const sensing::Sampling& sampling, const GroundTruth& truth) const override {
    Reading reading = WithSize(sampling, truth);
    const sensing::NoisyReading noisy(sampling, description());
    for (std::size_t i = 0; i < truth.depth.size(); ++i) {
      const double depth = truth.depth[i];
      reading.values.push_back(
          noise_.is_none() || !std::isfinite(depth) ? depth : noisy.Read(noise_, i, depth));
    }
    return reading;
  }

  const sensing::NoiseModel noise_;
};

std::vector<Segment> CloudPoints(const model::SensorDescription& description,
                                 const Reading& reading) {
  std::vector<Segment> beams;
  if (reading.values.size() <= kHead) return beams;
  const Optics optics = OpticsOf(description);
  const std::size_t pixels = reading.values.size() - kHead;
  for (std::size_t i = 0; i < pixels; i += 1 + pixels / kMostDrawn) {
    const double depth = reading.values[kHead + i];
    if (!std::isfinite(depth)) continue;
    const auto ray = OneMetreOn(optics.RayOfPixel(i));
    if (ray) beams.push_back({{}, depth * *ray});
  }
  return beams;
}

// An odd factor: no two labels below 2^24 have the same colour.
std::uint32_t ColourOf(std::uint32_t label) { return (label * 0x9E3779u) & 0xFFFFFFu; }

class SegmentationCamera final : public SurveySensor {
 public:
  using SurveySensor::SurveySensor;

  static messages::sensor_msgs::CompressedImage ToMessage(const model::SensorDescription&,
                                                          const Reading& reading,
                                                          const std::string&) {
    messages::sensor_msgs::CompressedImage message;
    message.format = "png";
    if (reading.picture != nullptr) {
      if (auto png = EncodePng(*reading.picture)) message.data = std::move(*png);
    }
    return message;
  }

 private:
  Reading Read(const sensing::Sampling& sampling, const GroundTruth& truth) const override {
    Reading reading = WithSize(sampling, truth);
    auto picture = std::make_shared<model::Image>();
    picture->width = truth.width, picture->height = truth.height;
    picture->pixels.reserve(3 * truth.body.size());
    for (const std::int32_t body : truth.body) {
      const auto label = static_cast<std::uint32_t>(body + 1);
      const std::uint32_t colour = ColourOf(label);
      reading.values.push_back(label);
      for (const int shift : {16, 8, 0}) {
        picture->pixels.push_back(static_cast<std::uint8_t>(colour >> shift));
      }
    }
    reading.picture = std::move(picture);
    auto labels = std::make_shared<std::vector<std::string>>();
    for (const world::Body& body : sampling.snapshot()->layout->bodies) {
      labels->push_back(body.name);
    }
    reading.labels = std::move(labels);
    return reading;
  }
};

class BoundingBoxCamera final : public SurveySensor {
 public:
  using SurveySensor::SurveySensor;

  static messages::vision_msgs::Detection2DArray ToMessage(const model::SensorDescription&,
                                                           const Reading& reading,
                                                           const std::string& frame_id) {
    messages::vision_msgs::Detection2DArray message;
    for (std::size_t i = 0; reading.labels != nullptr && i < reading.labels->size(); ++i) {
      const double* const v = &reading.values[4 * i];
      messages::vision_msgs::Detection2D detection;
      detection.header = sensing::HeaderOf(reading, frame_id);
      detection.id = (*reading.labels)[i];
      detection.bbox.center.position = {(v[0] + v[2]) / 2, (v[1] + v[3]) / 2};
      detection.bbox.size_x = v[2] - v[0];
      detection.bbox.size_y = v[3] - v[1];
      message.detections.push_back(std::move(detection));
    }
    return message;
  }

 private:
  struct PixelBox {
    int left = std::numeric_limits<int>::max(), top = left, right = -1, bottom = -1;
  };

  Reading Read(const sensing::Sampling& sampling, const GroundTruth& truth) const override {
    const auto& bodies = sampling.snapshot()->layout->bodies;
    std::vector<PixelBox> boxes(bodies.size());
    for (int y = 0; y < truth.height; ++y) {
      for (int x = 0; x < truth.width; ++x) {
        const std::int32_t body = truth.body[static_cast<std::size_t>(y) * truth.width + x];
        if (body < 0) continue;
        PixelBox& box = boxes[static_cast<std::size_t>(body)];
        box = {std::min(box.left, x), std::min(box.top, y), std::max(box.right, x),
               std::max(box.bottom, y)};
      }
    }
    Reading reading = sampling.Stamped();
    auto labels = std::make_shared<std::vector<std::string>>();
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (boxes[i].right < 0) continue;
      for (const int edge :
           {boxes[i].left, boxes[i].top, boxes[i].right + 1, boxes[i].bottom + 1}) {
        reading.values.push_back(edge);
      }
      labels->push_back(bodies[i].name);
    }
    reading.labels = std::move(labels);
    return reading;
  }
};

// Each box as a frame at a distance of 1 m.
std::vector<Segment> BoxFrames(const model::SensorDescription& description,
                               const Reading& reading) {
  const Optics optics = OpticsOf(description);
  const auto corner = [&](double u, double v) { return OneMetreOn(optics.lens().RayAt(u, v)); };
  std::vector<Segment> lines;
  for (std::size_t i = 0; i + 4 <= reading.values.size(); i += 4) {
    const double* const v = &reading.values[i];
    const std::optional<Vector3> corners[] = {corner(v[0], v[1]), corner(v[2], v[1]),
                                              corner(v[2], v[3]), corner(v[0], v[3])};
    for (int k = 0; k < 4; ++k) {
      const auto &from = corners[k], &to = corners[(k + 1) % 4];
      if (from && to) lines.push_back({*from, *to});
    }
  }
  return lines;
}

// MakeSensorType() for those that need a renderer.
template <typename Kind, typename Message>
sensing::SensorType TypeWith(const RendererResult& renderer, std::string name,
                             std::vector<std::string> aliases) {
  auto type = sensing::MakeSensorTypeBy<Kind, Message>(
      std::move(name), std::move(aliases),
      [renderer](const model::SensorDescription& description, sensing::ParameterReader& reader) {
        return std::make_unique<Kind>(description, reader, renderer);
      });
  return type;
}

}  // namespace

base::Status AddSurveySensors(sensing::SensorRegistry& registry, const RendererResult& given) {
  RendererResult renderer = given;
  if (renderer && *renderer == nullptr) {
    renderer =
        Fail(base::ErrorCode::kUnavailable, "no renderer was started, so there are no pictures");
  }
  auto depth = TypeWith<DepthCamera, messages::sensor_msgs::PointCloud2>(
      renderer, "depth_camera", {"depth", "rgbd_camera", "rgbd"});
  depth.overlay = sensing::Overlay::kPoints;
  depth.beams = CloudPoints;
  auto segmentation = TypeWith<SegmentationCamera, messages::sensor_msgs::CompressedImage>(
      renderer, "segmentation_camera", {"segmentation"});
  segmentation.overlay = sensing::Overlay::kPicture;
  auto boxes = TypeWith<BoundingBoxCamera, messages::vision_msgs::Detection2DArray>(
      renderer, "boundingbox_camera", {"boundingbox"});
  boxes.overlay = sensing::Overlay::kLines;
  boxes.beams = BoxFrames;
  const auto readings = std::make_shared<sensing::SharedReadings>(kSharedSurveyBytes);
  for (sensing::SensorType* type : {&depth, &segmentation, &boxes}) {
    sensing::Share(*type, readings);
    type->companion = CameraInfoCompanion();
    if (auto ok = registry.Add(std::move(*type)); !ok) return ok;
  }
  return {};
}

}  // namespace gsv::rendering
