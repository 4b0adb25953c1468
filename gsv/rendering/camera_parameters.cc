#include "gsv/rendering/camera_parameters.h"

namespace gsv::rendering {

CameraParameters ReadCameraParameters(sensing::ParameterReader& reader) {
  CameraParameters camera;
  camera.width = reader.Count("image.width", camera.width, 1, kMaxPictureSide);
  camera.height = reader.Count("image.height", camera.height, 1, kMaxPictureSide);
  camera.horizontal_fov = reader.Number("horizontal_fov", camera.horizontal_fov, 0.01, 3.0);
  camera.near = reader.Number("clip.near", camera.near, 1e-4, 1e6);
  camera.far = reader.Number("clip.far", camera.far, 1e-4, 1e6);
  if (reader.status()) {
    if (base::Status fits = Check(camera); !fits) reader.Refuse(fits.error().message);
  }
  return camera;
}

}  // namespace gsv::rendering
