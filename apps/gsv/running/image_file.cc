#include "apps/gsv/running/image_file.h"

#include <cerrno>
#include <cstring>
#include <fstream>

#include "gsv/rendering/images/jpeg.h"
#include "gsv/rendering/images/png.h"
#include "gsv/rendering/renderer.h"

namespace gsv::app {
namespace {

bool EndsAsPng(const std::string& path) { return path.ends_with(".png"); }

}  // namespace

std::string CheckImageName(const std::string& path) {
  if (EndsAsPng(path) || path.ends_with(".jpg") || path.ends_with(".jpeg")) return {};
  return "the name of an image must end with .jpg, .jpeg or .png, but " + path + " does not";
}

base::Status WriteImage(const model::Image& image, const std::string& path) {
  const auto bytes =
      EndsAsPng(path) ? rendering::EncodePng(image) : rendering::EncodeJpeg(image, 88);
  if (!bytes) return base::Fail(bytes.error());
  return WriteImageFile({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, path);
}

base::Status WriteImageFile(std::string_view bytes, const std::string& path) {
  errno = 0;
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  if (file.flush()) return {};
  return base::Fail(base::ErrorCode::kUnavailable,
                    "cannot be written: " + std::string(std::strerror(errno)), path);
}

base::Status DrawAround(const std::shared_ptr<const world::Snapshot>& snapshot,
                        const std::string& body, const std::string& path) {
  // distance behind the body in m, and pitch of the camera in rad
  constexpr double kBack = 5, kPitch = 0.9;
  const int index = snapshot->layout->Find(body);
  const geometry::Pose pose =
      index < 0 ? geometry::Pose()
                : snapshot->state.bodies[static_cast<std::size_t>(index)].world_from_model;
  const geometry::Quaternion turn =
      geometry::FromRollPitchYaw({0, kPitch, geometry::Yaw(pose.orientation)});
  rendering::CameraParameters camera;
  camera.width = 640;
  camera.height = 480;
  camera.horizontal_fov = 1.2;
  camera.near = 0.05;
  camera.far = 200;
  auto renderer = rendering::Renderer::Start();
  if (!renderer) return base::Fail(renderer.error());
  const auto image = (*renderer)->Draw(
      snapshot, {{pose.position + turn * geometry::Vector3{-kBack, 0, 0}, turn}, camera},
      std::chrono::minutes(1));
  return image ? WriteImage(**image, path) : base::Fail(image.error());
}

}  // namespace gsv::app
