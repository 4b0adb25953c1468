// What a sensor measured at one instant.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <boost/container/small_vector.hpp>

#include "gsv/base/sim_time.h"
#include "gsv/model/image.h"

namespace gsv::sensing {

// `values` has the shape its sensor type documents (a sonar: one range in metres). `picture` is
// null for all but cameras; `labels`, names that go with the values, for all types that have none.
struct Reading {
  using Values = boost::container::small_vector<double, 1>;  // a single one takes no allocation

  std::int64_t step = 0;
  base::SimTime time{0};  // the sampling instant
  Values values;
  std::shared_ptr<const model::Image> picture;
  std::shared_ptr<const std::vector<std::string>> labels;
};

}  // namespace gsv::sensing
