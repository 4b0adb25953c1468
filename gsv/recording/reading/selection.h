// A selection of messages of a recording.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "gsv/base/sim_time.h"

namespace gsv::recording {

// The topics and the time range of the selected messages.
struct Selection {
  // Empty for all topics; a trailing "/" selects all topics below it.
  std::vector<std::string> topics;
  // The first and the last selected time, both included.
  base::SimTime from = base::SimTime::min();
  base::SimTime to = base::SimTime::max();

  // Whether the time is selected.
  bool Has(base::SimTime time) const { return time >= from && time <= to; }
  // Whether the topic is selected.
  bool Has(const std::string& topic) const {
    return topics.empty() ||
           std::any_of(topics.begin(), topics.end(), [&](const std::string& each) {
             return each == topic || (each.ends_with('/') && topic.starts_with(each));
           });
  }
};

}  // namespace gsv::recording
