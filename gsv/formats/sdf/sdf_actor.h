// SDFormat's <actor>: a model with a skin, and a script that moves it.
//
// Not carried out: whatever <plugin>s would do, and animations in BVH files. Warnings say so.
#pragma once

#include <memory>

#include <tinyxml2.h>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"
#include "gsv/model/script.h"

namespace gsv::formats {

// Turns an <actor> into the <model> that it amounts to, and returns its script: the skin becomes a
// visual of the first link, which is added if there is none. The element's own <pose> is left where
// it is: it is that of the trajectory.
std::shared_ptr<const model::Script> MakeModelOfActor(tinyxml2::XMLElement& actor,
                                                      const ReadingContext& context);

// The model that came of it, with its script, and with something to run into if its links have no
// collisions: an upright cylinder within the box around the visuals, as thick as its narrower side
// (arms stick out).
std::shared_ptr<const model::Model> ActorOf(const model::Model& model,
                                            std::shared_ptr<const model::Script> script);

}  // namespace gsv::formats
