#include "gsv/formats/sdf/sdf_world.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <sdf/Atmosphere.hh>
#include <sdf/Element.hh>
#include <sdf/Physics.hh>
#include <sdf/Scene.hh>

#include "gsv/formats/sdf/sdf_document.h"
#include "gsv/model/real_time_factor.h"

namespace gsv::formats {
namespace {

using geometry::Vector3;
using model::Light;

Light::Kind KindOf(sdf::LightType type) {
  switch (type) {
    case sdf::LightType::POINT:
      return Light::Kind::kPoint;
    case sdf::LightType::SPOT:
      return Light::Kind::kSpot;
    default:
      return Light::Kind::kDirectional;
  }
}

void ReadPhysics(const sdf::Physics& physics, const ReadingContext& context,
                 model::WorldDescription& world) {
  const std::string place = physics.Element() == nullptr
                                ? context.source.string()
                                : PlaceOf(*physics.Element(), context.source);
  const double step = physics.MaxStepSize();
  if (step >= 1e-6 && step <= 1) {
    world.max_step_size = base::SimTime(std::llround(step * 1e9));
  } else {
    context.Warn("<max_step_size> must lie between 1e-6 s and 1 s; 0.001 s is used", place);
  }
  const double factor = physics.RealTimeFactor();
  if (factor > 0 && factor <= model::kMaxRealTimeFactor) {
    world.real_time_factor = factor;
  } else {
    // In Gazebo, a factor that is not positive means "as fast as possible".
    context.Warn(
        "<real_time_factor> must lie above 0 and not above 1e6; 1 is used. To run as fast as "
        "possible, use lockstep (gsv run --lockstep)",
        place);
  }
}

void ReadOrigin(const ignition::math::SphericalCoordinates& coordinates,
                const ReadingContext& context, model::WorldDescription& world) {
  const model::GeodeticOrigin origin{
      coordinates.LatitudeReference().Radian(), coordinates.LongitudeReference().Radian(),
      coordinates.ElevationReference(), coordinates.HeadingOffset().Radian()};
  const Vector3 place{origin.latitude, origin.longitude, origin.elevation};
  if (geometry::IsFinite(place) && std::isfinite(origin.heading) &&
      std::abs(origin.latitude) <= std::numbers::pi / 2) {
    world.origin = origin;
  } else {
    context.Warn(
        "<spherical_coordinates> must be finite, with a latitude of at most 90 degrees; the world "
        "has no geographic origin",
        context.source.string());
  }
}

void CheckCone(const ReadingContext& context, const std::string& place, Light& light) {
  constexpr double kMaxConeAngle = 2 * std::numbers::pi;
  double& inner = light.inner_angle;
  double& outer = light.outer_angle;
  if (0 <= inner && inner <= outer && outer <= kMaxConeAngle) return;
  if (!(0 < outer && outer <= kMaxConeAngle)) outer = 1;
  inner = 0 <= inner ? std::min(inner, outer) : outer / 2;
  context.Warn(fmt::format("a spot light needs 0 <= <inner_angle> <= <outer_angle> <= 2 pi; {:g} "
                           "and {:g} rad are used",
                           inner, outer),
               place);
}

}  // namespace

model::Light ReadLight(const sdf::Light& source, const ReadingContext& context) {
  Light light;
  light.name = source.Name();
  light.kind = KindOf(source.Type());
  const std::string place = source.Element() == nullptr
                                ? context.source.string()
                                : PlaceOf(*source.Element(), context.source);
  const Vector3 direction = FromIgnition(source.Direction());
  if (geometry::IsFinite(direction) && geometry::Norm(direction) > 0) {
    light.direction = geometry::Normalized(direction);
  } else if (light.kind != Light::Kind::kPoint) {
    context.Warn("the light's <direction> has no length; straight down is used", place);
  }
  light.diffuse = FromIgnition(source.Diffuse());
  light.intensity = std::max(source.Intensity(), 0.0);
  // Reads <light_on>, which SDFormat has since 1.9. libsdformat 12 does not know this element, but
  // keeps it as it is in source.Element().
  if (source.Element() != nullptr && source.Element()->HasElement("light_on") &&
      !source.Element()->Get<bool>("light_on", true).first) {
    light.intensity = 0;
  }
  light.range = source.AttenuationRange();
  if (!(light.range > 0)) {
    context.Warn("the light's <range> must be above 0; 10 m is used", place);
    light.range = 10;
  }
  light.constant_attenuation = source.ConstantAttenuationFactor();
  light.linear_attenuation = source.LinearAttenuationFactor();
  light.quadratic_attenuation = source.QuadraticAttenuationFactor();
  light.inner_angle = source.SpotInnerAngle().Radian();
  light.outer_angle = source.SpotOuterAngle().Radian();
  if (light.kind == Light::Kind::kSpot) CheckCone(context, place, light);
  light.cast_shadows = source.CastShadows();
  return light;
}

void ReadPhysicsAndScene(const sdf::World& source, const ReadingContext& context,
                         model::WorldDescription& world) {
  const Vector3 gravity = FromIgnition(source.Gravity());
  if (geometry::IsFinite(gravity)) {
    world.gravity = gravity;
  } else {
    context.Warn("<gravity> must be finite; Earth's is used", context.source.string());
  }
  const Vector3 magnetic_field = FromIgnition(source.MagneticField());
  if (geometry::IsFinite(magnetic_field)) {
    world.magnetic_field = magnetic_field;
  } else {
    context.Warn("<magnetic_field> must be finite; the default is used", context.source.string());
  }
  if (const auto* coordinates = source.SphericalCoordinates()) {
    ReadOrigin(*coordinates, context, world);
  }
  if (source.Atmosphere() != nullptr) {
    const double kelvin = source.Atmosphere()->Temperature().Kelvin();
    if (std::isfinite(kelvin) && kelvin >= 0) {
      world.temperature = kelvin;
    } else {
      context.Warn("<atmosphere><temperature> must be at least 0 K; the default is used",
                   context.source.string());
    }
  }
  if (const sdf::Physics* physics = source.PhysicsDefault()) ReadPhysics(*physics, context, world);
  const sdf::Scene* scene = source.Scene();
  if (scene == nullptr) return;
  world.scene.ambient = FromIgnition(scene->Ambient());
  world.scene.shadows = scene->Shadows();
  world.scene.sky = scene->Sky() != nullptr;
  // A scene without a background keeps GSV's default.
  if (scene->Element() != nullptr && scene->Element()->HasElement("background")) {
    world.scene.background = FromIgnition(scene->Background());
  }
}

}  // namespace gsv::formats
