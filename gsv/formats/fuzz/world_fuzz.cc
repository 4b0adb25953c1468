// Fuzz test: reads the input as a world, a model or a URDF. The reader must refuse it, or return a
// result that can be simulated.
#include <cmath>
#include <set>

#include "gsv/base/check.h"
#include "gsv/formats/fuzz/scratch_file.h"
#include "gsv/formats/sdf_reader.h"

using namespace gsv;

namespace {

void CheckLink(const model::Link& link) {
  const model::Inertial& i = link.inertial;
  GSV_CHECK(i.mass >= 0 && std::isfinite(i.mass));
  GSV_CHECK(geometry::IsFinite(link.model_from_link));
  GSV_CHECK(geometry::IsFinite(i.link_from_com));
  for (const double moment : {i.ixx, i.iyy, i.izz, i.ixy, i.ixz, i.iyz}) {
    GSV_CHECK(std::isfinite(moment));
  }
  for (const model::Collision& collision : link.collisions) {
    GSV_CHECK(geometry::IsFinite(collision.link_from_collision));
    GSV_CHECK(collision.surface.friction >= 0 && collision.surface.friction2 >= 0);
    GSV_CHECK(collision.surface.restitution >= 0 && collision.surface.restitution <= 1);
    const geometry::Bounds bounds = geometry::BoundsOf(collision.shape);
    GSV_CHECK(geometry::IsFinite(bounds.min) && geometry::IsFinite(bounds.max));
  }
  for (const model::Visual& visual : link.visuals) {
    GSV_CHECK(geometry::IsFinite(visual.link_from_visual));
    GSV_CHECK(!visual.materials.empty());
  }
}

void CheckModel(const model::Model& model) {
  const int links = static_cast<int>(model.links.size()),
            joints = static_cast<int>(model.joints.size());
  GSV_CHECK(links > 0);
  GSV_CHECK(geometry::IsFinite(model.default_pose));
  for (const model::Link& link : model.links) CheckLink(link);
  std::set<int> children;
  for (const model::Joint& joint : model.joints) {
    GSV_CHECK(joint.parent >= -1 && joint.parent < links && joint.child >= 0 &&
              joint.child < links);
    GSV_CHECK(children.insert(joint.child).second);
    GSV_CHECK(std::abs(geometry::Norm(joint.axis) - 1) < 1e-6);
    GSV_CHECK(joint.position_limits.min <= joint.position_limits.max);
    GSV_CHECK(joint.damping >= 0 && joint.friction >= 0 && joint.effort_limit >= 0 &&
              joint.velocity_limit >= 0);
  }
  for (const model::SensorDescription& sensor : model.sensors) {
    GSV_CHECK(sensor.link >= 0 && sensor.link < links && sensor.update_rate >= 0);
  }
  if (!model.drive) return;
  for (const auto* wheels :
       {&model.drive->left_wheels, &model.drive->right_wheels, &model.drive->steered}) {
    for (const int joint : *wheels) GSV_CHECK(joint >= 0 && joint < joints);
  }
  GSV_CHECK(model.drive->wheel_radius > 0 && model.drive->wheel_separation > 0);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  formats::ReadOptions options;
  options.allow_absolute_paths = false;
  options.limits.mesh_triangles = 10'000;
  formats::ModelLibrary library(options);
  base::Problems problems;
  const auto world = library.ReadWorld(formats::ScratchFile("input.sdf", data, size), problems);
  if (!world) {
    GSV_CHECK(!world.error().message.empty());
    return 0;
  }
  GSV_CHECK(geometry::IsFinite(world->gravity) && world->max_step_size.count() > 0);
  std::set<std::string> names;
  for (const model::PlacedModel& placed : world->models) {
    GSV_CHECK(names.insert(placed.name).second && geometry::IsFinite(placed.world_from_model));
    CheckModel(*placed.model);
  }
  return 0;
}
