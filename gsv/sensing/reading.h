// What a sensor measured at one instant.
#pragma once

#include <memory>
#include <vector>

#include "gsv/base/sim_time.h"
#include "gsv/model/image.h"

namespace gsv::sensing {

// `values` has the shape its sensor type documents (a sonar: one range in metres). `picture` is
// null for all but cameras.
struct Reading {
  std::int64_t step = 0;
  base::SimTime time{0};  // the sampling instant
  std::vector<double> values;
  std::shared_ptr<const model::Image> picture;
};

}  // namespace gsv::sensing
