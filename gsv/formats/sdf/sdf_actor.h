// SDFormat's <actor>: a model with a skin, and a script that moves it.
//
// Its animation moves the skin's bones (skinned_mesh.h): each is a link that hangs from the first
// one by six joints, whose positions the script writes.
//
// Not carried out: whatever <plugin>s would do, animations in BVH files, and all animations of an
// actor but one. Warnings say so.
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

// Turns an <actor> into the <model> that it amounts to, and returns what a model has not: a skin
// without animation becomes a visual of the first link, which is added if there is none. The element's own <pose> is left where
// it is: it is that of the trajectory.
ActorParts MakeModelOfActor(tinyxml2::XMLElement& actor, const ReadingContext& context);

// The model that came of it, with its parts. If its links have no collisions it gets one: an upright
// cylinder within the box around the visuals, as thick as that box's narrower side, since arms stick
// out.
std::shared_ptr<const model::Model> ActorOf(const model::Model& model, const ActorParts& parts);

}  // namespace gsv::formats
