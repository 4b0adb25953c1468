// What a sensor measured at one instant, and how that becomes the struct of its type.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include <boost/container/small_vector.hpp>

#include "gsv/base/sim_time.h"
#include "gsv/model/image.h"
#include "gsv/readings/fields.h"

namespace gsv::sensing {

// `values` and `labels` are laid out as the sensor type's struct says (gsv/readings/catalogue.h).
// `picture` is null for all but cameras, `labels` for types that have none.
struct Reading {
  using Values = boost::container::small_vector<double, 1>;  // a single one takes no allocation

  std::int64_t step = 0;
  base::SimTime time{0};  // the sampling instant
  Values values;
  std::shared_ptr<const model::Image> picture;
  std::shared_ptr<const std::vector<std::string>> labels;
};

// The struct that a reading stands for; spans in it view the reading. kCorrupt, with the sensor's
// name, when the reading has another size than the layout says.
template <typename Struct>
base::Result<Struct> ValuesOf(const Reading& reading, const std::string& sensor) {
  std::span<const std::string> labels;
  if (reading.labels != nullptr) labels = *reading.labels;
  return readings::Decode<Struct>({reading.values.data(), reading.values.size()}, labels, sensor);
}
template <typename Struct>
void ValuesOf(Reading&& reading, const std::string& sensor) = delete;  // it would be viewed

// The reading's values, and labels if there are any, become those of the struct.
template <typename Struct>
void Fill(const Struct& from, Reading& reading) {
  std::vector<std::string> labels;
  readings::Append(from, reading.values, labels);
  if constexpr (readings::kHasLabels<Struct>) {
    reading.labels = std::make_shared<const std::vector<std::string>>(std::move(labels));
  }
}

}  // namespace gsv::sensing
