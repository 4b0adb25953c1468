// The solids of all bodies of a layout, ready to be placed.
//
// Threads  const members may run concurrently.
#pragma once

#include <memory>
#include <vector>

#include "gsv/sensing/rays/solid_set.h"
#include "gsv/world/snapshot.h"

namespace gsv::sensing {

// The solids of one link, or of all links of a model that do not move against each other. Shared by
// all bodies that have the model.
struct Part {
  int link = -1;   // whose frame it is in; -1: the model's
  int number = 0;  // within its model
  SolidSet solids;
  BoundingSphere ball;  // around them, unless they are endless
};

// A part of one body.
struct BodyPart {
  const Part* part;
  int body;
};

struct LayoutSolids {
  explicit LayoutSolids(std::shared_ptr<const world::Layout> of);
  LayoutSolids(const LayoutSolids&) = delete;
  LayoutSolids& operator=(const LayoutSolids&) = delete;

  std::shared_ptr<const world::Layout> layout;
  SolidSet standing;  // of all static bodies
  std::vector<std::vector<Part>> models;
  std::vector<BodyPart> moving;  // by body, but those that are endless last
  std::size_t bounded = 0;       // how many of `moving` are not endless
};

}  // namespace gsv::sensing
