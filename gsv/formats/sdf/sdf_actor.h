// Reads SDFormat's <actor>: a model with a skin, and a script that moves it.
//
// The animation moves the skin's bones (skinned_mesh.h). Each bone is a link. Six joints connect it
// to the first link, and the script sets their positions.
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

// The parts of an <actor> that a <model> cannot have.
struct ActorParts {
  std::shared_ptr<const model::Script> script;  // never null; has no animation yet
  std::shared_ptr<const SkinnedMesh> skin;      // null: no skin, or a skin without animation
};

// Changes an <actor> element to a <model> element, and returns the parts that a <model> cannot
// have. A skin without animation becomes a visual of the first link. If there is no link, a link is
// added. The element keeps its <pose>, which is the pose of the trajectory.
ActorParts MakeModelOfActor(tinyxml2::XMLElement& actor, const ReadingContext& context);

// Adds the actor's parts to the model that was read from the changed element. If the actor's links
// have no collisions, the actor gets an upright cylinder inside the bounding box of the visuals.
// The cylinder's diameter is the smaller side of the box, because arms protrude.
std::shared_ptr<const model::Model> ActorOf(const model::Model& model, const ActorParts& parts);

}  // namespace gsv::formats
