#include "gsv/formats/sdf/gazebo_materials.h"

#include <string>

namespace gsv::formats {
namespace {

using model::Colour;
using model::Material;

struct NamedMaterial {
  std::string_view name;
  Colour colour;
  double roughness;
};

constexpr NamedMaterial kPlain[] = {
    {"Grey", {0.7, 0.7, 0.7, 1}, 0.9},
    {"Gray", {0.7, 0.7, 0.7, 1}, 0.9},
    {"DarkGrey", {0.175, 0.175, 0.175, 1}, 0.9},
    {"DarkGray", {0.175, 0.175, 0.175, 1}, 0.9},
    {"White", {1, 1, 1, 1}, 0.85},
    {"FlatBlack", {0.1, 0.1, 0.1, 1}, 0.9},
    {"Black", {0.02, 0.02, 0.02, 1}, 0.7},
    {"Red", {1, 0, 0, 1}, 0.8},
    {"RedBright", {0.87, 0.26, 0.07, 1}, 0.8},
    {"Green", {0, 1, 0, 1}, 0.8},
    {"Blue", {0, 0, 1, 1}, 0.8},
    {"SkyBlue", {0.13, 0.44, 0.70, 1}, 0.8},
    {"Yellow", {1, 1, 0, 1}, 0.9},
    {"ZincYellow", {0.9725, 0.9529, 0.2078, 1}, 0.9},
    {"DarkYellow", {0.7, 0.7, 0, 1}, 0.9},
    {"Purple", {1, 0, 1, 1}, 0.8},
    {"DarkMagenta", {0.5, 0, 0.5, 1}, 0.8},
    {"Turquoise", {0, 1, 1, 1}, 0.8},
    {"Orange", {1, 0.5088, 0.0468, 1}, 0.6},
    {"DarkOrange", {0.7, 0.35, 0.02, 1}, 0.6},
    {"Indigo", {0.33, 0, 0.5, 1}, 0.8},
    {"Gold", {0.8, 0.6487, 0.12, 1}, 0.5},
    {"Silver", {0.75, 0.75, 0.75, 1}, 0.45},
    {"Chrome", {0.8, 0.8, 0.8, 1}, 0.3},
    {"BumpyMetal", {0.6, 0.6, 0.6, 1}, 0.5},
    {"Gray-Material", {0.7, 0.7, 0.7, 1}, 0.9},
    {"Wood", {0.62, 0.44, 0.27, 1}, 0.75},
    {"WoodFloor", {0.58, 0.42, 0.27, 1}, 0.6},
    {"WoodPallet", {0.72, 0.58, 0.40, 1}, 0.85},
    {"WoodTile", {0.55, 0.38, 0.23, 1}, 0.7},
    {"Bricks", {0.55, 0.30, 0.22, 1}, 0.9},
    {"Grass", {0.25, 0.40, 0.16, 1}, 0.95},
    {"Road", {0.27, 0.27, 0.28, 1}, 0.95},
    {"Residential", {0.45, 0.44, 0.42, 1}, 0.95},
    {"Tarmac", {0.33, 0.33, 0.34, 1}, 0.95},
    {"Pavement", {0.52, 0.51, 0.49, 1}, 0.95},
    {"Runway", {0.35, 0.35, 0.36, 1}, 0.95},
    {"Stone", {0.50, 0.48, 0.45, 1}, 0.9},
    {"PaintedWall", {0.80, 0.78, 0.72, 1}, 0.9},
    {"CeilingTiled", {0.85, 0.85, 0.83, 1}, 0.95},
    {"Carpet", {0.45, 0.42, 0.40, 1}, 1.0},
    {"Fish", {0.80, 0.55, 0.30, 1}, 0.7},
    {"LightWood", {0.75, 0.60, 0.42, 1}, 0.7},
    {"Light_Wood", {0.75, 0.60, 0.42, 1}, 0.7},
    {"EpuckCircle", {0.2, 0.5, 0.2, 1}, 0.8},
    {"PioneerBody", {0.62, 0.05, 0.05, 1}, 0.5},
    {"Pioneer2Body", {0.62, 0.05, 0.05, 1}, 0.5},
    {"Rockwall", {0.45, 0.42, 0.38, 1}, 0.95},
    {"CloudySky", {0.55, 0.65, 0.80, 1}, 1.0},
};

std::optional<Material> Plain(std::string_view name) {
  for (const NamedMaterial& named : kPlain) {
    if (named.name != name) continue;
    Material material;
    material.base_colour = named.colour;
    material.roughness = named.roughness;
    return material;
  }
  return std::nullopt;
}

bool DropSuffix(std::string_view& name, std::string_view suffix) {
  if (name.size() <= suffix.size() || name.substr(name.size() - suffix.size()) != suffix) {
    return false;
  }
  name.remove_suffix(suffix.size());
  return true;
}

}  // namespace

std::optional<Material> GazeboMaterial(std::string_view name) {
  constexpr std::string_view kPrefix = "Gazebo/";
  if (name.substr(0, kPrefix.size()) != kPrefix) return std::nullopt;
  name.remove_prefix(kPrefix.size());
  if (auto plain = Plain(name)) return plain;
  // "RedGlow" is emissive, "RedTransparent" is half transparent.
  const bool glows = DropSuffix(name, "Glow");
  const bool transparent =
      !glows && (DropSuffix(name, "TransparentOverlay") || DropSuffix(name, "Transparent"));
  auto material = glows || transparent ? Plain(name) : std::nullopt;
  if (!material) return std::nullopt;
  if (glows) material->emissive = material->base_colour;
  if (transparent) material->base_colour.a = 0.5;
  return material;
}

}  // namespace gsv::formats
