// Sensors, read from their raw elements: a type this program has never heard of comes through.
#pragma once

#include <sdf/Element.hh>

#include "gsv/model/sensor_description.h"

namespace gsv::formats {

// Name, type, rate, flags and parameters of a <sensor>; link and pose are the caller's.
//
// A parameter is an element or attribute that holds a value, named by the elements around it,
// joined with dots: "range.max", "noise.stddev". The element that stands for the whole sensor
// (<lidar>, <ray>, <camera>, <imu>, <sonar>, and so on) is left out of the name: a lidar's
// "scan.horizontal.samples", a camera's "horizontal_fov", "image.width", "clip.near". An attribute
// is named like an element ("noise.type"), except `name` and `type` of the sensor itself. <pose>,
// <update_rate>, <visualize> and <plugin> are no parameters. Where SDFormat defines an element, its
// type and its default hold; elsewhere what reads as a number is a number, "true" and "false" are
// flags, and the rest is text; of "gsv:" before an element's name, which SDFormat asks for where it
// has no such element, nothing is left. Of repeated elements the first counts.
model::SensorDescription ReadSensor(const sdf::ElementPtr& sensor);

}  // namespace gsv::formats
