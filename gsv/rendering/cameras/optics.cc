#include "gsv/rendering/cameras/optics.h"

#include <mutex>
#include <numbers>
#include <utility>

#include "gsv/base/mutex.h"

namespace gsv::rendering {
namespace {

constexpr double kMaxParameter = 1e6;  // maximum of parameters that have no maximum of their own

WideView ReadWideView(sensing::ParameterReader& reader, const std::string& type) {
  WideView view;
  if (type == "custom") {
    view.c1 = reader.Number("lens.custom_function.c1", 1, 1e-6, kMaxParameter);
    view.c2 = reader.Number("lens.custom_function.c2", 1, 1e-6, kMaxParameter);
    view.c3 = reader.Number("lens.custom_function.c3", 0, -kMaxParameter, kMaxParameter);
    view.f = reader.Number("lens.custom_function.f", 1, 1e-6, kMaxParameter);
    const std::string name = reader.Text("lens.custom_function.fun", "tan");
    if (name == "sin") {
      view.function = WideView::Function::kSine;
    } else if (name == "id") {
      view.function = WideView::Function::kIdentity;
    } else if (name != "tan") {
      reader.Refuse("lens.custom_function.fun is \"" + name + "\"; it must be sin, tan or id");
    }
  } else if (auto known = WideViewNamed(type)) {
    view = *known;
  } else {
    reader.Refuse(known.error().message);
  }
  view.cutoff_angle = reader.Number("lens.cutoff_angle", view.cutoff_angle, 1e-3, std::numbers::pi);
  return view;
}

Lens ReadPinhole(sensing::ParameterReader& reader, const CameraParameters& camera) {
  const Lens plain(camera);
  Intrinsics in = plain.intrinsics();
  in.fx = reader.Number("lens.intrinsics.fx", in.fx, 1e-3, kMaxParameter);
  in.fy = reader.Number("lens.intrinsics.fy", in.fy, 1e-3, kMaxParameter);
  in.cx = reader.Number("lens.intrinsics.cx", in.cx, -kMaxParameter, kMaxParameter);
  in.cy = reader.Number("lens.intrinsics.cy", in.cy, -kMaxParameter, kMaxParameter);
  in.skew = reader.Number("lens.intrinsics.s", in.skew, -kMaxParameter, kMaxParameter);
  Distortion distortion;
  distortion.k1 = reader.Number("distortion.k1", 0, -100, 100);
  distortion.k2 = reader.Number("distortion.k2", 0, -100, 100);
  distortion.k3 = reader.Number("distortion.k3", 0, -100, 100);
  distortion.p1 = reader.Number("distortion.p1", 0, -100, 100);
  distortion.p2 = reader.Number("distortion.p2", 0, -100, 100);
  distortion.centre = reader.Pair("distortion.center", distortion.centre, -1, 2);
  return Lens(camera, in, distortion);
}

}  // namespace

Optics::Optics(const CameraParameters& camera, Lens lens, double horizontal_fov)
    : camera_(camera),
      lens_(lens),
      frustum_{horizontal_fov, static_cast<double>(camera.width) / camera.height},
      joining_(JoiningOf(camera_, lens_)) {}

std::shared_ptr<Optics::Joining> Optics::JoiningOf(const CameraParameters& camera,
                                                   const Lens& lens) {
  struct Known {
    CameraParameters camera;
    Lens lens;
    std::weak_ptr<Joining> joining;
  };
  static base::Mutex mutex;
  static std::vector<Known> all GSV_GUARDED_BY(mutex);
  if (lens.is_plain()) return nullptr;
  const base::MutexLock lock(mutex);
  std::erase_if(all, [](const Known& known) { return known.joining.expired(); });
  for (const Known& known : all) {
    if (!(known.camera == camera && known.lens == lens)) continue;
    if (auto joining = known.joining.lock()) return joining;
  }
  auto joining = std::make_shared<Joining>();
  all.push_back({camera, lens, joining});
  return joining;
}

Optics Optics::Read(sensing::ParameterReader& reader, const std::string& lens_type) {
  CameraParameters camera;
  camera.width = reader.Count("image.width", camera.width, 1, kMaxImageSide);
  camera.height = reader.Count("image.height", camera.height, 1, kMaxImageSide);
  camera.near = reader.Number("clip.near", camera.near, 1e-4, 1e6);
  camera.far = reader.Number("clip.far", camera.far, 1e-4, 1e6);
  const std::string type = reader.Text("lens.type", lens_type);
  const double widest = type == "gnomonical" ? 3.0 : 2 * std::numbers::pi;
  const double fov = reader.Number("horizontal_fov", camera.horizontal_fov, 0.01, widest);
  if (reader.status()) {
    if (base::Status fits = Check(camera); !fits) reader.Refuse(fits.error().message);
  }
  const auto fitting = [&](Lens lens) -> Optics {
    if (!lens.is_plain() && camera.width > LensMap::kMaxPixels / camera.height) {
      reader.Refuse("an image through a lens has at most 4194304 pixels (2048 by 2048), and " +
                    std::to_string(camera.width) + " by " + std::to_string(camera.height) +
                    " are more");
      lens = Lens(CameraParameters());
    }
    return {camera, lens, fov};
  };
  if (type == "gnomonical") {
    camera.horizontal_fov = fov;
    return fitting(ReadPinhole(reader, camera));
  }
  const WideView view = ReadWideView(reader, type);
  const bool scaled = reader.Flag("lens.scale_to_hfov", true);
  auto lens = Lens::Wide(camera, view, scaled ? fov : 0);
  if (!lens) reader.Refuse(lens.error().message);
  return fitting(lens ? *std::move(lens) : Lens(camera));
}

const LensMap& Optics::Map() const {
  std::call_once(joining_->made,
                 [this] { joining_->map = std::make_unique<const LensMap>(lens_, camera_); });
  return *joining_->map;
}

std::optional<geometry::Vector3> Optics::RayOfPixel(std::size_t pixel) const {
  if (!lens_.has_quick_rays()) return Map().RayOfPixel(pixel);
  const auto width = static_cast<std::size_t>(camera_.width);
  const std::size_t column = pixel % width, row = pixel / width;
  return lens_.RayAt(static_cast<double>(column) + 0.5, static_cast<double>(row) + 0.5);
}

base::Result<std::shared_ptr<const model::Image>> Optics::Draw(
    Renderer& renderer, const std::shared_ptr<const world::Snapshot>& snapshot,
    const geometry::Pose& world_from_camera) const {
  if (lens_.is_plain()) return renderer.Draw(snapshot, {world_from_camera, camera_});
  const auto images = renderer.Draw(snapshot, Map().Views(world_from_camera));
  if (!images) return base::Fail(images.error());
  return std::make_shared<const model::Image>(Map().Join(*images));
}

base::Result<std::shared_ptr<const GroundTruth>> Optics::DrawGroundTruth(
    Renderer& renderer, const std::shared_ptr<const world::Snapshot>& snapshot,
    const geometry::Pose& world_from_camera) const {
  const auto views = lens_.is_plain() ? std::vector<CameraView>{{world_from_camera, camera_}}
                                      : Map().Views(world_from_camera);
  const auto truths = renderer.DrawGroundTruth(snapshot, views);
  if (!truths) return base::Fail(truths.error());
  if (lens_.is_plain()) return truths->front();
  return std::make_shared<const GroundTruth>(Map().Join(*truths));
}

}  // namespace gsv::rendering
