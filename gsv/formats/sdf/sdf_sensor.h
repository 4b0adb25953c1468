// Reads sensors from their XML elements. Sensors of unknown types are read as well.
#pragma once

#include <sdf/Element.hh>

#include "gsv/model/sensor_description.h"

namespace gsv::formats {

// Reads name, type, rate, flags and parameters of a <sensor>; the caller sets link and pose.
//
// A parameter is an element or attribute with a value. Its name joins the names of the elements
// around it with dots: "range.max", "noise.stddev". The element of the whole sensor (<lidar>,
// <ray>, <camera>, <imu>, <sonar>, and so on) is left out: a lidar's "scan.horizontal.samples", a
// camera's "horizontal_fov", "image.width", "clip.near". An attribute is named like an element
// ("noise.type"), except `name` and `type` of the sensor itself. <pose>, <update_rate>, <visualize>
// and <plugin> are no parameters. An element that SDFormat defines has its type and default.
// Elsewhere, a text that is a number becomes a number, "true" and "false" become flags, and the
// rest is text. The prefix "gsv:", which SDFormat requires for elements that it does not define, is
// removed from names. If an element is repeated, the first counts.
model::SensorDescription ReadSensor(const sdf::ElementPtr& sensor);

}  // namespace gsv::formats
