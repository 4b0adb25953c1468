// Reads <joint type="gearbox">: two joints that are coupled.
//
// Angles  are the angles of the gearbox's two links, about <axis> and <axis2>, relative to
//         <gearbox_reference_body>: child = -ratio * parent (SDFormat's <gearbox_ratio>). For each
//         link, the model must have a revolute joint about this axis between the link and the
//         reference body.
#pragma once

#include <string>

#include <sdf/Joint.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// Couples two joints of `model` by a gearbox: the joint of the child link then follows the joint of
// the parent link. `gearbox` already has its name, links and frame. `reference` is a link, or -1.
// If the joints cannot be coupled, adds a warning, and both joints move freely.
void CoupleGearbox(const sdf::Joint& source, const model::Joint& gearbox, int reference,
                   const std::string& place, const ReadingContext& context, model::Model& model);

}  // namespace gsv::formats
