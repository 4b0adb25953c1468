// Small worlds for tests of renderers.
#pragma once

#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gsv/rendering/renderer.h"

namespace gsv::rendering {

// A world that a test builds from shapes, with its snapshots.
class TestScene {
 public:
  TestScene() { description_.scene.background = {0.5, 0.5, 0.5, 1}; }

  model::WorldDescription& description() { return description_; }

  void Add(const std::string& name, geometry::Shape shape, const geometry::Pose& pose,
           model::Material material, bool is_static = false) {
    auto model = std::make_shared<model::Model>();
    model->links.resize(1);
    model->links[0].visuals.resize(1);
    model->links[0].visuals[0].shape = std::move(shape);
    model->links[0].visuals[0].materials = {std::move(material)};
    models_.emplace_back(name, model);
    world::Body body;
    body.name = name;
    body.model = std::move(model);
    body.initial_pose = pose;
    body.kind = is_static ? world::BodyKind::kStatic : world::BodyKind::kUnmoved;
    bodies_.push_back(std::move(body));
  }

  // The only link of a body. Tests add further visuals to it.
  model::Link& LinkOf(const std::string& name) {
    for (auto& [body, model] : models_) {
      if (body == name) return model->links[0];
    }
    std::abort();
  }

  void Remove(const std::string& name) {
    std::erase_if(bodies_, [&](const world::Body& body) { return body.name == name; });
    std::erase_if(models_, [&](const auto& model) { return model.first == name; });
  }

  std::shared_ptr<const world::Snapshot> Snapshot() {
    auto snapshot = std::make_shared<world::Snapshot>();
    snapshot->layout = world::MakeLayout(
        ++version_, bodies_, std::make_shared<const model::WorldDescription>(description_));
    snapshot->state = world::InitialState(*snapshot->layout);
    return snapshot;
  }

 private:
  model::WorldDescription description_;
  std::vector<world::Body> bodies_;
  std::vector<std::pair<std::string, std::shared_ptr<model::Model>>> models_;
  std::uint32_t version_ = 0;
};

// An emissive material.
inline model::Material Glowing(double r, double g, double b) {
  model::Material material;
  material.base_colour = {0, 0, 0, 1};
  material.emissive = {r, g, b, 1};
  return material;
}

inline model::Material Matt(double r, double g, double b, double a = 1) {
  model::Material material;
  material.base_colour = {r, g, b, a};
  material.roughness = 1;
  return material;
}

// The centre and the number of pixels of one colour.
struct Blob {
  double u = 0, v = 0;
  int pixels = 0;
};

// Finds the pixels whose `channel` (0, 1 or 2) exceeds both other channels by more than `margin`.
// Each pixel is weighted by the difference, so that antialiased edges count less.
inline Blob FindBlob(const model::Image& image, int channel, int margin = 40) {
  Blob blob;
  double weight = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const std::uint8_t* p = &image.pixels[(static_cast<std::size_t>(y) * image.width + x) * 3];
      const int above = p[channel] - std::max(p[(channel + 1) % 3], p[(channel + 2) % 3]);
      if (above <= margin) continue;
      ++blob.pixels;
      weight += above;
      blob.u += above * (x + 0.5);
      blob.v += above * (y + 0.5);
    }
  }
  if (weight > 0) blob.u /= weight, blob.v /= weight;
  return blob;
}

inline int Brightness(const model::Image& image, int x, int y) {
  const std::uint8_t* p = &image.pixels[(static_cast<std::size_t>(y) * image.width + x) * 3];
  return (p[0] + p[1] + p[2]) / 3;
}

}  // namespace gsv::rendering
