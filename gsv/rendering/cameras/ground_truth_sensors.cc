#include "gsv/rendering/cameras/ground_truth_sensors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <map>
#include <optional>
#include <utility>

#include "gsv/messages/sensor_msgs.h"
#include "gsv/messages/vision_msgs.h"
#include "gsv/rendering/cameras/camera_type.h"
#include "gsv/rendering/images/png.h"
#include "gsv/sensing/noise.h"

namespace gsv::rendering {
namespace {

using base::Fail;
using base::Result;
using geometry::Vector3;
using sensing::Reading;
using sensing::Segment;

constexpr std::size_t kSharedSurveyBytes = 64 << 20;
// the maximum number of points of a point cloud that the viewer shows
constexpr std::size_t kMaxDrawnPoints = 2000;

// Scales a pixel's ray so that its component along the view is 1 m. Returns nullopt if the lens
// shows nothing there, or if the ray is perpendicular to the view.
std::optional<Vector3> OneMetreOn(const std::optional<Vector3>& ray) {
  if (!ray || std::abs(ray->x) < 1e-6) return std::nullopt;
  return (1 / ray->x) * *ray;
}

template <typename Values, typename Message>
class SurveySensor : public CameraOf<Values, Message> {
 public:
  using CameraOf<Values, Message>::CameraOf;

  Result<Reading> Sample(const sensing::Sampling& sampling) const override {
    if (!this->renderer()) return Fail(this->renderer().error());
    const auto truth = this->optics().DrawGroundTruth(
        **this->renderer(), sampling.snapshot(), sampling.WorldFromSensor(this->description()));
    if (!truth) return Fail(truth.error());
    return Read(sampling, **truth);
  }

 private:
  virtual Reading Read(const sensing::Sampling& sampling, const GroundTruth& truth) const = 0;
};

class DepthCamera final
    : public SurveySensor<readings::DepthImage, messages::sensor_msgs::PointCloud2> {
 public:
  DepthCamera(const model::SensorDescription& description, sensing::ParameterReader& reader,
              RendererResult renderer)
      : SurveySensor(description, reader, std::move(renderer)),
        noise_(ReadNoise(reader, "noise", 1e3)) {}

 private:
  Reading Read(const sensing::Sampling& sampling, const GroundTruth& truth) const override {
    std::vector<double> depth(truth.depth.begin(), truth.depth.end());
    if (!noise_.is_none()) {
      const sensing::NoisyReading noisy(sampling, description());
      for (std::size_t i = 0; i < depth.size(); ++i) {
        if (std::isfinite(depth[i])) depth[i] = noisy.Read(noise_, i, depth[i]);
      }
    }
    Reading reading = sampling.Stamped();
    Fill(Values{truth.width, truth.height, depth}, reading);
    return reading;
  }

  Message ToMessage(const Values& image, const Reading&, const std::string&) const override {
    using messages::sensor_msgs::PointField;
    Message cloud;
    const char* const names[] = {"x", "y", "z"};
    for (std::uint32_t i = 0; i < 3; ++i) {
      cloud.fields.push_back({names[i], 4 * i, PointField::kFloat32, 1});
    }
    cloud.point_step = 12;
    cloud.width = static_cast<std::uint32_t>(image.width);
    cloud.height = static_cast<std::uint32_t>(image.height);
    cloud.row_step = cloud.point_step * cloud.width;
    cloud.data.resize(std::size_t{cloud.row_step} * cloud.height);
    for (std::size_t i = 0; i < image.depth.size(); ++i) {
      const auto ray = OneMetreOn(optics().RayOfPixel(i));
      const Vector3 point = ray && std::isfinite(image.depth[i])
                                ? image.depth[i] * *ray
                                : Vector3{1, 1, 1} * std::numeric_limits<double>::quiet_NaN();
      const float xyz[] = {static_cast<float>(point.x), static_cast<float>(point.y),
                           static_cast<float>(point.z)};
      std::memcpy(&cloud.data[12 * i], xyz, sizeof xyz);
    }
    return cloud;
  }

  std::vector<Segment> BeamsOf(const Values& image) const override {
    std::vector<Segment> beams;
    const std::size_t pixels = image.depth.size();
    for (std::size_t i = 0; i < pixels; i += 1 + pixels / kMaxDrawnPoints) {
      if (!std::isfinite(image.depth[i])) continue;
      const auto ray = OneMetreOn(optics().RayOfPixel(i));
      if (ray) beams.push_back({{}, image.depth[i] * *ray});
    }
    return beams;
  }

  const sensing::NoiseModel noise_;
};

// Returns the reading's image as PNG.
messages::sensor_msgs::CompressedImage PngOf(const Reading& reading) {
  messages::sensor_msgs::CompressedImage message;
  message.format = "png";
  if (reading.image == nullptr) return message;
  if (auto png = EncodePng(*reading.image)) message.data = std::move(*png);
  return message;
}

// The factor is odd, so different labels below 2^24 have different colours.
std::uint32_t ColourOf(std::uint32_t label) { return (label * 0x9E3779u) & 0xFFFFFFu; }

class SegmentationCamera final
    : public SurveySensor<readings::SegmentedImage, messages::sensor_msgs::CompressedImage> {
 public:
  using SurveySensor::SurveySensor;

 private:
  Reading Read(const sensing::Sampling& sampling, const GroundTruth& truth) const override {
    auto image = std::make_shared<model::Image>();
    image->width = truth.width, image->height = truth.height;
    image->pixels.reserve(3 * truth.body.size());
    std::vector<double> pixels;
    pixels.reserve(truth.body.size());
    for (const std::int32_t body : truth.body) {
      const auto label = static_cast<std::uint32_t>(body + 1);
      const std::uint32_t colour = ColourOf(label);
      pixels.push_back(label);
      for (const int shift : {16, 8, 0}) {
        image->pixels.push_back(static_cast<std::uint8_t>(colour >> shift));
      }
    }
    std::vector<std::string> names;
    for (const world::Body& body : sampling.snapshot()->layout->bodies) names.push_back(body.name);
    Reading reading = sampling.Stamped();
    Fill(Values{truth.width, truth.height, pixels, names}, reading);
    reading.image = std::move(image);
    return reading;
  }

  Message ToMessage(const Values&, const Reading& reading, const std::string&) const override {
    return PngOf(reading);
  }
};

class BoundingBoxCamera final
    : public SurveySensor<readings::BoundingBoxes, messages::vision_msgs::Detection2DArray> {
 public:
  using SurveySensor::SurveySensor;

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
    Values seen;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (boxes[i].right < 0) continue;
      seen.boxes.push_back({.name = bodies[i].name,
                            .left = static_cast<double>(boxes[i].left),
                            .top = static_cast<double>(boxes[i].top),
                            .right = boxes[i].right + 1.0,
                            .bottom = boxes[i].bottom + 1.0});
    }
    Reading reading = sampling.Stamped();
    Fill(seen, reading);
    return reading;
  }

  Message ToMessage(const Values& seen, const Reading& reading,
                    const std::string& frame_id) const override {
    Message message;
    for (const readings::BoundingBox& box : seen.boxes) {
      messages::vision_msgs::Detection2D detection;
      detection.header = sensing::HeaderOf(reading, frame_id);
      detection.id = box.name;
      detection.bbox.center.position = {(box.left + box.right) / 2, (box.top + box.bottom) / 2};
      detection.bbox.size_x = box.right - box.left;
      detection.bbox.size_y = box.bottom - box.top;
      message.detections.push_back(std::move(detection));
    }
    return message;
  }

  // Draws each bounding box as a frame, 1 m in front of the camera.
  std::vector<Segment> BeamsOf(const Values& seen) const override {
    const auto corner = [&](double u, double v) { return OneMetreOn(optics().lens().RayAt(u, v)); };
    std::vector<Segment> lines;
    for (const readings::BoundingBox& box : seen.boxes) {
      const std::optional<Vector3> corners[] = {
          corner(box.left, box.top), corner(box.right, box.top), corner(box.right, box.bottom),
          corner(box.left, box.bottom)};
      for (int k = 0; k < 4; ++k) {
        const auto &from = corners[k], &to = corners[(k + 1) % 4];
        if (from && to) lines.push_back({*from, *to});
      }
    }
    return lines;
  }
};

// Returns the temperature of each visual of a body, in the order of the visuals in a depth and
// label image.
std::vector<double> TemperaturesOf(const world::Body& body, double of_air) {
  std::vector<double> temperatures;
  for (const model::Link& link : body.model->links) {
    for (const model::Visual& visual : link.visuals) {
      temperatures.push_back(visual.temperature.value_or(of_air));
    }
  }
  return temperatures;
}

class ThermalCamera final
    : public SurveySensor<readings::ThermalImage, messages::sensor_msgs::CompressedImage> {
 public:
  ThermalCamera(const model::SensorDescription& description, sensing::ParameterReader& reader,
                RendererResult renderer)
      : SurveySensor(description, reader, std::move(renderer)),
        resolution_(reader.Number("resolution", 0.01, 1e-6, 100)),
        noise_(ReadNoise(reader, "noise", 1e3)) {}

 private:
  static constexpr double kMaxSteps = 65535;

  Reading Read(const sensing::Sampling& sampling, const GroundTruth& truth) const override {
    const world::Layout& layout = *sampling.snapshot()->layout;
    const double of_air = layout.description->temperature;
    std::map<std::int32_t, std::vector<double>> known;  // temperatures of the visible bodies
    const sensing::NoisyReading noisy(sampling, description());
    std::vector<double> temperature(truth.body.size(), Stepped(of_air));
    for (std::size_t i = 0; i < temperature.size(); ++i) {
      double kelvin = of_air;
      if (const std::int32_t body = truth.body[i]; body >= 0) {
        auto& its = known[body];
        if (its.empty()) {
          its = TemperaturesOf(layout.bodies[static_cast<std::size_t>(body)], of_air);
        }
        kelvin = its[static_cast<std::size_t>(truth.visual[i])];
      }
      temperature[i] = Stepped(noise_.is_none() ? kelvin : noisy.Read(noise_, i, kelvin));
    }
    Reading reading = sampling.Stamped();
    Fill(Values{truth.width, truth.height, resolution_, temperature}, reading);
    return reading;
  }

  // The message has the format mono16 of ROS's image_transport.
  Message ToMessage(const Values& image, const Reading&, const std::string&) const override {
    std::vector<std::uint16_t> steps;
    steps.reserve(image.temperature.size());
    for (const double kelvin : image.temperature) {
      steps.push_back(static_cast<std::uint16_t>(StepsOf(kelvin)));
    }
    Message message;
    message.format = "mono16; png compressed";
    if (auto png = EncodeGreyPng(image.width, image.height, steps)) message.data = std::move(*png);
    return message;
  }

  // Converts a temperature to steps. A pixel that is lost to dropout reads 0 K.
  double StepsOf(double kelvin) const {
    return std::isfinite(kelvin) ? std::clamp(std::round(kelvin / resolution_), 0.0, kMaxSteps) : 0;
  }
  double Stepped(double kelvin) const { return resolution_ * StepsOf(kelvin); }

  const double resolution_;  // K per step of a pixel value
  const sensing::NoiseModel noise_;
};

// Computes surface normals from a depth image. A tangent is the difference between the points of a
// pixel and of a neighbour of the same visual, in the row or in the column. If the neighbours on
// both sides are of this visual, the one on the flatter side is used. So a normal near an edge
// belongs to the pixel's own face.
//
// Bend() measures flatness. In a pinhole image of a plane, the inverse depth is linear along a row
// and along a column. So the second difference of the inverse depth shows the deviation from a
// plane.
class SurfaceNormals {
 public:
  SurfaceNormals(const GroundTruth& truth, const Optics& optics) : truth_(truth) {
    points_.reserve(truth.depth.size());
    for (std::size_t i = 0; i < truth.depth.size(); ++i) {
      const auto ray = OneMetreOn(optics.RayOfPixel(i));
      const bool is_hit = ray && truth.body[i] >= 0 && std::isfinite(truth.depth[i]);
      points_.push_back(is_hit ? std::optional(truth.depth[i] * *ray) : std::nullopt);
    }
  }

  // Returns the normal of a pixel, which points towards the camera; nullopt if it is unknown.
  std::optional<Vector3> At(int x, int y) const {
    if (!points_[Index(x, y)]) return std::nullopt;
    const auto across = Tangent(x, y, 1, 0), down = Tangent(x, y, 0, 1);
    if (!across || !down) return std::nullopt;
    const Vector3 normal = Cross(*across, *down);
    const double length = Norm(normal);
    if (!(length > 0)) return std::nullopt;
    return (Dot(normal, *points_[Index(x, y)]) > 0 ? -1 / length : 1 / length) * normal;
  }

 private:
  std::size_t Index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(truth_.width) +
           static_cast<std::size_t>(x);
  }

  bool IsOfVisualAt(std::size_t pixel, int x, int y) const {
    if (x < 0 || y < 0 || x >= truth_.width || y >= truth_.height) return false;
    const std::size_t other = Index(x, y);
    return points_[other] && truth_.body[other] == truth_.body[pixel] &&
           truth_.visual[other] == truth_.visual[pixel];
  }

  // Returns how much three points deviate from a straight line: the points of the pixel (x, y) and
  // of the next two pixels in the direction (dx, dy). Infinite if the last pixel is not of the same
  // visual.
  double Bend(int x, int y, int dx, int dy) const {
    const std::size_t pixel = Index(x, y);
    if (!IsOfVisualAt(pixel, x + 2 * dx, y + 2 * dy)) {
      return std::numeric_limits<double>::infinity();
    }
    const auto inverse = [&](int k) { return 1.0 / truth_.depth[Index(x + k * dx, y + k * dy)]; };
    return std::abs(inverse(0) - 2 * inverse(1) + inverse(2));
  }

  std::optional<Vector3> Tangent(int x, int y, int dx, int dy) const {
    const std::size_t pixel = Index(x, y);
    const bool has_next = IsOfVisualAt(pixel, x + dx, y + dy);
    const bool has_previous = IsOfVisualAt(pixel, x - dx, y - dy);
    if (!has_next && !has_previous) return std::nullopt;
    const bool takes_next =
        has_next && (!has_previous || Bend(x, y, dx, dy) <= Bend(x, y, -dx, -dy));
    return takes_next ? *points_[Index(x + dx, y + dy)] - *points_[pixel]
                      : *points_[pixel] - *points_[Index(x - dx, y - dy)];
  }

  const GroundTruth& truth_;
  // by pixel, in the sensor frame; nullopt if the ray hits no surface
  std::vector<std::optional<Vector3>> points_;
};

class NormalsCamera final
    : public SurveySensor<readings::NormalImage, messages::sensor_msgs::CompressedImage> {
 public:
  using SurveySensor::SurveySensor;

 private:
  Reading Read(const sensing::Sampling& sampling, const GroundTruth& truth) const override {
    const SurfaceNormals normals(truth, optics());
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    std::vector<double> components;
    components.reserve(3 * truth.depth.size());
    for (int y = 0; y < truth.height; ++y) {
      for (int x = 0; x < truth.width; ++x) {
        const Vector3 n = normals.At(x, y).value_or(Vector3{unknown, unknown, unknown});
        components.insert(components.end(), {n.x, n.y, n.z});
      }
    }
    Reading reading = sampling.Stamped();
    reading.image = ImageOf(truth, components);
    Fill(Values{truth.width, truth.height, components}, reading);
    return reading;
  }

  static std::shared_ptr<model::Image> ImageOf(const GroundTruth& truth,
                                               const std::vector<double>& components) {
    auto image = std::make_shared<model::Image>();
    image->width = truth.width, image->height = truth.height;
    image->pixels.reserve(components.size());
    for (const double c : components) {
      image->pixels.push_back(
          std::isfinite(c) ? static_cast<std::uint8_t>(std::lround(255 * (c + 1) / 2)) : 0);
    }
    return image;
  }

  Message ToMessage(const Values&, const Reading& reading, const std::string&) const override {
    return PngOf(reading);
  }
};

}  // namespace

base::Status AddGroundTruthSensors(sensing::SensorRegistry& registry,
                                   const RendererResult& renderer) {
  using sensing::Overlay;
  const auto shared = std::make_shared<sensing::SharedReadings>(kSharedSurveyBytes);
  std::array types{
      MakeCameraType<DepthCamera>(readings::DepthImage::kType, {"depth", "rgbd_camera", "rgbd"},
                                  Overlay::kPoints, shared, renderer),
      MakeCameraType<SegmentationCamera>(readings::SegmentedImage::kType, {"segmentation"},
                                         Overlay::kImage, shared, renderer),
      MakeCameraType<BoundingBoxCamera>(readings::BoundingBoxes::kType, {"boundingbox"},
                                        Overlay::kLines, shared, renderer),
      MakeCameraType<ThermalCamera>(readings::ThermalImage::kType, {"thermal"}, Overlay::kImage,
                                    shared, renderer),
      MakeCameraType<NormalsCamera>(readings::NormalImage::kType, {"normals"}, Overlay::kImage,
                                    shared, renderer)};
  for (sensing::SensorType& type : types) {
    if (auto ok = registry.Add(std::move(type)); !ok) return ok;
  }
  return {};
}

}  // namespace gsv::rendering
