// The optics of all cameras: image size, lens, and rendering through the lens.
//
// Parameters (of SDFormat's <camera>) and their default values. Lengths are in m, angles in rad,
// sizes in pixels. "Pinhole": only for the lens gnomonical. "Wide": only for the other lenses.
//   image.width, image.height   320 by 240, at most 4096; through a lens at most 4,194,304 pixels
//   horizontal_fov              1.047; at most 3.0 (pinhole) or 2 pi (wide)
//   clip.near, clip.far         0.1 and 100
//   lens.type                   gnomonical, stereographic, equidistant, equisolid_angle, orthographic
//                               or custom (default: see Optics::Read())
//   lens.scale_to_hfov          wide: true
//   lens.cutoff_angle           wide: pi / 2
//   lens.custom_function.{c1,c2,c3,f,fun}   lens custom: 1, 1, 0, 1, tan; fun is sin, tan or id
//   lens.intrinsics.{fx,fy,cx,cy,s}         pinhole: replace horizontal_fov
//   distortion.{k1,k2,k3,p1,p2}             pinhole: 0
//   distortion.center                       pinhole: "0.5 0.5", the middle of the image
// The equations are in lens.h.
#pragma once

#include <memory>
#include <mutex>
#include <optional>

#include "gsv/base/error.h"
#include "gsv/rendering/lenses/lens.h"
#include "gsv/rendering/lenses/lens_map.h"
#include "gsv/rendering/renderer.h"
#include "gsv/sensing/parameters.h"
#include "gsv/sensing/sensor.h"

namespace gsv::rendering {

// Threads  any.
class Optics {
 public:
  // Reads the parameters, and reports invalid ones to the reader. `lens_type` is the default lens.
  static Optics Read(sensing::ParameterReader& reader, const std::string& lens_type = "gnomonical");

  const CameraParameters& camera() const { return camera_; }
  const Lens& lens() const { return lens_; }
  // The field of view according to the parameters. For a wide lens, it is the angle to which the
  // image is scaled.
  const sensing::Frustum& frustum() const { return frustum_; }
  // Returns the direction of a pixel's centre as a unit vector; nullopt if the lens shows nothing
  // there. Pixels are numbered in rows from the top.
  std::optional<geometry::Vector3> RayOfPixel(std::size_t pixel) const;

  // Renders the image of a camera at this pose, through its lens.
  base::Result<std::shared_ptr<const model::Image>> Draw(
      Renderer& renderer, const std::shared_ptr<const world::Snapshot>& snapshot,
      const geometry::Pose& world_from_camera) const;
  // Renders the depth and label image of a camera at this pose, through its lens.
  base::Result<std::shared_ptr<const GroundTruth>> DrawGroundTruth(
      Renderer& renderer, const std::shared_ptr<const world::Snapshot>& snapshot,
      const geometry::Pose& world_from_camera) const;

 private:
  // The lens map of all cameras with equal parameters. The first of them that needs the map makes
  // it.
  struct Joining {
    std::once_flag made;                 // set when `map` is made
    std::unique_ptr<const LensMap> map;  // made for the first image
  };

  Optics(const CameraParameters& camera, Lens lens, double horizontal_fov);
  // Returns the map of a lens; null for a plain lens. Cameras with equal parameters, such as those
  // of all robots of one model, share one map.
  static std::shared_ptr<Joining> JoiningOf(const CameraParameters& camera, const Lens& lens);
  // Returns the lens map, and makes it on first use.
  const LensMap& Map() const;

  CameraParameters camera_;
  Lens lens_;
  sensing::Frustum frustum_;
  // The map from the pixels of the image to the pixels of the rendered pinhole images. Null for a
  // plain lens (Lens::is_plain()), which needs no map: the renderer draws its image directly.
  std::shared_ptr<Joining> joining_;
};

}  // namespace gsv::rendering
