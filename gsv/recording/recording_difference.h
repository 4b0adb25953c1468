// Describes the difference of two recordings for people: first their scenarios, then the first
// different message, with its robot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/recording/reading/decoded_messages.h"

namespace gsv::recording {

struct RecordingDifference {
  // Lines of the attached scenarios that only one of them has, at most 20 each.
  std::vector<std::string> only_in_first, only_in_second;
  std::optional<Difference> messages;
  std::string robot;  // or body, which the first different message is about; empty: unknown

  // At most 60 lines.
  std::string Text() const;
  nlohmann::ordered_json Json() const;
};

// Reads both recordings up to the first difference.
base::Result<RecordingDifference> CompareRecordings(const McapReader& first,
                                                    const McapReader& second);

}  // namespace gsv::recording
