// Reads sensors from their XML elements. Sensors of unknown types are read as well.
#pragma once

#include <sdf/Element.hh>

#include "gsv/model/sensor_description.h"

namespace gsv::formats {

// Reads name, type, rate, flags and parameters of a <sensor>; the caller sets link and pose.
//
// A parameter is an element or attribute with a value. Its name has the names of the elements that
// contain it, joined with dots: "range.max", "noise.stddev". The element of the sensor's type
// (<lidar>, <ray>, <camera>, <imu>, <sonar>, and so on) is left out: a lidar has
// "scan.horizontal.samples", a camera has "horizontal_fov", "image.width" and "clip.near".
// Attributes are named like elements ("noise.type"), except `name` and `type` of the sensor itself.
// <pose>, <update_rate>, <visualize> and <plugin> are not parameters. A parameter that SDFormat
// defines has SDFormat's type and default. In other elements, a number becomes a number, "true" and
// "false" become flags, and other values stay texts. The prefix "gsv:", which SDFormat requires for
// elements that it does not define, is removed from names. If an element is repeated, the first one
// counts.
model::SensorDescription ReadSensor(const sdf::ElementPtr& sensor);

}  // namespace gsv::formats
