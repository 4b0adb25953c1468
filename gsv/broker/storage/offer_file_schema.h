// The tables of a broker's file, and the check that a file is a broker's.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "gsv/base/error.h"
#include "gsv/broker/storage/database.h"

namespace gsv::broker {

// The keys of the rows of the table `broker`.
constexpr std::string_view kStem = "stem";
constexpr std::string_view kNextNumber = "next_number";
constexpr std::string_view kNextIncarnation = "next_incarnation";

// Opens `path` for this process only, checks the file and creates missing tables.
// Errors  see OfferFile::Open.
[[nodiscard]] base::Result<Database> OpenOfferDatabase(const std::string& path, std::uint32_t stem);

}  // namespace gsv::broker
