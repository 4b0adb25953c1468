// Reads the slip of wheels: Gazebo's WheelSlip plugin, and GSV's own element <gsv:slip>.
//
// WheelSlip   <wheel link_name="…"> with <slip_compliance_lateral>, <slip_compliance_longitudinal>,
//             <wheel_normal_force> (N) and <wheel_radius> (m; default: the radius of the wheel's
//             collision).
// <gsv:slip>  <gsv:longitudinal> and <gsv:lateral>, the compliances, both 0 by default. In a
//             <model>, they apply to the wheels of the model's drive. In a <surface>, they apply to
//             wheels on this surface.
#pragma once

#include <string>

#include <sdf/Element.hh>

#include "gsv/formats/sdf/reading_context.h"
#include "gsv/model/model.h"

namespace gsv::formats {

// Sets the slip of the links that a WheelSlip plugin names; ignores other plugins. `scope` is the
// prefix of the names in the plugin ("inner::").
void ReadWheelSlip(const sdf::ElementPtr& plugin, const std::string& scope,
                   const ReadingContext& context, model::Model& model);

// Returns the <gsv:slip> of a model or a surface; zero slip if there is no such element.
model::Slip ReadSlip(const sdf::ElementPtr& parent, const ReadingContext& context);

}  // namespace gsv::formats
