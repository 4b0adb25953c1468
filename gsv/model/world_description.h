// The description of a world from its file: models and poses, light, physics.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "gsv/model/medium.h"
#include "gsv/model/model.h"

namespace gsv::model {

// A light of a world.
struct Light {
  enum class Kind { kDirectional, kPoint, kSpot };
  std::string name;
  Kind kind = Kind::kDirectional;
  geometry::Pose world_from_light;
  geometry::Vector3 direction{0, 0, -1};  // in the light's frame, unit length
  Colour diffuse{1, 1, 1, 1};
  double intensity = 1;  // factor that multiplies `diffuse`
  double range = 10;     // range of point and spot lights, m
  // Only for point and spot lights, at the distance d: the light is divided by constant + linear d
  // + quadratic d².
  double constant_attenuation = 1, linear_attenuation = 0, quadratic_attenuation = 0;
  // Only for spots: the full angles of two cones, in rad. Within the inner cone, the light has its
  // full intensity. Outside of the outer cone, there is no light of this spot.
  double inner_angle = 0, outer_angle = 0;
  bool cast_shadows = true;
};

// The ambient light, the background and the sky of a world.
struct SceneLook {
  Colour ambient{0.4, 0.4, 0.4, 1};
  Colour background{0.7, 0.75, 0.8, 1};  // colour of the sky, unless `sky` is true
  bool shadows = true;                   // false: no light of the world casts shadows
  bool sky = false;                      // true: a blue sky is drawn instead of `background`
};

// A model with its name and pose in a world.
struct PlacedModel {
  std::string name;  // unique in its world
  std::shared_ptr<const Model> model;
  geometry::Pose world_from_model;
  bool is_static = false;  // whether the file fixes this model to the world
};

// The position of the world's origin on the earth (WGS84).
struct GeodeticOrigin {
  double latitude = 0, longitude = 0;  // rad
  double elevation = 0;                // m above the ellipsoid
  double heading = 0;                  // rad from east to the world's x axis, counter-clockwise
};

struct PedestrianGroup;  // gsv/model/pedestrian_group.h

// The data of one world. A simulation starts from it and does not change it.
struct WorldDescription {
  std::string name;
  std::string source;                                         // the file of the world, for messages
  base::SimTime max_step_size{std::chrono::milliseconds(1)};  // default length of a step
  double real_time_factor = 1;                                // target real-time factor
  geometry::Vector3 gravity{0, 0, -9.8};
  geometry::Vector3 magnetic_field{5.5645e-6, 22.8758e-6, -42.3884e-6};  // T
  // Temperature of the air at height 0, in K.
  double temperature = 288.15;
  std::optional<GeodeticOrigin> origin;  // if absent, the world has no satellite navigation
  std::optional<Wind> wind;
  std::optional<Fluid> fluid;
  SceneLook scene;
  std::vector<Light> lights;
  std::vector<PlacedModel> models;
  std::vector<std::shared_ptr<const PedestrianGroup>> pedestrians;  // never null
};

}  // namespace gsv::model
