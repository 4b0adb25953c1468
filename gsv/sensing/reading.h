// A reading of a sensor at one instant, and its conversion to the struct of its type.
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

// The sensor type's struct defines the layout of `values` and `labels` (gsv/readings/catalogue.h).
// `image` is null except for cameras. `labels` is null for types without labels.
struct Reading {
  using Values = boost::container::small_vector<double, 1>;  // a single value needs no allocation

  std::int64_t step = 0;  // step of the sampled snapshot
  base::SimTime time{0};  // the sampling instant
  Values values;
  std::shared_ptr<const model::Image> image;
  std::shared_ptr<const std::vector<std::string>> labels;
};

// Returns the struct of a reading. Spans in the struct refer to the reading. Fails with kCorrupt if
// the reading does not have the size of the layout; the error names the sensor.
template <typename Struct>
base::Result<Struct> ValuesOf(const Reading& reading, const std::string& sensor) {
  std::span<const std::string> labels;
  if (reading.labels != nullptr) labels = *reading.labels;
  return readings::Decode<Struct>({reading.values.data(), reading.values.size()}, labels, sensor);
}
template <typename Struct>
void ValuesOf(Reading&& reading, const std::string& sensor) = delete;  // spans would dangle

// Sets the values of the reading. If the struct has labels, also sets the labels.
template <typename Struct>
void Fill(const Struct& from, Reading& reading) {
  std::vector<std::string> labels;
  readings::Append(from, reading.values, labels);
  if constexpr (readings::kHasLabels<Struct>) {
    reading.labels = std::make_shared<const std::vector<std::string>>(std::move(labels));
  }
}

}  // namespace gsv::sensing
