// Reads SDFormat's <actor>: a model with a skin, and a script that moves it.
//
// Its animation moves the skin's bones (skinned_mesh.h). Each bone is a link that six joints
// connect to the first link; the script sets their positions.
//
// Not supported: <plugin>s, animations in BVH files, and more than one animation of an actor.
// Warnings report them.
#pragma once

#include <memory>

#include <tinyxml2.h>

#include "gsv/formats/meshes/skinned_mesh.h"
#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"
#include "gsv/model/script.h"

namespace gsv::formats {

struct ActorParts {
  std::shared_ptr<const model::Script> script;  // never null; without its animation
  std::shared_ptr<const SkinnedMesh> skin;      // null: the skin keeps its shape, or there is none
};

// Turns an <actor> into a <model>, and returns the parts that a model does not have. A skin without
// animation becomes a visual of the first link, which is added if there is none. The element's
// <pose> stays: it is the pose of the trajectory.
ActorParts MakeModelOfActor(tinyxml2::XMLElement& actor, const ReadingContext& context);

// The converted model with its parts. If its links have no collisions, it gets an upright cylinder
// in the bounding box of the visuals, with the diameter of the box's smaller side, as arms
// protrude.
std::shared_ptr<const model::Model> ActorOf(const model::Model& model, const ActorParts& parts);

}  // namespace gsv::formats
