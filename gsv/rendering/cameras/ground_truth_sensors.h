// The sensor types that use depth and label images: "depth_camera", "segmentation_camera",
// "boundingbox_camera", "thermal_camera" and "normals_camera".
//
// Frame       sensor frame: x along the view, y left, z up.
// Parameters  the parameters of every camera (see optics.h). A depth camera also has `noise` in m
//             (see sensing/noise.h): white noise, bias and dropout for each pixel.
// Readings    pixels are in rows from the top, as in ground_truth.h. Other names of a type are in
//             brackets.
//   depth_camera        values {width, height, then for each pixel the distance along the view in
//   ("depth", "rgbd",   m, infinite where nothing is}. As a message: sensor_msgs/PointCloud2, one
//   "rgbd_camera")      point per pixel, NaN where nothing is.
//   segmentation_camera values {width, height, then for each pixel the number of the label from 1,
//   ("segmentation")    0 where nothing is}. The labels are the names of all models in the world.
//                       The image shows label n in the colour 0x9E3779 n mod 2^24, which is unique
//                       for each label. As a message: sensor_msgs/CompressedImage, PNG.
//   boundingbox_camera  for each model with a visible pixel, ordered by name: the values {left,
//   ("boundingbox")     top, right, bottom} in pixels, and its name as label. As a message:
//                       vision_msgs/Detection2DArray.
//   thermal_camera      for each pixel the temperature of the visual, or of the air where nothing
//   ("thermal")         is, in whole steps of the parameter `resolution` (0.01 K, so that 16 bits
//                       reach to 655.35 K), with `noise` (K). As a message:
//                       sensor_msgs/CompressedImage, PNG of 16-bit grey that counts the steps.
//   normals_camera      values {width, height, then for each pixel the unit normal x, y, z of the
//   ("normals")         visible surface, towards the camera, in the sensor frame}. The normal is
//                       computed from the depths of adjacent pixels of the same visual. It is exact
//                       on planes, and NaN where nothing is or where a pixel has no such neighbours
//                       in both directions. As a message: sensor_msgs/CompressedImage, PNG: the
//                       colour channel of a component c is 255 (c + 1) / 2, and all are black where
//                       the normal is unknown.
// Errors      Sample(): kUnavailable with the reason if there is no renderer.
#pragma once

#include <memory>

#include "gsv/rendering/renderer.h"
#include "gsv/sensing/registry.h"

namespace gsv::rendering {

// `renderer` is the result of Renderer::Start(), which may be a failure. Fails if the registry has
// one of the types already.
[[nodiscard]] base::Status AddGroundTruthSensors(
    sensing::SensorRegistry& registry, const base::Result<std::shared_ptr<Renderer>>& renderer);

}  // namespace gsv::rendering
