// Reads <joint type="gearbox">: two joints that turn each other.
//
// Angles  of both links of the gearbox, about <axis> and <axis2>, against <gearbox_reference_body>:
//         child = -ratio * parent (SDFormat's <gearbox_ratio>). Each of the two links must hang
//         from the reference body, or hold it, by a revolute joint about that axis.
#pragma once

#include <string>

#include <sdf/Joint.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// `gearbox` has its name, links and frame already; `reference` is a link, or -1. The joint of the
// child link follows that of the parent link from now on. What cannot be coupled is reported, and
// both joints move freely.
void CoupleGearbox(const sdf::Joint& source, const model::Joint& gearbox, int reference,
                   const std::string& place, const ReadingContext& context, model::Model& model);

}  // namespace gsv::formats
