#include "gsv/formats/sdf/sdf_link.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <sdf/Collision.hh>
#include <sdf/Element.hh>
#include <sdf/SemanticPose.hh>
#include <sdf/Visual.hh>

#include "gsv/formats/sdf/auto_inertia.h"
#include "gsv/formats/sdf/sdf_document.h"
#include "gsv/formats/sdf/sdf_geometry.h"
#include "gsv/formats/sdf/sdf_material.h"
#include "gsv/formats/sdf/sdf_slip.h"

namespace gsv::formats {
namespace {

using base::ErrorCode;
using model::Collision;
using model::Material;
using model::Visual;

constexpr double kMissingMeshGrey = 0.5;
constexpr std::size_t kMaxReasonLength = 200;

// Returns the value of the element at a path below `element`, if all elements of the path exist.
template <typename T>
std::optional<T> ValueAt(sdf::ElementPtr element, std::initializer_list<const char*> path) {
  for (const char* name : path) {
    if (element == nullptr || !element->HasElement(name)) return std::nullopt;
    element = element->GetElement(name);
  }
  return element->Get<T>();
}

// Reads the collision filter. With <collide_without_contact>, a collision collides with nothing,
// unless it has a <collide_bitmask>.
model::CollisionFilter ReadFilter(const sdf::ElementPtr& collision) {
  const auto bits = [&](const char* name) -> std::optional<std::uint16_t> {
    const auto value = ValueAt<unsigned int>(collision, {"surface", "contact", name});
    return value ? std::optional(static_cast<std::uint16_t>(*value & 0xFFFF)) : std::nullopt;
  };
  const auto collides = bits("collide_bitmask");
  if (!collides &&
      ValueAt<bool>(collision, {"surface", "contact", "collide_without_contact"}).value_or(false)) {
    return model::kMeetsNothing;
  }
  model::CollisionFilter filter;
  filter.collides = collides.value_or(0xFFFF);
  filter.category = bits("category_bitmask").value_or(filter.collides);
  return filter;
}

model::Surface ReadSurface(const sdf::ElementPtr& collision, const ReadingContext& context) {
  model::Surface surface;
  const auto take = [&](double& target, std::initializer_list<const char*> path) {
    const auto value = ValueAt<double>(collision, path);
    if (!value) return;
    if (*value >= 0) {
      target = *value;
    } else {
      context.Warn("friction, slip and bounce must not be negative; the default is used",
                   PlaceOf(*collision, context.source));
    }
  };
  // If the file has only one friction coefficient, it applies in all directions, as in gz-sim.
  // gz-sim's own test of boxes on a slope sets only <mu>.
  const auto take_both = [&](const char* engine, const char* first, const char* second) {
    take(surface.friction, {"surface", "friction", engine, first});
    if (ValueAt<double>(collision, {"surface", "friction", engine, first})) {
      surface.friction2 = surface.friction;
    }
    take(surface.friction2, {"surface", "friction", engine, second});
  };
  take_both("bullet", "friction", "friction2");
  take_both("ode", "mu", "mu2");
  auto direction =
      ValueAt<ignition::math::Vector3d>(collision, {"surface", "friction", "ode", "fdir1"});
  if (!direction) {
    direction =
        ValueAt<ignition::math::Vector3d>(collision, {"surface", "friction", "bullet", "fdir1"});
  }
  if (direction && geometry::IsFinite(FromIgnition(*direction)) && direction->Length() > 0) {
    surface.friction_direction = geometry::Normalized(FromIgnition(*direction));
  }
  if (collision->HasElement("surface")) {
    surface.wheel_slip = ReadSlip(collision->GetElement("surface"), context);
  }
  take(surface.restitution, {"surface", "bounce", "restitution_coefficient"});
  surface.restitution = std::min(surface.restitution, 1.0);
  surface.filter = ReadFilter(collision);
  return surface;
}

// Whether the matrix of inertia is positive definite, by Sylvester's criterion.
bool IsPositiveDefinite(const model::Inertial& i) {
  const double second = i.ixx * i.iyy - i.ixy * i.ixy;
  const double determinant = i.ixx * (i.iyy * i.izz - i.iyz * i.iyz) -
                             i.ixy * (i.ixy * i.izz - i.iyz * i.ixz) +
                             i.ixz * (i.ixy * i.iyz - i.iyy * i.ixz);
  return i.ixx > 0 && second > 0 && determinant > 0;
}

// No principal moment of a body exceeds the sum of the other two. If a moment exceeds the sum by
// more than rounding in files explains, reduces the moment to the sum and returns false.
bool LimitGreatestMoment(const ignition::math::MassMatrix3d& source, model::Inertial& inertial) {
  constexpr double kRounding = 1.05;
  ignition::math::Vector3d moments = source.PrincipalMoments();  // in ascending order
  if (!(moments.Z() > kRounding * (moments.X() + moments.Y()))) return true;
  moments.Z(moments.X() + moments.Y());
  const ignition::math::Matrix3d axes(source.PrincipalAxesOffset());
  ignition::math::Matrix3d diagonal = ignition::math::Matrix3d::Zero;
  for (std::size_t i = 0; i < 3; ++i) diagonal(i, i) = moments[i];
  const ignition::math::Matrix3d m = axes * diagonal * axes.Transposed();
  inertial.ixx = m(0, 0), inertial.iyy = m(1, 1), inertial.izz = m(2, 2);
  inertial.ixy = m(0, 1), inertial.ixz = m(0, 2), inertial.iyz = m(1, 2);
  return false;
}

// Reads the inertia. The inertia of a link that never moves is not used, so it is not checked.
model::Inertial ReadInertial(const sdf::Link& link, bool is_static, const ReadingContext& context) {
  model::Inertial inertial;
  const sdf::ElementPtr element = link.Element();
  if (element == nullptr || !element->HasElement("inertial")) return inertial;
  const auto& source = link.Inertial();
  const auto moments = source.MassMatrix().DiagonalMoments();
  const auto products = source.MassMatrix().OffDiagonalMoments();
  inertial.mass = source.MassMatrix().Mass();
  inertial.link_from_com = FromIgnition(source.Pose());
  inertial.ixx = moments.X(), inertial.iyy = moments.Y(), inertial.izz = moments.Z();
  inertial.ixy = products.X(), inertial.ixz = products.Y(), inertial.iyz = products.Z();
  const std::string place = PlaceOf(*element->GetElement("inertial"), context.source);
  if (!(inertial.mass > 0) || !std::isfinite(inertial.mass)) {
    if (!is_static) context.Warn("the mass must be above zero; 1 kg is used", place);
    return {};
  }
  if (!geometry::IsFinite(inertial.link_from_com)) inertial.link_from_com = {};
  if (!IsPositiveDefinite(inertial)) {
    if (!is_static) {
      context.Warn("the inertia is not positive definite; the inertia of a ball is used", place);
    }
    const double moment = 0.4 * inertial.mass * 0.1 * 0.1;
    inertial.ixx = inertial.iyy = inertial.izz = moment;
    inertial.ixy = inertial.ixz = inertial.iyz = 0;
  } else if (!is_static && !LimitGreatestMoment(source.MassMatrix(), inertial)) {
    context.Warn(
        "no body has this inertia, as one principal moment exceeds the sum of the others; it is "
        "reduced to the sum",
        place);
  }
  return inertial;
}

sdf::ElementPtr GeometryElement(const sdf::ElementPtr& element) {
  return element != nullptr && element->HasElement("geometry") ? element->GetElement("geometry")
                                                               : nullptr;
}

// Returns an element's <density> in kg/m³, or `otherwise` if the element has no valid <density>.
double DensityOf(const sdf::ElementPtr& element, double otherwise, const ReadingContext& context) {
  if (element == nullptr || !element->HasElement("density")) return otherwise;
  const auto [density, is_number] = element->Get<double>("density", otherwise);
  if (is_number && density > 0 && std::isfinite(density)) return density;
  context.Warn(fmt::format("<density> must be a number above zero; {:g} kg/m³ is used", otherwise),
               PlaceOf(*element, context.source));
  return otherwise;
}

// Reads the link's collisions; returns their densities.
std::vector<double> ReadCollisions(const sdf::Link& source, model::Link& link,
                                   const ReadingContext& context) {
  std::vector<double> densities;
  const double density_of_link =
      DensityOf(source.Element() != nullptr && source.Element()->HasElement("inertial")
                    ? source.Element()->GetElement("inertial")
                    : nullptr,
                kDefaultDensity, context);
  for (std::uint64_t i = 0; i < source.CollisionCount(); ++i) {
    const sdf::Collision& collision = *source.CollisionByIndex(i);
    const sdf::ElementPtr element = collision.Element();
    const sdf::ElementPtr geometry = GeometryElement(element);
    if (geometry == nullptr || geometry->HasElement("empty")) continue;
    const std::string place = PlaceOf(*element, context.source);
    auto shape = ReadGeometry(*collision.Geom(), geometry, context);
    if (!shape) {
      context.Warn("the collision is ignored: " + shape.error().message, place);
      continue;
    }
    link.collisions.push_back(
        {collision.Name(),
         Resolve(collision.SemanticPose(), "", place, context) * shape->visual_from_shape,
         shape->shape, ReadSurface(element, context)});
    densities.push_back(DensityOf(element, density_of_link, context));
  }
  return densities;
}

// Sets the inertia from the collision shapes for <inertial auto="true">. libsdformat 12 drops
// @auto, so value_repair.cc copies it to @gsv:auto before.
void MakeInertialOfShapes(const sdf::Link& source, const std::vector<double>& densities,
                          bool is_static, const ReadingContext& context, model::Link& link) {
  if (source.Element() == nullptr || !source.Element()->HasElement("inertial")) return;
  const sdf::ElementPtr element = source.Element()->GetElement("inertial");
  if (!element->HasAttribute("gsv:auto")) return;
  auto made = InertialOf(link.collisions, densities);
  if (!made || !IsPositiveDefinite(*made)) {
    if (!is_static) {
      context.Warn(
          "<inertial auto> needs collision shapes that have a volume (closed meshes); 1 kg "
          "and 1 kg m² are used",
          PlaceOf(*element, context.source));
    }
    link.inertial = {};
    return;
  }
  // If there is also a <mass>, the inertia is scaled to this mass, as in SDFormat 1.12.
  const double scale =
      element->HasElement("mass") && link.inertial.mass > 0 ? link.inertial.mass / made->mass : 1;
  link.inertial = *made;
  for (const auto member :
       {&model::Inertial::mass, &model::Inertial::ixx, &model::Inertial::iyy, &model::Inertial::izz,
        &model::Inertial::ixy, &model::Inertial::ixz, &model::Inertial::iyz}) {
    link.inertial.*member *= scale;
  }
}

// Reads a <velocity_decay>: a fraction of the velocity, from 0 to 1.
double ReadDecay(const sdf::Link& source, const char* name, const ReadingContext& context) {
  const double decay = ValueAt<double>(source.Element(), {"velocity_decay", name}).value_or(0.0);
  if (decay >= 0 && decay <= 1) return decay;
  context.Warn("<velocity_decay><" + std::string(name) + "> must lie between 0 and 1, not " +
                   fmt::format("{:g}", decay) + "; 0 is used",
               PlaceOf(*source.Element(), context.source));
  return 0;
}

// Returns the link's own <enable_wind>, or the <enable_wind> of the innermost model around it.
bool HasWind(const sdf::Link& source) {
  for (auto element = source.Element(); element != nullptr; element = element->GetParent()) {
    if (element->GetName() != "link" && element->GetName() != "model") break;
    if (element->HasElement("enable_wind")) return element->Get<bool>("enable_wind");
  }
  return false;
}

std::vector<Material> MaterialsOf(const sdf::Visual& source, const SdfShape& shape,
                                  const ReadingContext& context) {
  std::vector<Material> materials = shape.materials;
  if (materials.empty()) materials.emplace_back();
  if (const auto own = ReadVisualMaterial(source, context)) {
    std::fill(materials.begin(), materials.end(), *own);
  }
  const double opacity = 1.0 - std::clamp(static_cast<double>(source.Transparency()), 0.0, 1.0);
  for (Material& material : materials) material.base_colour.a *= opacity;
  return materials;
}

std::vector<Visual> CollisionsAsVisuals(const model::Link& link) {
  std::vector<Visual> visuals;
  Material grey;
  grey.base_colour = {kMissingMeshGrey, kMissingMeshGrey, kMissingMeshGrey, 1};
  for (const Collision& collision : link.collisions) {
    if (std::holds_alternative<geometry::Plane>(collision.shape)) continue;
    Visual visual{collision.name + "_as_visual",
                  collision.link_from_collision,
                  collision.shape,
                  {grey},
                  true};
    if (const auto* mesh = std::get_if<geometry::Mesh>(&visual.shape)) {
      for (const auto& part : mesh->triangles->parts) {
        if (part.material >= visual.materials.size())
          visual.materials.resize(part.material + 1, grey);
      }
    }
    visuals.push_back(std::move(visual));
  }
  return visuals;
}

// Returns the temperature (K) that Gazebo's thermal system gives a visual; nullopt if it has none.
std::optional<double> TemperatureOf(const sdf::ElementPtr& visual, const ReadingContext& context) {
  if (!visual->HasElement("plugin")) return std::nullopt;
  for (auto plugin = visual->GetElement("plugin"); plugin != nullptr;
       plugin = plugin->GetNextElement("plugin")) {
    const auto name = plugin->Get<std::string>("name", "").first;
    if (!name.ends_with("::systems::Thermal") || !plugin->HasElement("temperature")) continue;
    const auto [kelvin, is_number] = plugin->Get<double>("temperature", -1.0);
    if (is_number && kelvin >= 0 && std::isfinite(kelvin)) return kelvin;
    context.Warn("<temperature> must be a number of kelvins, at least 0; it is ignored",
                 PlaceOf(*plugin, context.source));
  }
  return std::nullopt;
}

void ReadVisuals(const sdf::Link& source, model::Link& link, const ReadingContext& context) {
  bool any_missing = false;
  for (std::uint64_t i = 0; i < source.VisualCount(); ++i) {
    const sdf::Visual& visual = *source.VisualByIndex(i);
    const sdf::ElementPtr element = visual.Element();
    const sdf::ElementPtr geometry = GeometryElement(element);
    if (geometry == nullptr || geometry->HasElement("empty")) continue;
    const std::string place = PlaceOf(*element, context.source);
    auto shape = ReadGeometry(*visual.Geom(), geometry, context);
    if (!shape) {
      context.Warn(shape.error().message + "; the link's collision shapes are drawn instead",
                   place);
      any_missing = true;
      continue;
    }
    link.visuals.push_back(
        {visual.Name(),
         Resolve(visual.SemanticPose(), "", place, context) * shape->visual_from_shape,
         shape->shape, MaterialsOf(visual, *shape, context), visual.CastShadows(),
         TemperatureOf(element, context)});
  }
  if (!any_missing) return;
  for (Visual& visual : CollisionsAsVisuals(link)) link.visuals.push_back(std::move(visual));
}

}  // namespace

geometry::Pose Resolve(const sdf::SemanticPose& semantic, const std::string& resolve_to,
                       const std::string& place, const ReadingContext& context) {
  ignition::math::Pose3d resolved;
  const sdf::Errors errors = semantic.Resolve(resolved, resolve_to);
  if (!errors.empty()) {
    context.Warn("the pose cannot be resolved, so it is used as written: " +
                     errors.front().Message().substr(0, kMaxReasonLength),
                 place);
    resolved = semantic.RawPose();
  }
  const geometry::Pose pose = FromIgnition(resolved);
  if (!geometry::IsFinite(pose)) {
    context.Warn("the pose is not finite; the origin is used", place);
    return {};
  }
  return pose;
}

model::Link ReadLink(const sdf::Link& source, bool is_static, const ReadingContext& context) {
  model::Link link;
  link.inertial = ReadInertial(source, is_static, context);
  link.has_gravity = ValueAt<bool>(source.Element(), {"gravity"}).value_or(true);
  link.is_kinematic = ValueAt<bool>(source.Element(), {"kinematic"}).value_or(false);
  link.has_wind = HasWind(source);
  link.linear_decay = ReadDecay(source, "linear", context);
  link.angular_decay = ReadDecay(source, "angular", context);
  const std::vector<double> densities = ReadCollisions(source, link, context);
  MakeInertialOfShapes(source, densities, is_static, context, link);
  ReadVisuals(source, link, context);
  return link;
}

}  // namespace gsv::formats
