// What a sensor measured at one instant.
#pragma once

#include <memory>

#include <boost/container/small_vector.hpp>

#include "gsv/base/sim_time.h"
#include "gsv/model/image.h"

namespace gsv::sensing {

// `values` has the shape its sensor type documents (a sonar: one range in metres). `picture` is
// null for all but cameras.
struct Reading {
  std::int64_t step = 0;
  base::SimTime time{0};                             // the sampling instant
  boost::container::small_vector<double, 1> values;  // a single one costs no memory of its own
  std::shared_ptr<const model::Image> picture;
};

}  // namespace gsv::sensing
