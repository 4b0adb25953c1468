#include "gsv/sensing/rays/bounding_volume_tree.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <embree3/rtcore.h>

#include "gsv/base/check.h"

namespace gsv::sensing {
namespace {

using geometry::Bounds;
using geometry::Vector3;

// One device per process, which has only settings and no scenes. It is never destroyed, because
// trees may be destroyed after main().
RTCDevice EmbreeDevice() {
  static const RTCDevice device = [] {
    RTCDevice made = rtcNewDevice("threads=1,set_affinity=0,isa=avx2");
    if (made == nullptr) made = rtcNewDevice("threads=1,set_affinity=0");
    GSV_CHECK(made != nullptr);
    return made;
  }();
  return device;
}

// Returns the padding of all boxes, in metres. Single precision has a relative error of 6e-8. The
// error affects the corners of boxes, the origin of a ray, and the ray's direction over the extent
// of the scene.
double PaddingFor(const std::vector<Bounds>& boxes) {
  double furthest = 0;
  for (const Bounds& b : boxes) {
    for (const Vector3& corner : {b.min, b.max}) {
      furthest = std::max({furthest, std::abs(corner.x), std::abs(corner.y), std::abs(corner.z)});
    }
  }
  return 1e-6 + 2e-6 * furthest;
}

// Returns the length of a ray in single precision, slightly enlarged. The ray may then find a box
// beyond its true length, which does no harm.
float LengthFor(double length, double padding) {
  return static_cast<float>(length + padding + 1e-6 * std::abs(length));
}

struct Search {
  RTCIntersectContext context;  // the first member, because Embree returns its address
  BoundingVolumeTree::Visitor* visitor;
  double padding;
};

}  // namespace

struct BoundingVolumeTree::Impl {
  std::vector<Bounds> boxes;
  double padding = 0;
  RTCScene scene = nullptr;
  RTCGeometry geometry = nullptr;

  static void BoundsFunction(const RTCBoundsFunctionArguments* args) {
    const auto* self = static_cast<const Impl*>(args->geometryUserPtr);
    const Bounds& b = self->boxes[args->primID];
    RTCBounds& out = *args->bounds_o;
    out.lower_x = static_cast<float>(b.min.x - self->padding);
    out.lower_y = static_cast<float>(b.min.y - self->padding);
    out.lower_z = static_cast<float>(b.min.z - self->padding);
    out.upper_x = static_cast<float>(b.max.x + self->padding);
    out.upper_y = static_cast<float>(b.max.y + self->padding);
    out.upper_z = static_cast<float>(b.max.z + self->padding);
  }

  static void IntersectFunction(const RTCIntersectFunctionNArguments* args) {
    GSV_CHECK(args->N == 1);
    if (args->valid[0] == 0) return;
    auto* search = reinterpret_cast<Search*>(args->context);
    auto* rayhit = reinterpret_cast<RTCRayHit*>(args->rayhit);
    const float length = LengthFor(search->visitor->Visit(args->primID), search->padding);
    if (length < rayhit->ray.tfar) {
      rayhit->ray.tfar = length;
      rayhit->hit.geomID = args->geomID;
      rayhit->hit.primID = args->primID;
    }
  }
};

BoundingVolumeTree::BoundingVolumeTree() : impl_(std::make_unique<Impl>()) {}

BoundingVolumeTree::~BoundingVolumeTree() {
  if (impl_->geometry != nullptr) rtcReleaseGeometry(impl_->geometry);
  if (impl_->scene != nullptr) rtcReleaseScene(impl_->scene);
}

void BoundingVolumeTree::Build(std::span<const Bounds> boxes, bool often) {
  Impl& self = *impl_;
  const bool same_count = self.scene != nullptr && self.boxes.size() == boxes.size();
  self.boxes.assign(boxes.begin(), boxes.end());
  self.padding = PaddingFor(self.boxes);
  if (self.scene == nullptr) {
    self.scene = rtcNewScene(EmbreeDevice());
    rtcSetSceneFlags(self.scene, often
                                     ? RTCSceneFlags(RTC_SCENE_FLAG_ROBUST | RTC_SCENE_FLAG_DYNAMIC)
                                     : RTC_SCENE_FLAG_ROBUST);
    rtcSetSceneBuildQuality(self.scene, often ? RTC_BUILD_QUALITY_MEDIUM : RTC_BUILD_QUALITY_HIGH);
    self.geometry = rtcNewGeometry(EmbreeDevice(), RTC_GEOMETRY_TYPE_USER);
    rtcSetGeometryUserData(self.geometry, &self);
    rtcSetGeometryBoundsFunction(self.geometry, Impl::BoundsFunction, nullptr);
    rtcSetGeometryIntersectFunction(self.geometry, Impl::IntersectFunction);
    rtcAttachGeometry(self.scene, self.geometry);
  }
  if (!same_count) {
    rtcSetGeometryUserPrimitiveCount(self.geometry, static_cast<unsigned>(self.boxes.size()));
  }
  rtcCommitGeometry(self.geometry);
  rtcCommitScene(self.scene);
  GSV_CHECK(rtcGetDeviceError(EmbreeDevice()) == RTC_ERROR_NONE);
}

void BoundingVolumeTree::Cast(const Ray& ray, Visitor& visitor) const {
  if (impl_->boxes.empty()) return;
  Search search;
  rtcInitIntersectContext(&search.context);
  search.visitor = &visitor;
  search.padding = impl_->padding;
  RTCRayHit rayhit{};
  rayhit.ray.org_x = static_cast<float>(ray.origin.x);
  rayhit.ray.org_y = static_cast<float>(ray.origin.y);
  rayhit.ray.org_z = static_cast<float>(ray.origin.z);
  rayhit.ray.dir_x = static_cast<float>(ray.direction.x);
  rayhit.ray.dir_y = static_cast<float>(ray.direction.y);
  rayhit.ray.dir_z = static_cast<float>(ray.direction.z);
  rayhit.ray.tnear = 0;
  rayhit.ray.tfar = LengthFor(ray.max_distance, search.padding);
  rayhit.ray.mask = ~0u;
  rayhit.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  rayhit.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene, &search.context, &rayhit);
}

}  // namespace gsv::sensing
