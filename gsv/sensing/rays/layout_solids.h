// The solids of all bodies of a layout. Solids of moving bodies are in the frames of their links.
//
// Threads  const members may run concurrently.
#pragma once

#include <memory>
#include <vector>

#include "gsv/sensing/rays/solid_set.h"
#include "gsv/world/snapshot.h"

namespace gsv::sensing {

// The solids of one link, or of all links of a model that do not move relative to each other. All
// bodies of the model share these solids.
struct Part {
  int link = -1;        // the solids are in the frame of this link; -1: in the frame of the model
  int number = 0;       // index of the part in its model
  SolidSet solids;      // in the part's frame
  BoundingSphere ball;  // bounding sphere of the solids, unless they are unbounded
};

// A part of one body.
struct BodyPart {
  const Part* part;  // the solids; shared by all bodies of the model
  int body;          // index of the body in the layout
};

// The solids of all bodies of a layout.
struct LayoutSolids {
  explicit LayoutSolids(std::shared_ptr<const world::Layout> of);
  LayoutSolids(const LayoutSolids&) = delete;
  LayoutSolids& operator=(const LayoutSolids&) = delete;

  std::shared_ptr<const world::Layout> layout;
  SolidSet standing;                      // the solids of all static bodies, in the world's frame
  std::vector<std::vector<Part>> models;  // the parts of each model that moving bodies have
  std::vector<BodyPart> moving;           // ordered by body, with unbounded parts last
  std::size_t bounded = 0;                // number of bounded parts in `moving`
  // The index in `moving` of the first bounded part of each body. The last element is `bounded`.
  std::vector<std::uint32_t> first_part;
  // Whether the pose of a moving body alone determines where its solids are: all parts are bounded,
  // and no part moves with a joint.
  bool follow_bodies = true;
};

}  // namespace gsv::sensing
