// The trader's attributes as texts under their names, for what outlives the process.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gsv/broker/offers/import_policies.h"

namespace gsv::broker {

std::vector<std::pair<std::string, std::string>> AttributeTexts(const TraderAttributes& attributes);

// Passes over a name that it does not know, and a text that is no value of the attribute.
void SetAttribute(std::string_view name, const std::string& text, TraderAttributes& attributes);

}  // namespace gsv::broker
