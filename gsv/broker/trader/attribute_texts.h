// The trader's attributes as texts with names, for the data file.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gsv/broker/offers/import_policies.h"

namespace gsv::broker {

std::vector<std::pair<std::string, std::string>> AttributeTexts(const TraderAttributes& attributes);

// Ignores unknown names, and texts that are not a value of the attribute.
void SetAttribute(std::string_view name, const std::string& text, TraderAttributes& attributes);

}  // namespace gsv::broker
