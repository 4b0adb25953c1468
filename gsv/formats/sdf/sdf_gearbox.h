// Reads <joint type="gearbox">: two joints that are coupled.
//
// Angles  are those of both links of the gearbox, about <axis> and <axis2>, relative to
//         <gearbox_reference_body>: child = -ratio * parent (SDFormat's <gearbox_ratio>). A
//         revolute joint about that axis must connect each of the two links to the reference body.
#pragma once

#include <string>

#include <sdf/Joint.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// `gearbox` has its name, links and frame already; `reference` is a link, or -1. The joint of the
// child link follows that of the parent link from now on. If the joints cannot be coupled, this is
// reported, and both move freely.
void CoupleGearbox(const sdf::Joint& source, const model::Joint& gearbox, int reference,
                   const std::string& place, const ReadingContext& context, model::Model& model);

}  // namespace gsv::formats
