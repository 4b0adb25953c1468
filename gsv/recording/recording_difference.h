// Describes for users how two recordings differ: first their scenarios, then the first different
// message and its robot.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "gsv/recording/mcap/mcap_reader.h"
#include "gsv/recording/reading/decoded_messages.h"

namespace gsv::recording {

// The differences between two recordings.
struct RecordingDifference {
  // Lines that are in only one of the two attached scenarios, at most 20 for each.
  std::vector<std::string> only_in_first, only_in_second;
  std::optional<Difference> messages;
  std::string robot;  // robot or body of the first different message; empty if it is unknown

  // Returns at most 60 lines.
  std::string Text() const;
  // Returns the differences as an object.
  nlohmann::ordered_json Json() const;
};

// Compares two recordings up to the first difference.
base::Result<RecordingDifference> CompareRecordings(const McapReader& first,
                                                    const McapReader& second);

}  // namespace gsv::recording
